"""What a run's motion is worth, as numbers of the summary."""

from __future__ import annotations

import json
from typing import Any

import xarray as xr
from stickslip.steady_motion import Assessment

from .quantities import Quantity

ATTRIBUTE = "assessment"
STABILITY_UNITS = {
    "growth": "1",
    "cycle": "s",
    "time_to_grow": "s",
    "amplification": "1",
    "pretension": "m",
    "least_pretension": "m",
}
REGIME_UNITS = {
    "frequency": "Hz",
    "slip_share": "1",
    "mean_x": "m",
    "half_range_x": "m",
    "max_y": "m",
    "max_rotation_deg": "deg",
}


def attach_assessment(dataset: xr.Dataset, assessment: Assessment | None) -> None:
    """Let a dataset carry the assessment of its motion; None: there is none."""
    if assessment is not None:
        dataset.attrs[ATTRIBUTE] = json.dumps(assessment.as_dict())


def assessment_numbers(dataset: xr.Dataset) -> dict[str, Any]:
    """Stability and regimes with units; nothing for a run that was not assessed."""
    if ATTRIBUTE not in dataset.attrs:
        return {}
    found = json.loads(dataset.attrs[ATTRIBUTE])
    return found | {
        "stability": _with_units(found["stability"], STABILITY_UNITS),
        "regimes": {
            start: _with_units(regime, REGIME_UNITS) for start, regime in found["regimes"].items()
        },
    }


def _with_units(numbers: dict[str, Any], units: dict[str, str]) -> dict[str, Any]:
    return {
        key: Quantity(value, units[key]) if key in units else value
        for key, value in numbers.items()
    }
