"""The catalogue of effects: what it says of each, as plain data for table, JSON and page."""

import math
from pathlib import Path
from typing import Any, NamedTuple

from stickslip.catalogue import Catalogue, default_catalogue
from stickslip.effects.effect import Effect
from stickslip.friction.law_curves import axis_of
from stickslip.plugins.load import file_of
from stickslip.quantity import details

from cosim.fmu.variables import bounds_of
from cosim.names import nearest
from cosim.report.page import texts

__all__ = ["Entry", "allowed", "chosen", "described", "written"]


class UnknownEffect(ValueError):
    """An id that the catalogue does not have; the message is one line."""


class Entry(NamedTuple):
    """An effect, and the catalogue that it is of."""

    effect: Effect
    catalogue: Catalogue


def chosen(ids: list[str]) -> list[Entry]:
    """Entries by their ids or files in the catalogue's order, all of them for none.

    Files are of custom effects, and are executed: PluginError.
    """
    catalogue = default_catalogue().with_files(*(name for name in ids if name.endswith(".py")))
    known = [entry.id for entry in catalogue.effects]
    files = {file: entry.id for entry in catalogue.effects if (file := file_of(entry)) is not None}
    ids = [files.get(Path(name).resolve(), name) for name in ids]
    for name in ids:
        if name not in known:
            near = nearest(name, known, similarity=0.0)
            raise UnknownEffect(f"effect {name!r}: unknown, nearest known: {near}")
    told = [each for each in catalogue.effects if not ids or each.id in ids]
    return [Entry(each, catalogue) for each in told]


def described(entry: Effect) -> dict[str, Any]:
    """An entry of the catalogue with its parameters: unit, default (off), bounds, typical range."""
    return {
        "id": entry.id,
        "sentence": entry.sentence,
        "enters": entry.enters,
        "source": entry.source,
        "law": entry.law,
        "axis": axis_of(entry),
        "toml": snippet(entry),
        "parameters": [
            {
                "key": f"{entry.id}.{name}",
                "unit": details(field)["unit"],
                "default": field.default,
                "typical": details(field).get("typical"),
                "switches_on": name in entry.switch,
                "description": field.description,
                **bounds_of(field),
            }
            for name, field in entry.table.model_fields.items()
        ],
    }


def snippet(entry: Effect) -> str:
    """The lines of a scenario that have the effect as its figure has it.

    >>> from stickslip import EFFECTS
    >>> print(snippet(EFFECTS[0]))
    [lateral_friction]
    ratio = 1
    """
    file = file_of(entry)
    named = [f'effects = ["{file.name}"]', ""] if file is not None else []
    sizes = [f"{name} = {value:g}" for name, value in entry.case.effect.items()]
    return "\n".join([*named, f"[{entry.id}]", *sizes])


def allowed(parameter: dict[str, Any]) -> str:
    """The bounds of a described parameter as an interval: [0, 2), (-inf, inf).

    >>> allowed({"ge": 0.0, "lt": 2.0})
    '[0, 2)'
    """
    low = parameter.get("ge", parameter.get("gt", -math.inf))
    high = parameter.get("le", parameter.get("lt", math.inf))
    ends = "[" if "ge" in parameter else "(", "]" if "le" in parameter else ")"
    return f"{ends[0]}{low:g}, {high:g}{ends[1]}"


def written() -> Any:
    """The macros of `effects.txt.j2`."""
    return texts("effects.txt.j2", __name__, {"allowed": allowed})
