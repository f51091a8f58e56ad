"""A run as columns: what files, figures and summary are made of."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel
from stickslip import Trajectory
from stickslip.ports import OUTPUTS

from cosim.report.columns import Array

from .bounds import WIDTH
from .columns import Column, Columns
from .contents import tables_of
from .coupling import attach_coupling
from .files import provenance
from .quantities import TABLES

# name -> (unit, long name); the mechanical ones as the model itself describes them
MECHANICAL = {port.name: (port.unit or "1", port.description) for port in OUTPUTS}

THERMAL, COUPLING = TABLES["thermal"], TABLES["coupling"]

KNOWN = MECHANICAL | THERMAL | COUPLING | TABLES["axes"] | {"event_x": MECHANICAL["x"]}

MODE = {"flag_values": [0, 1], "flag_meanings": "stick slip"}


def attributes(name: str, unit: str | None = None) -> dict[str, object]:
    """units and long_name of a variable; an unknown one is named by its own words."""
    known_unit, text = KNOWN.get(name, (unit or "1", name.replace("_", " ").replace(".", " ")))
    attrs: dict[str, object] = {"units": unit or known_unit, "long_name": text}
    return attrs | (MODE if _COUNTS.get(name) is np.int8 else {})


if TYPE_CHECKING:
    from cosim.coupling import CoupledResult


# whole numbers that models and masters carry as floats
_COUNTS = {"mode": np.int8, "event_mode": np.int8, "slip_count": np.int64}


class BeltSnapshots(Protocol):
    """The belt's contact face at some times, in its own (material) coordinate.

    time (k,) s; position (n,) m; temperature (k, n) degC; contact (k,) m, the contact's centre;
    contact_length m, along the belt.
    """

    @property
    def time(self) -> Array: ...
    @property
    def position(self) -> Array: ...
    @property
    def temperature(self) -> Array: ...
    @property
    def contact(self) -> Array: ...
    @property
    def contact_length(self) -> float: ...


def run_columns(
    result: CoupledResult,
    scenario: BaseModel,
    toml: str,
    *,
    snapshots: BeltSnapshots | None = None,
) -> Columns:
    """A coupled run over ``time`` (n,); scenario: the model that ``toml`` was read into."""
    columns, units = _columns(result)
    columns["coupling_residual"] = result.ledger.residual
    dataset = _dataset(result.time, columns, units)
    outcome = {"status": result.status, "reason": result.reason}
    dataset.attrs.update(_described(scenario, toml, outcome, result.wall_time))
    tables = tables_of(scenario)
    dataset.attrs.update(case="coupled", parameters=json.dumps(tables))
    attach_coupling(dataset, result, tables)
    dataset.attrs["events"] = (
        "mode and slip_count are sampled at the communication points: break-away and re-stick "
        "are known to one interval of time; the motion itself was computed with exact events"
    )
    return dataset if snapshots is None else dataset.merge(_snapshots(snapshots))


def trajectory_columns(
    trajectory: Trajectory, scenario: BaseModel, toml: str, *, wall_time: float | None = None
) -> Columns:
    """A run of the mechanics alone over ``time`` (n,) and ``event_time`` (k,).

    scenario: the model that ``toml`` was read into; wall_time: of the integration, s.
    """
    dataset = _dataset(trajectory.time, trajectory.columns, {})
    dataset.attrs.update(_described(scenario, toml, _outcome(trajectory), wall_time))
    alone = {*type(trajectory.parameters).model_fields, "run"}
    used = {name: table for name, table in tables_of(scenario).items() if name in alone}
    dataset.attrs.update(case="mechanics", parameters=json.dumps(used))
    dataset.attrs["events"] = "event_time: break-away and re-stick, located to rounding"
    return dataset.merge(_events(trajectory.events))


def _columns(result: CoupledResult) -> tuple[dict[str, Array], dict[str, str]]:
    """Columns by port name. An input repeats the output that feeds it: the output is kept."""
    owners = dict.fromkeys(MECHANICAL, "mechanics") | dict.fromkeys(THERMAL, "thermal")
    addresses: dict[str, str] = {}
    for address in result.values:
        participant, _, port = address.partition(".")
        if owners.get(port, participant) == participant:
            addresses.setdefault(port, address)
    columns = {port: result.values[address] for port, address in addresses.items()}
    return columns, {port: result.units[address] for port, address in addresses.items()}


def _dataset(time: Array, columns: Mapping[str, Array], units: Mapping[str, str]) -> Columns:
    variables = {
        name: _column(("time",), name, values, units.get(name)) for name, values in columns.items()
    }
    return Columns(variables, {"time": _column(("time",), "time", np.asarray(time, float))})


def _typed(name: str, values: Array) -> NDArray[Any]:
    values = np.asarray(values)
    if name in _COUNTS and np.all(np.isfinite(values)):
        return values.astype(_COUNTS[name])
    return values


def _described(
    scenario: BaseModel, toml: str, outcome: Mapping[str, str], wall_time: float | None
) -> dict[str, Any]:
    """What a dataset says of its run."""
    title = str(getattr(scenario, "name", "") or "stick-slip")
    found: dict[str, Any] = {
        "title": title,
        **outcome,
        "scenario": toml,
        "defaults": json.dumps(dict(getattr(scenario, "taken", {}))),
        **provenance(),
    }
    if (belt := getattr(scenario, "belt", None)) is not None:
        found[WIDTH] = float(belt.width)
    return found if wall_time is None else found | {"wall_time": float(wall_time)}


def _outcome(trajectory: Trajectory) -> dict[str, str]:
    if trajectory.complete:
        return {"status": "complete", "reason": ""}
    if not trajectory.reason.endswith("KeyboardInterrupt"):
        return {"status": "failed", "reason": trajectory.reason}
    reached = f"{trajectory.time[-1]:.9g} s" if trajectory.time.size else "the start"
    return {"status": "interrupted", "reason": f"interrupted at t = {reached}"}


def _events(events: Array) -> Columns:
    time, mode, x = np.asarray(events, float).reshape(-1, 3).T
    axis = ("event_time",)
    return Columns(
        {"event_mode": _column(axis, "event_mode", mode), "event_x": _column(axis, "event_x", x)},
        {"event_time": _column(axis, "event_time", time)},
    )


def _snapshots(snapshots: BeltSnapshots) -> Columns:
    times, places = ("snapshot_time",), ("belt_position",)
    time = _column(times, "snapshot_time", np.asarray(snapshots.time, float))
    position = _column(places, "belt_position", np.asarray(snapshots.position, float))
    temperature = np.reshape(np.asarray(snapshots.temperature, float), (time.size, position.size))
    contact = np.asarray(snapshots.contact, float)
    reach: Any = {"contact_length": float(snapshots.contact_length)}
    return Columns(
        {
            "belt_temperature": _column((*times, *places), "belt_temperature", temperature),
            "contact_position": _column(times, "contact_position", contact, **reach),
        },
        {"snapshot_time": time, "belt_position": position},
    )


def _column(
    dims: tuple[str, ...], name: str, values: Array, unit: str | None = None, **further: float
) -> Column:
    return Column(dims, _typed(name, values), attributes(name, unit) | further)
