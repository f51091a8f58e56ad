"""How participants were coupled, and what that took: numbers, and their words on a page."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from cosim.report.columns import Data

from .page import number
from .quantities import KEY_UNITS, TABLES

if TYPE_CHECKING:
    from cosim.coupling import CoupledResult

#: Key of the numbers -> its words on a page.
WORDS = TABLES["steps"]
#: What is shown only where there is any: for one, the start of the first step that stands although
#: it should not.
SELDOM = ("first_unconverged", "first_above_tolerance", "remarks")
ATTRIBUTE, TABLE = "coupling", "coupling"
#: Keys of a scenario's table that are told with the numbers.
SETTINGS = ("scheme", "step_control", "macro_step")


def step_numbers(result: CoupledResult) -> dict[str, Any]:
    """Steps, what was repeated of them, and what stands although it should not: how many.

    converged: whether none stands whose iteration had not come to its end; first_...: start of the
    first step that stands so, s, None where there is none.
    """
    done = result.statistics
    return {
        "steps": result.steps,
        "rejected": done.rejected,
        "iterations": done.iterations,
        "most_iterations": done.most_iterations,
        "events": done.events,
        "unconverged": len(done.unconverged),
        "first_unconverged": done.unconverged[0] if done.unconverged else None,
        "converged": result.converged,
        "above_tolerance": len(done.above_tolerance),
        "first_above_tolerance": done.above_tolerance[0] if done.above_tolerance else None,
        "initial_sweeps": result.sweeps,
    }


def doubts(coupling: Mapping[str, Any]) -> list[str]:
    """What is wrong with the steps of a run that is complete all the same, a sentence each.

    coupling: numbers of a summary.
    """
    return [
        f"{coupling[key]} of {coupling['steps']} steps were accepted, the first from t ="
        f" {coupling[f'first_{key}']:.6g} s, {words}"
        for key, words in TABLES["doubts"].items()
        if coupling.get(key)
    ]


def efforts(result: CoupledResult) -> dict[str, dict[str, float]]:
    """Participant -> steps, repeated ones included, and seconds in them."""
    return {
        name: {"steps": each.steps, "seconds": each.seconds}
        for name, each in result.statistics.participants.items()
    }


def attach_coupling(
    dataset: Data, result: CoupledResult, tables: Mapping[str, Mapping[str, Any]]
) -> None:
    """Let a dataset carry how it was coupled; tables: of the scenario, with values."""
    settings = tables.get(TABLE, {})
    told = {key: settings[key]["value"] for key in SETTINGS if key in settings}
    found = {"participants": efforts(result), "remarks": list(result.remarks)}
    dataset.attrs[ATTRIBUTE] = json.dumps(told | step_numbers(result) | found)


def coupling_numbers(dataset: Data) -> dict[str, Any]:
    """What `attach_coupling` gave; {} where a dataset has none of it."""
    return dict(json.loads(dataset.attrs.get(ATTRIBUTE, "{}")))


def step_rows(numbers: Mapping[str, Any]) -> list[tuple[str, ...]]:
    """Words and values for a page, of what there is."""
    return [
        (words, _told(key, numbers[key]))
        for key, words in WORDS.items()
        if key in numbers and (key not in SELDOM or numbers[key] not in (None, []))
    ]


def _told(key: str, value: Any) -> str:
    if isinstance(value, list):
        return ", ".join(map(str, value)) or "none"
    if KEY_UNITS.get(key) == "s":
        return "none" if value is None else f"{number(value)} s"
    return str(value)
