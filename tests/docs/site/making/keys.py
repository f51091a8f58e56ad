"""Keys of the files that a user writes: defaults, units, bounds, words, as they are declared."""

from __future__ import annotations

import math
import types
from collections.abc import Iterable
from typing import Any, Literal, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo
from stickslip import EFFECTS, Rig
from stickslip.quantity import details

from cosim.gap.data import campaign_file
from cosim.scenario import Scenario
from cosim.systems import specification, toml_file

from .markdown import code, heading, table

HEAD = ("key", "default", "unit", "allowed", "is")
BOUNDS = {"gt": ("(", 0), "ge": ("[", 0), "lt": (")", 1), "le": ("]", 1)}


def scenario() -> str:
    """Every table of a scenario: what a rig and a run are, then the effects."""
    effects = {effect.id for effect in EFFECTS}
    tables = {
        name: field.default
        for name, field in Scenario.model_fields.items()
        if isinstance(field.default, BaseModel)
    }
    ordered = sorted(tables, key=lambda name: name in effects)
    return "".join(section(name, tables[name], level=2) for name in ordered)


def campaign() -> str:
    """The tables of `campaign.toml`."""
    file = campaign_file.CampaignTable
    parts = [table(HEAD, rows(file))]
    for name, model in _tables_within(file):
        if model is not Rig:  # which is that of a scenario
            parts.append(section(name, model))
    parts.append(section("run", campaign_file.MeasuredRunTable, "A list of tables: "))
    parts.append(section("run.summary", campaign_file.Summary))
    return "".join(parts)


def system() -> str:
    """The tables of a system's TOML file."""
    return (
        section("units.NAME", toml_file.Unit)
        + section("connections", toml_file.ConnectionTable, "a list of tables: ")
        + section("coupling", specification.Coupling)
        + section("run", specification.Run)
    )


def section(name: str, model: BaseModel | type[BaseModel], kind: str = "", level: int = 3) -> str:
    """A table of the file: what it is of, and its keys."""
    said = " ".join(((model if isinstance(model, type) else type(model)).__doc__ or "").split())
    return heading(level, f"[{name}]") + f"{kind}{said}\n\n" + table(HEAD, rows(model))


def rows(model: BaseModel | type[BaseModel]) -> Iterable[tuple[str, ...]]:
    """Key, default, unit, what is allowed, description."""
    kind = model if isinstance(model, type) else type(model)
    for key, field in kind.model_fields.items():
        unit = str(details(field).get("unit") or "")
        default = default_of(field) if isinstance(model, type) else toml(getattr(model, key))
        said = (field.description or "").strip()
        yield code(key), default, "" if unit == "1" else unit, allowed(field), said


def default_of(field: FieldInfo) -> str:
    """As the file would have it; "required" where there is none."""
    if field.is_required():
        return "required"
    return toml(field.get_default(call_default_factory=True))


def toml(value: Any) -> str:
    """A value as TOML; nothing for what a file leaves out."""
    if value is None or value == math.inf or isinstance(value, BaseModel):
        return ""
    if isinstance(value, bool):
        return code(str(value).lower())
    if isinstance(value, str):
        return code(f'"{value}"')
    if isinstance(value, (tuple, list)):
        return code("[" + ", ".join(toml(one).strip("`") for one in value) + "]")
    if isinstance(value, dict):
        return code("{}") if not value else code(value)
    return code(f"{value:g}" if isinstance(value, float) else value)


def allowed(field: FieldInfo) -> str:
    """Words to choose from, or the bounds of a number."""
    words = list(_words(field.annotation))
    if words:
        return ", ".join(code(f'"{word}"') for word in words)
    low, high = ["(", "-inf"], [")", "inf"]
    for bound in field.metadata:
        for name, (bracket, end) in BOUNDS.items():
            if (value := getattr(bound, name, None)) is not None:
                (low, high)[end][:] = [bracket, f"{value:g}"]
    if (low[1], high[1]) == ("-inf", "inf"):
        return ""
    return f"{low[0]}{low[1]}, {high[1]}{high[0]}"


def _words(annotation: Any) -> Iterable[str]:
    if get_origin(annotation) is Literal:
        yield from (str(word) for word in get_args(annotation))
    elif get_origin(annotation) in (Union, types.UnionType, tuple):
        for part in get_args(annotation):
            yield from _words(part)


def _tables_within(model: type[BaseModel]) -> Iterable[tuple[str, type[BaseModel]]]:
    for key, field in model.model_fields.items():
        for part in (field.annotation, *get_args(field.annotation)):
            if isinstance(part, type) and issubclass(part, BaseModel):
                yield field.alias or key, part
