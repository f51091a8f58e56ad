"""What a dataset says of its run: parameters, phases of stick and slip, stability and regimes."""

from __future__ import annotations

import json
import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import BaseModel
from stickslip import Parameters
from stickslip.packing import GRAVITY
from stickslip.quantity import details
from stickslip.steady_motion import Assessment
from stickslip.trajectory import counted_break_aways
from stickslip.trajectory import slip_share as share_of_slip

from cosim.report.columns import Array, Data

if TYPE_CHECKING:
    from thermal import RigView, ThermalParameters

#: Times (s) and what is seen of belt and ice.
Views = Sequence[tuple[float, "RigView"]]
#: Table -> key -> value, unit and description.
Tables = dict[str, dict[str, dict[str, Any]]]

SLIP = 1.0
ATTRIBUTE = "assessment"


def tables_of(scenario: BaseModel) -> Tables:
    """Table -> key -> value, unit and description, from a pydantic model made of tables.

    What is no table is left out, and so is a table that another name has already.
    """
    named = [(name, getattr(scenario, name)) for name in type(scenario).model_fields]
    found = [(name, table) for name, table in named if isinstance(table, BaseModel)]
    tables = {id(table): (name, table) for name, table in reversed(found)}
    return {name: _entries(table) for name, table in reversed(tables.values())}


def _entries(table: BaseModel) -> dict[str, dict[str, Any]]:
    values = table.model_dump(mode="json")
    entries = {}
    for key, field in type(table).model_fields.items():
        unit = str(details(field).get("unit", ""))
        description = (field.description or "").removesuffix(f"[{unit}]").strip()
        entries[key] = {"value": values[key], "unit": unit, "description": description}
    return entries


def stored_tables(dataset: Data) -> Tables:
    """The tables of parameters that a dataset carries."""
    return dict(json.loads(dataset.attrs["parameters"]))


def value_of(dataset: Data, table: str, key: str) -> Any:
    """One parameter's value; None where the scenario has no such table or key."""
    return stored_tables(dataset).get(table, {}).get(key, {}).get("value")


def material_of(dataset: Data) -> str:
    """What the block is of."""
    return str(value_of(dataset, "ice", "material") or "ice")


def mechanics_of(dataset: Data) -> Parameters:
    """The mechanical parameters that a dataset was computed with."""
    with warnings.catch_warnings():
        # whatever there is to warn of was said when the scenario was read
        warnings.simplefilter("ignore")
        return Parameters.model_validate(_selected(dataset, Parameters))


def thermal_of(dataset: Data) -> ThermalParameters:
    """The thermal parameters that a dataset was computed with.

    A scenario states the contact's radius and the block's mass once, with the rig.
    """
    from thermal import ThermalParameters  # finite elements: only for who asks for them

    tables = _selected(dataset, ThermalParameters)
    radius, mass = (value_of(dataset, "rig", key) for key in ("contact_radius", "mass"))
    if radius is not None:
        tables["contact"] = {"radius": radius, "load": GRAVITY * mass} | tables.get("contact", {})
    return _in_its_air(dataset, ThermalParameters.model_validate(tables))


def still_air_film(dataset: Data) -> float | None:
    """Heat transfer of a belt that moves as fast as in the run through still air, W/(m2 K).

    On each face, as `stickslip belt-length` takes it. None where that is not known: of no speed,
    or of one that leaves laminar air.
    """
    from thermal.belt.air import NotLaminar

    speed = value_of(dataset, "surface", "speed")
    if not speed:
        return None
    thermal = thermal_of(dataset)
    belt = thermal.belt.model_copy(update={"still_air_speed": abs(speed)})
    try:
        moved = _in_its_air(dataset, thermal.model_copy(update={"belt": belt})).belt
        return moved.film if moved.still_air_speed == 0.0 else None
    except NotLaminar:
        return None


