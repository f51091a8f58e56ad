"""Whether x grows the way the surface moves: friction carries the block along, never against it.

Over a record of length T the springs hold the mean of friction, K mean(x) = mean friction, but for
the momentum at its ends, m (v1 - v0) / T. In slip friction is along the surface's motion, and in a
stick the springs take it from one side to the other at most; so its mean is not against the motion.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from cosim.gap.data import Campaign, MeasuredRun

from .doubt import Doubt, far, rounded


def doubts_of_direction(campaign: Campaign, runs: Sequence[MeasuredRun]) -> list[Doubt]:
    """One for each run in which friction would push against the surface."""
    limit = far(len(runs))
    return [doubt for run in runs if (doubt := _doubt(campaign, run, limit)) is not None]


def _doubt(campaign: Campaign, run: MeasuredRun, limit: float) -> Doubt | None:
    x = run.motion.x[np.isfinite(run.motion.x)]
    swing = float(np.ptp(np.quantile(x, (0.01, 0.99))))
    momentum = swing / (run.natural_frequency * run.motion.duration)  # of v1 = -v0, at its largest
    least = limit * campaign.errors.zero * run.noise["x"] + momentum
    mean = float(np.mean(x))
    along = math.copysign(1.0, run.surface_speed)
    if along * mean >= -least:
        return None
    return Doubt(
        "direction", run.name, mean, 0.0, "m",
        f"{run.name}: x is {rounded(1e3 * mean)} mm in the mean, expected is the side to which "
        f"the surface moves ({'above' if along > 0 else 'below'} {rounded(-1e3 * along * least)} "
        "mm), for "
        "friction carries the block along: check the sign of x, of surface_speed, and where x = 0 "
        "is (springs as installed)",
        True, ("measurement.drift",),
    )  # fmt: skip
