"""The numbers of a run: what `summary.json` and the page show."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import xarray as xr

from .assessment import assessment_numbers
from .heat_numbers import coupling_ledger, heat_ledger, heat_shares, temperatures
from .melting_numbers import melting, melts
from .motion_numbers import after_run_up, whole_run
from .quantities import Quantity, ratio, split_units


def summary(dataset: xr.Dataset) -> dict[str, Any]:
    """Status, ledgers, shares, temperatures, melting, stick-slip numbers, versions, scenario.

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
        "parameters": _plain(json.loads(dataset.attrs["parameters"])),
        "scenario": dataset.attrs["scenario"],
    }


def _numbers(dataset: xr.Dataset) -> dict[str, Any]:
    time = dataset["time"].values
    numbers: dict[str, Any] = {
        "time_reached": Quantity(float(time[-1]) if time.size else None, "s"),
        "rows": Quantity(int(time.size), "1"),
        "wall_time": Quantity(dataset.attrs.get("wall_time"), "s"),
    }
    if time.size == 0:
        return numbers
    numbers["ledger"] = {"mechanics": mechanics_ledger(dataset)}
    if "heat_received" in dataset:
        numbers["ledger"]["heat"] = heat_ledger(dataset)
        numbers["ledger"]["coupling"] = coupling_ledger(dataset)
        numbers["heat_shares"] = heat_shares(dataset)
        numbers["temperatures"] = temperatures(dataset)
        if melts(dataset):
            numbers["melting"] = melting(dataset)
    numbers["after_run_up"] = after_run_up(dataset)
    numbers["whole_run"] = whole_run(dataset)
    numbers |= assessment_numbers(dataset)
    return numbers


def mechanics_ledger(dataset: xr.Dataset) -> dict[str, Quantity]:
    """Works and heats since the start, and what does not add up."""
    residual = dataset["energy_residual"].values
    largest = float(np.nanmax(np.abs(residual), initial=0.0))
    work = _last(dataset, "surface_work")
    return {
        "surface_work": Quantity(work, "J"),
        "external_work": Quantity(_last(dataset, "external_work"), "J"),
        "friction_heat": Quantity(_last(dataset, "heat"), "J"),
        "damping_heat": Quantity(_last(dataset, "damping_heat"), "J"),
        "residual": Quantity(float(residual[-1]), "J"),
        "largest_residual": Quantity(largest, "J"),
        "relative_residual": Quantity(ratio(largest, abs(work)), "1"),
    }


def _last(dataset: xr.Dataset, name: str) -> float:
    return float(dataset[name].values[-1])


def _plain(blocks: dict[str, Any]) -> dict[str, Any]:
    return {
        block: {key: entry["value"] for key, entry in entries.items()}
        for block, entries in blocks.items()
    }
