"""C18: whether static strengthening occurs, and is contained in coefficients that leave it out."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
from stickslip.reference.scheme_errors import MENDED, PRINTED

from cosim.studies.reproduction.cases import STUDY

from ..cases import (
    DATASET_1,
    GUIDED,
    GUIDED_ASSUMED,
    SCATTER_ASSUMED,
    SETTLING,
    SPEEDS,
    STEADY,
    STIFFNESSES,
    Case,
    exact_motion,
    exact_parameters,
    scheme_motion,
)
from ..claim import OPEN, Check, Claim, Margin, Row, Turn
from ..motion import Motion

#: Hold by speed above which strengthening is told to be considerable, m.
THRESHOLD = 1e-4
#: Growth of mu_s in a decade of the hold time; the longest hold that was seen to need, s (§2.4).
GROWTH, MEASURED_HOLD, MEASURED_SPEED = 0.30, 0.3, 1e-4
#: A coefficient contains what differs by no more than this part of it from run to run.
CONTAINED = 0.1
#: Of the series: what a block still sticks on in every model.
FASTEST = SPEEDS[3]
SERIES = [
    DATASET_1.changed(stiffness=k, speed=v)
    for k in (STIFFNESSES[0], STIFFNESSES[-1])
    for v in (SPEEDS[0], FASTEST)
]


def holds(motion: Motion) -> float:
    """Median duration of a stick, s; NaN where there is none."""
    sticks = motion.phases[motion.phases[:, 2] == 0]
    lengths = sticks[:, 1] - sticks[:, 0]
    lengths = lengths[lengths > 0.0]  # the scheme has sticks that end as they begin
    return float(np.median(lengths)) if len(lengths) else math.nan


@cache
def hold_times(case: Case) -> tuple[float, float, float]:
    """As printed, mended, exact with the block guided along x, s."""
    return (
        holds(scheme_motion(case, PRINTED).last(STEADY)),
        holds(scheme_motion(case, MENDED).last(STEADY)),
        holds(exact_motion(exact_parameters(case, rig=GUIDED)).since(SETTLING)),
    )


def judge() -> Claim:
    """Hold times of the series against the threshold, and what they would make of mu_s."""
    times = np.array([hold_times(case) for case in SERIES])
    needed = THRESHOLD / SPEEDS[0]
    shortest, longest = np.nanmin(times, axis=0), np.nanmax(times, axis=0)
    spread = GROWTH * np.log10(longest / shortest)
    return Claim(
        "C18",
        "static strengthening occurs, and coefficients fitted without it contain it",
        (
            Row(
                "least hold for strengthening at 0.15 m/s",
                "0.1 ms",
                STUDY["least_hold"],
                derived=1e4 * needed,
                how="1e-4 m by 0.15 m/s",
            ),
            *(
                Row(f"hold at k {case.stiffness:g} N/m, v {case.speed:g} m/s", "s", None, *row)
                for case, row in zip(SERIES, times.tolist(), strict=True)
            ),
            Row("µ_s differs over these holds by", "1", None, *spread.tolist()),
        ),
        (
            Check(
                "holds are longer than strengthening needs",
                *(bool(hold > needed) for hold in times[0]),
                margin=Margin("hold at 0.15 m/s, exact", float(times[0, 2]), needed, "s"),
                turns=(_unextrapolated(float(times[0, 2])),),
            ),
            Check(
                "where it occurs, one µ_s contains it: over the series it differs by less than "
                f"{100.0 * CONTAINED:.0f} % of µ_s",
                *(bool(one < CONTAINED * DATASET_1.mu_s) for one in spread),
                margin=Margin(
                    "difference over the series, exact",
                    float(spread[2]),
                    CONTAINED * DATASET_1.mu_s,
                ),
                turns=(_weaker(float(longest[2] / shortest[2])),),
            ),
        ),
        remarks=(
            f"A coefficient that was fitted at one hold contains the strengthening of that hold. "
            f"Over the series holds differ by a factor of {longest[2] / shortest[2]:.0f} (exact), "
            f"which at β = {GROWTH:g} a decade is {spread[2]:.2f} in a µ_s of "
            f"{DATASET_1.mu_s:g}: then one number is not enough. If it is, there is no "
            "strengthening of that size.",
        ),
        place="§4.6.2, §2.4",
        rests="a growth that was measured at sliding speeds up to 1e-4 m/s",
        assumed=(SCATTER_ASSUMED, GUIDED_ASSUMED, "β = 0.30 a decade of the hold time (§2.4)"),
    )


def _unextrapolated(hold: float) -> Turn:
    """The hold that was seen to be needed at the fastest sliding that was measured."""
    return Turn(
        f"the {MEASURED_HOLD} s of {MEASURED_SPEED:g} m/s instead of three decades further",
        f"hold {hold:.3f} s",
        hold > MEASURED_HOLD,
        OPEN,
    )


def _weaker(ratio: float) -> Turn:
    """The least growth that its own uncertainty allows."""
    least = GROWTH - 0.03
    differs = least * math.log10(ratio)
    return Turn(
        f"β = {least:g}, the least of its ±0.03",
        f"µ_s differs by {differs:.2f}",
        differs < CONTAINED * DATASET_1.mu_s,
        OPEN,
    )
