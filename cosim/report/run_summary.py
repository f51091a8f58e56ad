"""The numbers of a run: what `summary.json` and the page show, and what a sweep tells of each run.

Rows carry velocities: means and extremes of a position are those of the cubics through positions
and velocities of two neighbouring rows, of fourth order in their distance.
"""

import json
from typing import Any

import numpy as np
from stickslip.trajectory import break_away_frequency

from cosim.report.columns import Array, Data
from cosim.report.contents import assessment_numbers

from . import heat_numbers as heat
from .bounds import bounds_numbers
from .contents import break_aways, parameter_values, ramp_end, slip_share
from .coupling import coupling_numbers
from .quantities import ratio, with_units


def after_ramp(dataset: Data) -> dict[str, float | None]:
    """What the stick-slip motion is like once the surface has its speed.

    mean_period: from the first to the last break-away in it. frequency: one over that; 0 without
    break-aways, None of a single one.
    """
    begin, end = ramp_end(dataset), float(dataset["time"][-1])
    window = end - begin
    late = dataset.sel(time=slice(begin, None))
    starts = break_aways(dataset)
    starts = starts[(starts >= begin) & (starts <= end)]
    reached = window > 0.0
    frequency = break_away_frequency(starts)
    heats = reached and late.sizes["time"] > 0
    return {
        "begin": begin,
        "duration": window if reached else 0.0,
        "break_aways": int(starts.size),
        "frequency": frequency if reached else None,
        "mean_period": 1.0 / frequency if frequency > 0.0 else None,
        "slip_share": slip_share(dataset, begin, end),
        "mean_x": time_mean(late, "x", "vx"),
        **_extremes(late, "x", "vx"),
        "mean_y": time_mean(late, "y", "vy"),
        **_extremes(late, "y", "vy"),
        "max_rotation_deg": _rotation(late),
        "mean_friction_force_x": time_mean(late, "friction_force_x"),
        "mean_heat_flow": heat.growth(late, "heat") / window if heats else None,
    }


def whole_run(dataset: Data) -> dict[str, float | None]:
    """Totals and extremes of everything recorded."""
    time = dataset["time"].values
    return {
        "break_aways": int(break_aways(dataset).size),
        "slip_share": slip_share(dataset, float(time[0]), float(time[-1])),
        **_extremes(dataset, "x", "vx"),
        **_extremes(dataset, "y", "vy"),
        "max_rotation_deg": _rotation(dataset),
        "max_friction_force_x": heat.extremes(np.abs(dataset["friction_force_x"].values))[1],
        "surface_travel": heat.growth(dataset, "surface_travel"),
        "sliding_distance": heat.growth(dataset, "sliding_distance"),
    }


def time_mean(dataset: Data, name: str, rate: str = "") -> float | None:
    """Mean over time, gaps left out; None without values. rate: variable that it changes by."""
    rates = dataset[rate].values if rate else np.zeros(dataset.sizes["time"])
    return mean_of_cubics(dataset["time"].values, dataset[name].values, rates)


def mean_of_cubics(time: Array, values: Array, rates: Array) -> float | None:
    """Mean over time (n,) s of values with rates of change; with rates of 0, of trapezoids."""
    known = np.isfinite(values)
    time, values, rates = time[known], values[known], rates[known]
    if values.size < 2:
        return float(values[0]) if values.size else None
    bulge = np.sum(np.diff(time) ** 2 * -np.diff(rates)) / 12.0
    return float((np.trapezoid(values, time) + bulge) / (time[-1] - time[0]))


def _extremes(dataset: Data, name: str, rate: str) -> dict[str, float | None]:
    """Also between the rows."""
    values, size = dataset[name].values, np.diff(dataset["time"].values)
    rates, rise = dataset[rate].values, np.diff(values)
    first, last = size * rates[:-1], size * rates[1:]
    # first + 2 square s + 3 cube s2 = 0 at a part s of an interval
    square, cube = 3.0 * rise - 2.0 * first - last, first + last - 2.0 * rise
    root = np.sqrt(np.maximum(square**2 - 3.0 * cube * first, 0.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        turns = -first / np.stack([square + root, square - root])
    s = np.where((turns > 0.0) & (turns < 1.0), turns, 0.0)
    between = values[:-1] + s * (first + s * (square + s * cube))
    low, high = heat.extremes(np.append(values, between))
    return {f"min_{name}": low, f"max_{name}": high}


def _rotation(dataset: Data) -> float | None:
    """The largest, either way, deg."""
    ends = [end for end in _extremes(dataset, "phi", "omega").values() if end is not None]
    return max((float(np.degrees(abs(end))) for end in ends), default=None)


def summary(dataset: Data) -> dict[str, Any]:
    """Status, coupling, ledgers, temperatures, melting, stick-slip numbers, bounds that the block
    left, versions, what was left to the defaults (`table.key` -> value), scenario.

    Numbers stand in a tree whose units are in ``units`` (``path.to.key`` -> unit); a number
    that a run does not have (too short, failed, no heat) is None.
    """
    values, units = with_units(_numbers(dataset))
    return {
        "name": dataset.attrs["title"],
        **{key: dataset.attrs[key] for key in ("case", "status", "reason")},
        **values,
        "units": units,
        "events": dataset.attrs["events"],
        "created": dataset.attrs["created"],
        "versions": json.loads(dataset.attrs["versions"]),
        "defaults": json.loads(dataset.attrs.get("defaults", "{}")),
        "parameters": parameter_values(dataset),
        "scenario": dataset.attrs["scenario"],
    }


def _numbers(dataset: Data) -> dict[str, Any]:
    time = dataset["time"].values
    numbers: dict[str, Any] = {
        "time_reached": float(time[-1]) if time.size else None,
        "rows": int(time.size),
        "wall_time": dataset.attrs.get("wall_time"),
    }
    if coupling := coupling_numbers(dataset):
        numbers["coupling"] = coupling
    if time.size == 0:
        return numbers
    numbers["ledger"] = {"mechanics": mechanics_ledger(dataset)}
    if "heat_received" in dataset:
        numbers["ledger"]["heat"] = heat.heat_ledger(dataset)
        numbers["ledger"]["coupling"] = heat.coupling_ledger(dataset)
        numbers["heat_shares"] = heat.heat_shares(dataset)
        numbers["temperatures"] = heat.temperatures(dataset)
        if ends := heat.end_of_sliding(dataset):
            numbers["in_the_end"] = ends
        if heat.melts(dataset):
            numbers["melting"] = heat.melting(dataset)
    numbers |= {"after_run_up": after_ramp(dataset), "whole_run": whole_run(dataset)}
    return numbers | bounds_numbers(dataset) | assessment_numbers(dataset)


def mechanics_ledger(dataset: Data) -> dict[str, float | None]:
    """Works and heats since the start, and what does not add up."""
    largest, work = heat.largest_of(dataset, "energy_residual"), heat.last(dataset, "surface_work")
    return {
        "surface_work": work,
        "external_work": heat.last(dataset, "external_work"),
        "friction_heat": heat.last(dataset, "heat"),
        "damping_heat": heat.last(dataset, "damping_heat"),
        "residual": heat.last(dataset, "energy_residual"),
        "largest_residual": largest,
        "relative_residual": ratio(largest, abs(work)),
    }
