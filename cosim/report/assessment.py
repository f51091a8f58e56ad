"""Stability and regimes of a motion: numbers of the summary, and what they mean, in sentences.

The sentences take the numbers as `summary.json` and `stability.json` hold them: ``stability``,
``regimes`` and ``other_regimes``.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import xarray as xr
from stickslip.steady_motion import Assessment
from stickslip.steady_motion.regimes import CREEPING, DISTURBED, OWN, RAMP, REST, RIDING, STARTS
from stickslip.steady_motion.stability import GUIDED, NEUTRAL, UNSTABLE

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


#: Beside the line by more than this, m and degrees, a motion is told to be.
BENT_LENGTH, BENT_ANGLE_DEG = 2e-3, 2.0
SHORT = {
    DISTURBED: "disturbed",
    REST: "from rest",
    RIDING: "riding on the surface",
    RAMP: "from a speed ramp",
}
EXPLAINED_NOUN = {
    "stick-slip": "stick and slip",
    "sliding": "slide",
    "sticking": "stick",
    CREEPING: "creep",
}
#: A tenth of a millimetre, which every rig is off by, times this is a centimetre.
MUCH = 100.0
EXPLAINED = {
    "stick-slip": "sticks and slips",
    "sliding": "slides without ever sticking",
    "sticking": "sticks and never slips",
    CREEPING: "creeps as fast as the surface, and never breaks away",
}


def stability_sentence(numbers: Mapping[str, Any]) -> str:
    """Whether a rig could make the motion; from the summary's ``stability``."""
    found = numbers["stability"]
    if found["verdict"] == GUIDED:
        return "The rig allows motion along x alone: there is nothing to be unstable."
    what = "The motion along the line" if found["motion"] == "along the line" else "This motion"
    bent = _bent(numbers)
    if found["verdict"] != UNSTABLE:
        fares = "neither grow nor die out" if found["verdict"] == NEUTRAL else "die out"
        return (
            f"{what} is {found['verdict']}: small disturbances to the side and in rotation "
            f"{fares}, by the factor {found['growth']:.3g} in {found['cycle']:.3g} s. "
            f"{run_up_sentence(numbers)}".rstrip()
            + _further(found)
            + bent
        )
    return (
        f"{what} is unstable: a small disturbance to the side or in rotation grows tenfold in "
        f"{found['time_to_grow']:.3g} s, and no rig is without one.{_remedy(found)}{bent}"
    )


def unstable_line(numbers: Mapping[str, Any]) -> str:
    """The same of an unstable motion, for a terminal."""
    found = numbers["stability"]
    least, now = found["least_pretension"], found["pretension"]
    remedy = (
        ""
        if least is None
        else (f"; stable from {1e3 * least:.3g} mm of pretension (now {1e3 * now:.3g})")
    )
    motion = "the line" if found["motion"] == "along the line" else "this motion"
    time = f"{found['time_to_grow']:.3g} s"
    return f"disturbances of {motion} grow tenfold in {time}, so that no rig keeps to it{remedy}"


def _remedy(found: Mapping[str, Any]) -> str:
    least = found["least_pretension"]
    if found["unstable_pretensions"] is None:
        return ""
    if least is None:
        return " No pretension that was tried makes it stable."
    return (
        f" Springs stretched by {1e3 * least:.3g} mm as installed would hold the block to it; "
        f"they are by {1e3 * found['pretension']:.3g} mm."
    )


def run_up_sentence(numbers: Mapping[str, Any]) -> str:
    """What the ramp to a stable motion makes of a disturbance, where that is much; else nothing."""
    amplification = numbers["stability"]["amplification"] or 0.0
    if amplification < MUCH:
        return ""
    return (
        f"In the speed ramp before it a disturbance grows up to {amplification:.2g} "
        "times: a rig that is not as drawn may have swerved by then, and stay there."
    )


def _bent(numbers: Mapping[str, Any]) -> str:
    """Where a rig that is not as drawn keeps aside of the line, how far."""
    regime = numbers["regimes"].get(DISTURBED, numbers["regimes"][OWN])
    if regime["max_y"] < BENT_LENGTH and regime["max_rotation_deg"] < BENT_ANGLE_DEG:
        return ""
    return (
        " Started 0.1 mm aside and turned by 1 mrad, the block comes to "
        f"{EXPLAINED_NOUN[regime['name']]} up to {1e3 * regime['max_y']:.2g} mm beside its line "
        f"and turned by up to {regime['max_rotation_deg']:.2g}°."
    )


def _further(found: Mapping[str, Any]) -> str:
    """Where else it would not be stable."""
    windows = found["unstable_pretensions"] or []
    told = [
        f"{1e3 * low:.3g} to {1e3 * high:.3g} mm" if high is not None else f"{1e3 * low:.3g} mm on"
        for low, high in windows
    ]
    if not told:
        return ""
    return (
        f" It is not with a pretension of {', nor of '.join(told)}; here it is "
        f"{1e3 * found['pretension']:.3g} mm."
    )


def regime_sentence(numbers: Mapping[str, Any]) -> str:
    """Which regime the run is in, and what exists beside it; from the summary."""
    found, others = numbers["regimes"], numbers["other_regimes"]
    own = found[OWN]["name"]
    line = f"This run {EXPLAINED[own]}."
    if not others:
        starts = [SHORT[start] for start in found if start != OWN]
        return f"{line} So does the rig {_listed(starts)}."
    told = "; ".join(f"{STARTS[start]} it {EXPLAINED[found[start]['name']]}" for start in others)
    return f"{line} Another regime exists beside it: {told}."


def _listed(words: list[str]) -> str:
    return " and ".join(filter(None, [", ".join(words[:-1]), *words[-1:]]))
