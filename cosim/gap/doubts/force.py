"""Whether a measured spring force and the stated springs are the same.

`force` is what all springs together pull the block back with along x, N: positive where x is, so
that it grows by K = 4 k for each metre of x. It is compared with the springs, and with nothing
else: the model is fitted to places alone.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from cosim.gap.data import Campaign, MeasuredRun

from .doubt import Doubt, far, rounded

#: Standard deviation of what springs that are not linear, or not along x, make of their slope.
SHAPE = 0.02
#: What gives another slope by itself.
EXPLAINED_BY = ("spring_hardening", "spring_misalignment", "measurement.scale")


def doubts_of_force(campaign: Campaign, runs: Sequence[MeasuredRun]) -> list[Doubt]:
    """One for each run in which the force grows otherwise with x than the springs say."""
    measured = [run for run in runs if "force" in run.motion.channels]
    limit = far(len(measured))
    known = math.hypot(campaign.errors.stiffness, SHAPE)
    doubts = []
    for run in measured:
        told = slope_of(run)
        if told is None:
            continue
        slope, error = told
        wanted = run.total_stiffness
        if abs(slope - wanted) > limit * math.hypot(error, known * wanted):
            doubts.append(_doubt(run, slope, limit * known))
    return doubts


def slope_of(run: MeasuredRun) -> tuple[float, float] | None:
    """Force for each metre of x, N/m, and its standard error; None where x hardly moves."""
    force, x = run.motion["force"], run.motion.x
    seen = np.isfinite(force) & np.isfinite(x)
    if seen.sum() < 3:
        return None
    force, x = force[seen] - force[seen].mean(), x[seen] - x[seen].mean()
    spread = float(x @ x) - x.size * run.noise["x"] ** 2  # noise of x flattens the slope
    if spread <= x.size * run.noise["x"] ** 2:
        return None
    slope = float(x @ force) / spread
    left = force - slope * x
    return slope, math.sqrt(float(left @ left) / (x.size - 2) / spread)


def _doubt(run: MeasuredRun, slope: float, off: float) -> Doubt:
    wanted = run.total_stiffness
    hint = (
        "its sign is the other one (positive where the springs pull the block back from positive x)"
        if slope < 0.0
        else "check the stiffness, the scale of x and the unit of force"
    )
    return Doubt(
        "force", run.name, slope, wanted, "N/m",
        f"{run.name}: force grows by {rounded(slope)} N for each metre of x, expected are "
        f"{rounded(wanted)} N within {100.0 * off:.2g} %, those of four springs of "
        f"{run.stiffness:g} N/m: {hint}",
        False, EXPLAINED_BY,
    )  # fmt: skip
