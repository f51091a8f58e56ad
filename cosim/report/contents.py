"""What a dataset says of its run: the parameters, and when the block sticks and when it slips."""

from __future__ import annotations

import json
import warnings
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from pydantic import BaseModel
from stickslip import Parameters
from stickslip.packing import GRAVITY

if TYPE_CHECKING:
    from thermal import ThermalParameters

Blocks = dict[str, dict[str, dict[str, Any]]]


def blocks_of(scenario: BaseModel) -> Blocks:
    """Block -> key -> value, unit and description, from a pydantic model.

    A block is a model that holds numbers; models that only group blocks are seen through, so
    the blocks are found at any depth. Numbers beside blocks are left out.
    """
    return {name: _entries(block) for name, block in _walk(scenario)}


def _walk(model: BaseModel) -> Iterator[tuple[str, BaseModel]]:
    for name in type(model).model_fields:
        value = getattr(model, name)
        if not isinstance(value, BaseModel):
            continue
        if any(isinstance(inner, BaseModel) for _, inner in value):
            yield from _walk(value)
        else:
            yield name, value


def _entries(block: BaseModel) -> dict[str, dict[str, Any]]:
    values = block.model_dump(mode="json")
    entries = {}
    for key, field in type(block).model_fields.items():
        extra = field.json_schema_extra if isinstance(field.json_schema_extra, dict) else {}
        unit = str(extra.get("unit", ""))
        description = (field.description or "").removesuffix(f"[{unit}]").strip()
        entries[key] = {"value": values[key], "unit": unit, "description": description}
    return entries


def stored_blocks(dataset: xr.Dataset) -> Blocks:
    """The blocks that a dataset carries."""
    return json.loads(dataset.attrs["parameters"])


def value_of(dataset: xr.Dataset, block: str, key: str) -> Any:
    """One parameter's value; None where the scenario has no such block or key."""
    return stored_blocks(dataset).get(block, {}).get(key, {}).get("value")


def mechanics_of(dataset: xr.Dataset) -> Parameters:
    """The mechanical parameters that a dataset was computed with."""
    with warnings.catch_warnings():
        # whatever there is to warn of was said when the scenario was read
        warnings.simplefilter("ignore")
        return Parameters.model_validate(_selected(dataset, Parameters))


def thermal_of(dataset: xr.Dataset) -> ThermalParameters:
    """The thermal parameters that a dataset was computed with.

    A scenario states the contact's radius and the block's mass once, with the rig.
    """
    from thermal import ThermalParameters  # finite elements: only for who asks for them

    blocks = _selected(dataset, ThermalParameters)
    radius, mass = (value_of(dataset, "rig", key) for key in ("contact_radius", "mass"))
    if radius is not None:
        blocks["contact"] = {"radius": radius, "load": GRAVITY * mass} | blocks.get("contact", {})
    return ThermalParameters.model_validate(blocks)


def _selected(dataset: xr.Dataset, model: type[BaseModel]) -> dict[str, dict[str, Any]]:
    return {
        name: {key: entry["value"] for key, entry in entries.items()}
        for name, entries in stored_blocks(dataset).items()
        if name in model.model_fields
    }


Array = NDArray[np.float64]
SLIP = 1.0


def run_up_time(dataset: xr.Dataset) -> float:
    """End of the surface's speed ramp, s; 0 without one."""
    return float(value_of(dataset, "surface", "run_up_time") or 0.0)


def has_events(dataset: xr.Dataset) -> bool:
    """Whether the dataset carries located events (else modes at the recorded times)."""
    return "event_time" in dataset.coords


def mode_changes(dataset: xr.Dataset) -> tuple[Array, Array]:
    """Times (k,) s and modes after them (k,), the first entry being the run's start.

    Without located events a change is put halfway between the two rows that tell it.
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
    middles = 0.5 * (time[at] + time[at + 1])
    return np.concatenate([time[:1], middles]), np.concatenate([mode[:1], mode[at + 1]])


def slip_intervals(dataset: xr.Dataset) -> Array:
    """Begin and end (k, 2) of every slip phase, s."""
    times, modes = mode_changes(dataset)
    if times.size == 0:
        return np.empty((0, 2))
    ends = np.append(times[1:], max(dataset["time"].values[-1], times[-1]))
    slipping = modes == SLIP
    return np.column_stack([times[slipping], ends[slipping]])


def slip_share(dataset: xr.Dataset, begin: float, end: float) -> float | None:
    """Fraction of begin ... end (s) in slip; None for an empty window."""
    if not end > begin:
        return None
    clipped = np.clip(slip_intervals(dataset), begin, end)
    return float(np.sum(clipped[:, 1] - clipped[:, 0]) / (end - begin))


def break_aways(dataset: xr.Dataset) -> Array:
    """Times of break-away, s (k,).

    Without located events: each count of `slip_count` is put in the middle of its interval, so
    that a break-away whose slip ended before the next row is not lost.
    """
    if has_events(dataset):
        return dataset["event_time"].values[dataset["event_mode"].values == 1]
    time, count = dataset["time"].values, dataset["slip_count"].values.astype(float)
    known = np.isfinite(count)
    time, count = time[known], count[known]
    middles = 0.5 * (time[1:] + time[:-1])
    return np.repeat(middles, np.maximum(np.diff(count), 0.0).astype(int))
