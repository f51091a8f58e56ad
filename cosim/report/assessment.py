"""What a run's motion is worth, as numbers of the summary."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import Any

import xarray as xr
from stickslip.steady_motion import Assessment
from stickslip.steady_motion.regimes import OWN

from .quantities import Quantity, finite

ATTRIBUTE = "assessment"
REGIME_UNITS = {
    "frequency": "Hz", "slip_share": "1", "mean_x": "m", "half_range_x": "m", "max_y": "m",
    "max_rotation_deg": "deg",
}


def attach_assessment(dataset: xr.Dataset, assessment: Assessment | None) -> None:
    """Let a dataset carry the assessment of its motion; None: there is none."""
    if assessment is None:
        return
    borders = assessment.borders
    dataset.attrs[ATTRIBUTE] = json.dumps({
        "verdict": assessment.stability.verdict,
        "straight": assessment.stability.straight,
        "growth": assessment.stability.growth,
        "cycle": assessment.stability.period,
        "time_to_grow": assessment.stability.time_to_grow,
        "amplification": finite(assessment.stability.amplification),
        "pretension": assessment.pretension,
        "least_pretension": None if borders is None else borders.least,
        "unstable_pretensions": None if borders is None else borders.windows,
        "regimes": {start: asdict(regime) for start, regime in assessment.regimes.items()},
    })


def assessment_numbers(dataset: xr.Dataset) -> dict[str, Any] | None:
    """Stability and regimes with units; None for a run that was not assessed."""
    if ATTRIBUTE not in dataset.attrs:
        return None
    found = json.loads(dataset.attrs[ATTRIBUTE])
    regimes = found["regimes"]
    own = regimes[OWN]["name"]
    return {
        "stability": {
            "verdict": found["verdict"],
            "motion": "along the line" if found["straight"] else "its own",
            "growth": Quantity(found["growth"], "1"),
            "cycle": Quantity(found["cycle"], "s"),
            "time_to_grow": Quantity(found["time_to_grow"], "s"),
            "amplification": Quantity(found["amplification"], "1"),
            "pretension": Quantity(found["pretension"], "m"),
            "least_pretension": Quantity(found["least_pretension"], "m"),
            "unstable_pretensions": found["unstable_pretensions"],
        },
        "regimes": {
            start: {"name": regime["name"]}
            | {key: Quantity(regime[key], unit) for key, unit in REGIME_UNITS.items()}
            for start, regime in regimes.items()
        },
        "other_regimes": [start for start in regimes if regimes[start]["name"] != own],
    }
