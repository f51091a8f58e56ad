"""How participants were coupled, and what that took: numbers, and their words on a page."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import xarray as xr

from .page import number
from .quantities import Quantity

if TYPE_CHECKING:
    from cosim.coupling import CoupledResult

#: Key of the numbers -> its words on a page.
WORDS = {
    "scheme": "scheme",
    "order": "order",
    "step_control": "step control",
    "macro_step": "macro step asked for",
    "steps": "steps made",
    "rejected": "steps taken back",
    "shortest_step": "shortest",
    "longest_step": "longest",
    "iterations": "iterations of all steps",
    "most_iterations": "iterations of one step at most",
    "unconverged": "steps accepted without convergence",
    "above_tolerance": "steps accepted above the tolerance",
    "events": "steps ended early by a unit",
    "initial_sweeps": "sweeps of the initial exchange",
}
TIMES = ("macro_step", "shortest_step", "longest_step")
ATTRIBUTE, TABLE = "coupling", "coupling"
#: Keys of a scenario's table that are told with the numbers.
SETTINGS = ("scheme", "step_control", "macro_step")


def step_numbers(result: CoupledResult) -> dict[str, int]:
    """Steps, what was repeated of them, and what stands although it should not: how many."""
    done = result.statistics
    return {
        "steps": result.steps,
        "rejected": done.rejected,
        "iterations": done.iterations,
        "most_iterations": done.most_iterations,
        "events": done.events,
        "unconverged": len(done.unconverged),
        "above_tolerance": len(done.above_tolerance),
        "initial_sweeps": result.sweeps,
    }


def efforts(result: CoupledResult) -> dict[str, dict[str, float]]:
    """Participant -> steps, repeated ones included, and seconds in them."""
    return {
        name: {"steps": each.steps, "seconds": each.seconds}
        for name, each in result.statistics.participants.items()
    }


def attach_coupling(
    dataset: xr.Dataset, result: CoupledResult, tables: Mapping[str, Mapping[str, Any]]
) -> None:
    """Let a dataset carry how it was coupled; tables: of the scenario, with values."""
    settings = tables.get(TABLE, {})
    told = {key: settings[key]["value"] for key in SETTINGS if key in settings}
    found = told | step_numbers(result) | {"participants": efforts(result)}
    dataset.attrs[ATTRIBUTE] = json.dumps(found)


def coupling_numbers(dataset: xr.Dataset) -> dict[str, Any]:
    """What `attach_coupling` gave, with units; {} where a dataset has none of it."""
    return _with_units(json.loads(dataset.attrs.get(ATTRIBUTE, "{}")))


def _with_units(found: Mapping[str, Any]) -> dict[str, Any]:
    told: dict[str, Any] = {}
    for key, value in found.items():
        if isinstance(value, dict):
            told[key] = _with_units(value)
        elif isinstance(value, str):
            told[key] = value
        else:
            told[key] = Quantity(value, "s" if key in (*TIMES, "seconds") else "1")
    return told


def step_rows(numbers: Mapping[str, Any]) -> list[tuple[str, ...]]:
    """Words and values for a page, of what there is."""
    return [(words, _told(key, numbers[key])) for key, words in WORDS.items() if key in numbers]


def effort_rows(participants: Mapping[str, Mapping[str, Any]]) -> list[tuple[str, ...]]:
    """Participant, and its steps and seconds."""
    return [
        (name, f"{each['steps']} steps, {number(each['seconds'], 3)} s")
        for name, each in participants.items()
    ]


def _told(key: str, value: Any) -> str:
    if isinstance(value, list):
        return ", ".join(map(str, value)) or "none"
    if key in TIMES:
        return number(value) if value is None else f"{number(value)} s"
    return str(value)
