"""A combination that is a whole scenario, any of its keys changed; its coupled run."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from stickslip import Trajectory
from stickslip.trajectory import break_away_frequency, counted_break_aways

from cosim.coupling import CoupledResult
from cosim.scenario import Scenario, ScenarioError

from .axis import SCENARIO, list_entry
from .features import features

#: Tables of a scenario that only a coupled run has a use for.
HEAT_TABLES = ("belt", "ice", "contact", "coupling")


def changed(base: Scenario, changes: Mapping[str, Any]) -> Scenario:
    """A scenario with `block.key` -> value, `block.key[2].entry` for the second table of a list.

    `SCENARIO` -> another, in place of the base. ScenarioError in one line.
    """
    given: Scenario = changes.get(SCENARIO, base)
    tables = given.to_tables()
    for key, value in changes.items():
        if key != SCENARIO:
            _set(tables, key, value)
    return type(given).from_tables(tables)


def _set(tables: dict[str, Any], key: str, value: Any) -> None:
    if (place := list_entry(key)) is None:
        block, _, entry = key.partition(".")
        tables.setdefault(block, {})[entry] = value
        return
    name, number, entry = place
    block, _, of_list = name.partition(".")
    entries = [dict(one) for one in tables.get(block, {}).get(of_list, ())]
    if not 1 <= number <= len(entries):
        raise ScenarioError(f"{key}: the scenario has {len(entries)} of {name}, counted from 1")
    entries[number - 1][entry] = value
    tables[block] = tables[block] | {of_list: tuple(entries)}


def is_heat(key: str) -> bool:
    """Does a key act in a coupled run alone?"""
    return key.partition(".")[0] in HEAT_TABLES


def differ_in_heat(scenarios: list[Scenario]) -> bool:
    """Whether scenarios differ in what a coupled run alone has a use for."""
    first = scenarios[0]
    return any(
        getattr(one, table) != getattr(first, table) for one in scenarios for table in HEAT_TABLES
    )


def coupled_features(
    scenario: Scenario, progress: Callable[[float], None]
) -> tuple[dict[str, float], str]:
    """Features of motion and heat of a coupled run; and why it is not complete, "" where it is."""
    from cosim.coupling.case import run_scenario

    result = run_scenario(scenario, progress=progress).result
    if result.status != "complete":
        return {}, result.reason
    trajectory = as_trajectory(result, scenario)
    numbers = features(trajectory) | _heat(result, scenario)
    late = trajectory.time >= scenario.surface.run_up_time
    if np.count_nonzero(late) > 1:
        # the unit counts break-aways that fall between two rows, too
        starts = counted_break_aways(trajectory.time, trajectory["slip_count"])
        begin, end = scenario.surface.run_up_time, trajectory.time[-1]
        numbers["frequency"] = break_away_frequency(starts[(starts >= begin) & (starts <= end)])
    return numbers, ""


def as_trajectory(result: CoupledResult, scenario: Scenario) -> Trajectory:
    """The block's motion of a coupled run; its events to one row."""
    prefix = "mechanics."
    columns = {
        name.removeprefix(prefix): np.asarray(result[name])
        for name in result.values
        if name.startswith(prefix)
    }
    mode = columns["mode"]
    changed_at = np.flatnonzero(np.diff(mode)) + 1
    events = np.column_stack((result.time[changed_at], mode[changed_at], columns["x"][changed_at]))
    return Trajectory(result.time, columns, events, scenario.mechanics)


def _heat(result: CoupledResult, scenario: Scenario) -> dict[str, float]:
    air = scenario.ambient.temperature_degC
    interface = result["thermal.interface_temperature"] - air
    late = interface[result.time >= scenario.surface.run_up_time]
    return {
        "interface_rise": float(interface[-1]),
        "interface_drift": float(late[-1] - late[0]) if late.size > 1 else math.nan,
        "belt_entry_rise": float(result["thermal.belt_entry_temperature"][-1] - air),
        "ice_face_rise": float(result["thermal.ice_face_temperature"][-1] - air),
        "belt_share": float(result["thermal.belt_share"][-1]),
        "melted_mass": float(result["thermal.melted_mass"][-1]),
        "heat_residual": float(np.max(np.abs(result["thermal.heat_residual"]))),
    }


def check_coupled(scenario: Scenario) -> None:
    """ScenarioError where a coupled run cannot be, or would not end."""
    from cosim.scenario.work import check_work

    _ = scenario.record_every
    check_work(scenario, coupled=True)