def _in_its_air(dataset: Data, thermal: ThermalParameters) -> ThermalParameters:
    """With the heat transfer of still air, where that is asked for, as a number."""
    keys = (("surface", "speed"), ("friction", "mu_k"), ("run", "duration"), ("rig", "mass"))
    speed, mu, run, mass = (value_of(dataset, *key) for key in keys)
    if None in (speed, mu, run, mass):
        return thermal
    moving = run - 0.5 * min(ramp_end(dataset), run)
    return thermal.in_still_air(mu * mass * GRAVITY, abs(speed), moving)


def parameter_values(dataset: Data) -> dict[str, dict[str, Any]]:
    """Table -> key -> value, of all parameters that a dataset carries."""
    return {
        name: {key: entry["value"] for key, entry in entries.items()}
        for name, entries in stored_tables(dataset).items()
    }


def _selected(dataset: Data, model: type[BaseModel]) -> dict[str, dict[str, Any]]:
    tables = parameter_values(dataset).items()
    return {name: values for name, values in tables if name in model.model_fields}


def ramp_end(dataset: Data) -> float:
    """End of the surface's speed ramp, s; 0 without one."""
    return float(value_of(dataset, "surface", "run_up_time") or 0.0)


def has_events(dataset: Data) -> bool:
    """Whether the dataset carries located events (else modes at the recorded times)."""
    return "event_time" in dataset.coords


def mode_changes(dataset: Data) -> tuple[Array, Array]:
    """Times (k,) s and modes after them (k,), the first entry being the run's start.

    Without located events the time spent in slip tells where a change lies between the two rows
    that show it; without that either, it is put halfway.
    """
    time, mode = dataset["time"].values, dataset["mode"].values.astype(float)
    if time.size == 0:
        return np.empty(0), np.empty(0)
    if has_events(dataset):
        times, modes = dataset["event_time"].values, dataset["event_mode"].values.astype(float)
        inside = times > time[0]
        return np.append(time[0], times[inside]), np.append(mode[0], modes[inside])
    known = np.isfinite(mode)
    time, mode = time[known], mode[known]
    at = np.flatnonzero(np.diff(mode))
    before, after = time[at], time[at + 1]
    changes = 0.5 * (before + after)
    if "slip_time" in dataset:
        slipped = np.diff(dataset["slip_time"].values[known])[at]
        changes = np.where(mode[at + 1] == SLIP, after - slipped, before + slipped)
        changes = np.clip(changes, before, after)
    return np.concatenate([time[:1], changes]), np.concatenate([mode[:1], mode[at + 1]])


def slip_intervals(dataset: Data) -> Array:
    """Begin and end (k, 2) of every slip phase, s."""
    times, modes = mode_changes(dataset)
    if times.size == 0:
        return np.empty((0, 2))
    ends = np.append(times[1:], max(dataset["time"].values[-1], times[-1]))
    slipping = modes == SLIP
    return np.column_stack([times[slipping], ends[slipping]])


def slip_share(dataset: Data, begin: float, end: float) -> float | None:
    """Fraction of begin ... end (s) in slip; None for an empty window."""
    return share_of_slip(*mode_changes(dataset), begin, end) if end > begin else None


def break_aways(dataset: Data) -> Array:
    """Times of break-away, s (k,).

    Without located events: those that `slip_count` has, to half an interval of the rows.
    """
    if has_events(dataset):
        return np.asarray(dataset["event_time"].values[dataset["event_mode"].values == 1])
    return counted_break_aways(dataset["time"].values, dataset["slip_count"].values.astype(float))


def attach_assessment(dataset: Data, assessment: Assessment | None) -> None:
    """Let a dataset carry the assessment of its motion; None: there is none."""
    if assessment is not None:
        dataset.attrs[ATTRIBUTE] = json.dumps(assessment.as_dict())


def assessment_numbers(dataset: Data) -> dict[str, Any]:
    """Stability and regimes; nothing for a run that was not assessed."""
    return dict(json.loads(dataset.attrs.get(ATTRIBUTE, "{}")))
