"""A checked table of parameters, the element that scenarios and FMU parameters are made of."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, ConfigDict, Field


class Block(BaseModel):
    """A table of parameters: unknown keys, NaN and infinities are refused."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False, strict=True)


def quantity(
    default: float,
    unit: str,
    description: str,
    typical: tuple[float, float] | None = None,
    **bounds: Any,
) -> Any:
    """A field with unit and description.

    ``bounds`` are pydantic's gt, ge, lt, le; ``typical`` is the range in which an effect shows in a
    rig of this kind, for whoever looks for it.
    """
    extra: dict[str, Any] = {"unit": unit}
    if typical is not None:
        extra["typical"] = typical
    return Field(default, description=description, json_schema_extra=extra, **bounds)
