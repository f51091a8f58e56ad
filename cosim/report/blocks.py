"""The parameters of a scenario, block by block, as they travel with the results."""

from __future__ import annotations

import json
import warnings
from collections.abc import Iterator
from typing import Any

import xarray as xr
from pydantic import BaseModel
from stickslip import Parameters
from stickslip.packing import GRAVITY

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
