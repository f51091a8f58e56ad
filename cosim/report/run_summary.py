"""The numbers of a run: what `summary.json` and the page show."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
from numpy.typing import NDArray
from stickslip.trajectory import break_away_frequency

from cosim.report.columns import Data
from cosim.report.contents import assessment_numbers

from .bounds import bounds_numbers
from .contents import break_aways, parameter_values, ramp_end, slip_share
from .coupling import coupling_numbers
from .heat_numbers import (
    coupling_ledger,
    end_of_sliding,
    growth,
    heat_ledger,
    heat_shares,
    largest_of,
    last,
    melting,
    melts,
    temperatures,
)
from .quantities import Quantity, ratio, split_units

Array = NDArray[np.float64]


def after_ramp(dataset: Data) -> dict[str, Quantity]:
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
    period = 1.0 / frequency if frequency > 0.0 else None
    return {
        "begin": Quantity(begin, "s"),
        "duration": Quantity(window if reached else 0.0, "s"),
        "break_aways": Quantity(int(starts.size), "1"),
        "frequency": Quantity(frequency if reached else None, "Hz"),
        "mean_period": Quantity(period, "s"),
        "slip_share": Quantity(slip_share(dataset, begin, end), "1"),
        "mean_x": Quantity(time_mean(late, "x"), "m"),
        **_extremes(late, "x", "m"),
        "mean_y": Quantity(time_mean(late, "y"), "m"),
        **_extremes(late, "y", "m"),
        "max_rotation_deg": Quantity(_largest(np.degrees(late["phi"].values)), "deg"),
        "mean_friction_force_x": Quantity(time_mean(late, "friction_force_x"), "N"),
        "mean_heat_flow": Quantity(
            growth(late, "heat") / window if reached and late.sizes["time"] else None, "W"
        ),
    }


def whole_run(dataset: Data) -> dict[str, Quantity]:
    """Totals and extremes of everything recorded."""
    return {
        "break_aways": Quantity(int(break_aways(dataset).size), "1"),
        "slip_share": Quantity(
            slip_share(dataset, float(dataset["time"][0]), float(dataset["time"][-1])), "1"
        ),
        **_extremes(dataset, "x", "m"),
        **_extremes(dataset, "y", "m"),
        "max_rotation_deg": Quantity(_largest(np.degrees(dataset["phi"].values)), "deg"),
        "max_friction_force_x": Quantity(_largest(dataset["friction_force_x"].values), "N"),
        "surface_travel": Quantity(growth(dataset, "surface_travel"), "m"),
        "sliding_distance": Quantity(growth(dataset, "sliding_distance"), "m"),
    }


def time_mean(dataset: Data, name: str) -> float | None:
    """Mean over time by the trapezoidal rule, gaps left out; None without values."""
    time, values = dataset["time"].values, dataset[name].values
    known = np.isfinite(values)
    time, values = time[known], values[known]
    if values.size == 0:
        return None
    if values.size == 1:
        return float(values[0])
    return float(np.trapezoid(values, time) / (time[-1] - time[0]))


def _extremes(dataset: Data, name: str, unit: str) -> dict[str, Quantity]:
    values = dataset[name].values
    values = values[np.isfinite(values)]
    low, high = (float(values.min()), float(values.max())) if values.size else (None, None)
    return {f"min_{name}": Quantity(low, unit), f"max_{name}": Quantity(high, unit)}


def _largest(values: Array) -> float | None:
    values = values[np.isfinite(values)]
    return float(np.abs(values).max()) if values.size else None


def summary(dataset: Data) -> dict[str, Any]:
    """Status, coupling, ledgers, temperatures, melting, stick-slip numbers, bounds that the block
    left, versions, what was left to the defaults (`table.key` -> value), scenario.

    Numbers stand in a tree whose units are in ``units`` (``path.to.key`` -> unit); a number
    that a run does not have (too short, failed, no heat) is None.
    """
    values, units = split_units(_numbers(dataset))
    return {
        "name": dataset.attrs["title"],
        "case": dataset.attrs["case"],
        "status": dataset.attrs["status"],
        "reason": dataset.attrs["reason"],
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
        "time_reached": Quantity(float(time[-1]) if time.size else None, "s"),
        "rows": Quantity(int(time.size), "1"),
        "wall_time": Quantity(dataset.attrs.get("wall_time"), "s"),
    }
    if coupling := coupling_numbers(dataset):
        numbers["coupling"] = coupling
    if time.size == 0:
        return numbers
    numbers["ledger"] = {"mechanics": mechanics_ledger(dataset)}
    if "heat_received" in dataset:
        numbers["ledger"]["heat"] = heat_ledger(dataset)
        numbers["ledger"]["coupling"] = coupling_ledger(dataset)
        numbers["heat_shares"] = heat_shares(dataset)
        numbers["temperatures"] = temperatures(dataset)
        if ends := end_of_sliding(dataset):
            numbers["in_the_end"] = ends
        if melts(dataset):
            numbers["melting"] = melting(dataset)
    numbers["after_run_up"] = after_ramp(dataset)
    numbers["whole_run"] = whole_run(dataset)
    numbers |= bounds_numbers(dataset)
    numbers |= assessment_numbers(dataset)
    return numbers


def mechanics_ledger(dataset: Data) -> dict[str, Quantity]:
    """Works and heats since the start, and what does not add up."""
    largest, work = largest_of(dataset, "energy_residual"), last(dataset, "surface_work")
    return {
        "surface_work": Quantity(work, "J"),
        "external_work": Quantity(last(dataset, "external_work"), "J"),
        "friction_heat": Quantity(last(dataset, "heat"), "J"),
        "damping_heat": Quantity(last(dataset, "damping_heat"), "J"),
        "residual": Quantity(last(dataset, "energy_residual"), "J"),
        "largest_residual": Quantity(largest, "J"),
        "relative_residual": Quantity(ratio(largest, abs(work)), "1"),
    }
