"""The catalogue of effects, from their declarations."""

import sys

from pydantic.fields import FieldInfo
from stickslip import EFFECTS
from stickslip.quantity import details

from . import keys
from .markdown import code, heading, table

HEAD = ("parameter", "default", "unit", "allowed", "typical", "is")


def text() -> str:
    """A section for each effect: what it adds, where it enters, who measured it, its parameters."""
    return "".join(_section(effect) for effect in EFFECTS)


def _section(effect) -> str:
    said = (sys.modules[effect.table.__module__].__doc__ or "").strip()
    switch = " or ".join(code(f"{effect.id}.{name}") for name in effect.switch)
    return (
        heading(2, effect.id, f"effect-{effect.id}")
        + f"```text\n{said}\n```\n\n"
        + f"Enters: {effect.enters}. Switched on by {switch}. Source: {effect.source}.\n\n"
        + table(HEAD, (_row(key, field) for key, field in effect.table.model_fields.items()))
    )


def _row(key: str, field: FieldInfo) -> tuple[str, ...]:
    unit = str(details(field).get("unit") or "")
    low_high = details(field).get("typical") or ()
    return (
        code(key),
        keys.default_of(field),
        "" if unit == "1" else unit,
        keys.allowed(field),
        " to ".join(f"{value:g}" for value in low_high),
        field.description or "",
    )
