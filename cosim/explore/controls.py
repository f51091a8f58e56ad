"""What the explorer lets one turn: every key of the mechanics, from its declaration.

Name, unit, bounds, words and typical range are those that scenarios, the FMU and the effects page
show, too; a new effect has its sliders at once.
"""

import math
from typing import Any, Literal, get_args, get_origin

from pydantic.fields import FieldInfo
from stickslip.catalogue import CATALOGUE, Catalogue
from stickslip.effects.effect import Effect
from stickslip.packaged import packaged_tables
from stickslip.quantity import details

from cosim.fmu.variables import bounds_of
from cosim.report.page import unit_text
from cosim.scenario import Scenario
from cosim.scenario.validation import allowed, known_keys, not_in, unit_of

#: `controls.toml`: headings, and where a slider goes to, of keys whose declarations have no range.
TABLES = packaged_tables(__package__, "controls.toml")
RANGES: dict[str, list[float]] = TABLES["ranges"]
#: Tables whose groups are open.
OPEN = ("surface", "rig", "springs", "friction")
#: Keys of other tables that a run of the mechanics alone takes.
OF_RUN = ("run.duration", "run.output_interval", "ambient.temperature_degC")
#: Keys that are no numbers of the motion: the file of a table has been read.
LEFT_OUT = ("friction.table",)
#: A slider is logarithmic where its ends are further apart than this.
DECADES = 30.0
#: A typical range ends where most rigs do; a slider goes on so much further.
BEYOND = 2.0


def groups(catalogue: Catalogue = CATALOGUE) -> list[dict[str, Any]]:
    """Groups of controls as plain data, in the order of the page.

    Each has id, title, sentence, enters ("" where it is no effect), open, and controls: key, name,
    unit, spelled (the unit as it is read), kind, description, allowed and not_in (words), bounds
    (gt, ge, lt, le), choices, slider (see `slider`; None of what is no single number) and switch,
    whether it turns an effect on.
    """
    effects = {effect.id: effect for effect in catalogue.effects}
    titles = TABLES["headings"] | {name: name.replace("_", " ") for name in effects}
    known = known_keys(Scenario.of(catalogue))
    return [_group(table, title, known, effects.get(table)) for table, title in titles.items()]


def _group(
    table: str, title: str, known: dict[str, FieldInfo], effect: Effect | None
) -> dict[str, Any]:
    """known: every key of a scenario."""
    own = [key for key in known if key.startswith(f"{table}.") and key not in LEFT_OUT]
    controls = [control(key, known[key]) for key in (OF_RUN if table == "run" else own)]
    for each in controls:
        each["switch"] = effect is not None and each["name"] in effect.switch
    return {
        "id": table,
        "title": title,
        "sentence": effect.sentence if effect else "",
        "enters": effect.enters if effect else "",
        "open": table in OPEN,
        "controls": controls,
    }


def control(key: str, field: FieldInfo) -> dict[str, Any]:
    """A key as the page shows it."""
    bounds = _bounds(field)
    kind, unit = _kind(field), unit_of(field)
    numeric = kind in ("number", "whole", "inertia")
    return {
        "key": key,
        "name": key.partition(".")[2],
        "unit": unit,
        "spelled": "" if unit == "1" else unit_text(unit),
        "kind": kind,
        "description": field.description or "",
        "allowed": allowed(key, field),
        "not_in": not_in(unit),
        "default": field.default,
        "bounds": bounds,
        "choices": list(map(str, get_args(field.annotation))) if kind == "choice" else [],
        "slider": slider(key, field, bounds) if numeric else None,
        "switch": False,
    }


def _kind(field: FieldInfo) -> str:
    """number, whole, choice, freedom (motions that are allowed), inertia, or list (of numbers)."""
    kind: Any = field.annotation
    if kind is float:
        return "number"
    if kind is int:
        return "whole"
    if get_origin(kind) is Literal:
        return "choice"
    if get_origin(kind) is tuple:
        return "freedom" if get_origin(get_args(kind)[0]) is Literal else "list"
    return "inertia"


def _bounds(field: FieldInfo) -> dict[str, float]:
    """gt, ge, lt, le of a number; ``max_length`` of a list."""
    found = bounds_of(field)
    for bound in field.metadata:
        if getattr(bound, "max_length", None) is not None:
            found["max_length"] = bound.max_length
    return found


def slider(key: str, field: FieldInfo, bounds: dict[str, float]) -> dict[str, Any]:
    """Ends of a slider, whether it is logarithmic, and whether 0 stands before its lower end.

    What is off at 0 has 0 at the left end in any case. A value that is typed may lie beyond.
    """
    said = details(field)
    low, high = _ends(key, field, bounds, said.get("typical") or said.get("tried"))
    log = low > 0.0 and high / low >= DECADES
    zero = low > 0.0 and field.default == 0.0
    if zero and not log:
        low, zero = 0.0, False
    return {"low": low, "high": high, "log": log, "zero": zero}


def _ends(
    key: str, field: FieldInfo, bounds: dict[str, float], typical: tuple[float, float] | None
) -> tuple[float, float]:
    least = bounds.get("ge", bounds.get("gt", -math.inf))
    most = bounds.get("le", bounds.get("lt", math.inf))
    default = field.default if isinstance(field.default, (int, float)) else 0.0
    if key in RANGES:
        low, high = RANGES[key]
    elif typical is not None:
        low, high = typical
        low = low / BEYOND if low > 0.0 else low * BEYOND
        high *= BEYOND
    elif math.isfinite(least) and math.isfinite(most):
        low, high = least, most
    else:
        size = abs(default) or 1.0
        low, high = (size / 10.0, 10.0 * size) if least >= 0.0 else (-10.0 * size, 10.0 * size)
    low, high = max(low, least), min(high, most)
    if default != 0.0:
        low, high = min(low, default), max(high, default)
    return low, high
