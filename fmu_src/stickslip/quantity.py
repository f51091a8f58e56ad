"""A checked table of parameters, the element that scenarios and FMU parameters are made of."""

from __future__ import annotations

from typing import Any, ClassVar

from pydantic import BaseModel, ConfigDict, Field
from pydantic.fields import FieldInfo

_OF_PYDANTIC = frozenset(dir(BaseModel))


class Table(BaseModel):
    """A table of parameters: unknown keys, NaN and infinities are refused; nothing changes later.

    A table that takes what TOML or JSON give for a tuple sets ``strict=False`` for itself.
    """

    model_config: ClassVar[ConfigDict] = ConfigDict(
        extra="forbid", frozen=True, allow_inf_nan=False, strict=True
    )

    def __dir__(self) -> list[str]:
        """Its own names: what pydantic has beside them is not for whoever looks for a key."""
        return [name for name in super().__dir__() if name not in _OF_PYDANTIC]


def quantity(
    default: Any,
    unit: str,
    description: str,
    typical: tuple[float, float] | None = None,
    tried: tuple[float, float] | None = None,
    **bounds: Any,
) -> Any:
    """A field with unit (`1` for none) and description.

    Parameters
    ----------
    default : the value, or ``...`` where one must be given
    unit : of the value, as the FMU spells it
    description : what a reader of the schema is told
    typical : range in which an effect shows in a rig of this kind, for whoever looks for it
    tried : range that tests draw from, of a parameter that says where or how an effect acts and has
        no size of its own
    bounds : pydantic's gt, ge, lt, le
    """
    extra: dict[str, Any] = {"unit": unit}
    if typical is not None:
        extra["typical"] = typical
    if tried is not None:
        extra["tried"] = tried
    return Field(default, description=description, json_schema_extra=extra, **bounds)


def details(field: FieldInfo) -> dict[str, Any]:
    """What `quantity` has noted of a field beside its description: unit, typical, tried."""
    extra = field.json_schema_extra
    return extra if isinstance(extra, dict) else {}
