"""Whether short sticks go with the surface as stated, where none is long enough by itself.

A stick that lasts a tenth of a free vibration is as straight as the crest of one, and its slope
alone says little. All of a record together do: it is cut into sticks, which are lines of one slope,
and slips, which are free vibrations (`data.partition`), for one slope after the other. The slope
whose cut fits best is that of the surface, whatever the friction is; where nothing sticks no slope
fits better than another, and nothing is said. The value is the median over the sticks of that cut,
its error that of a median, as much larger as the cut leaves more than noise.

With set-points that scatter as they are said to and a contact that creeps as little as
`stick_speed` allows, a run is doubted by chance in `LEVEL` / runs of cases, either side alike.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from cosim.gap.data import Campaign, MeasuredRun
from cosim.gap.data.partition import STICK, partition_cost
from cosim.gap.data.sticks import DENSITY, averaged

from .doubt import Doubt, far
from .stick_speed import SHEARED, Slope, doubt_of_speed, is_off, stick_slope, throughout
from .windows import scatter

#: Slopes that are tried, as parts of the stated speed, in steps of twice what the slope of a stick
#: may be off within a cut; those beside the stated one come first.
NEAR = (-1, 0, 1)
FAR = range(-11, 12)
_STEP = 0.06
#: Fewest sticks whose scatter tells the error of their median, and samples in each.
STICKS, SAMPLES = 8, 4


def doubts_of_short_sticks(campaign: Campaign, runs: Sequence[MeasuredRun]) -> list[Doubt]:
    """One for each run whose short sticks are faster, or slower, than the surface is said to be.

    runs : those whose springs are not in doubt: slips are taken to swing as stated
    """
    known = math.hypot(campaign.errors.surface_speed, SHEARED)
    limit = far(2 * len(runs))
    long = [slope for run in runs if (slope := stick_slope(run)) is not None]
    there = {slope.run.name for slope in long}
    found = [short_slope(run) for run in runs if run.name not in there]
    short = [
        slope
        for slope in found
        if slope is not None and slope.error < known * abs(slope.run.surface_speed)
    ]
    return [
        doubt_of_speed(slope.run, slope.value, limit * known)
        for slope in short
        if is_off(slope, [*long, *short], runs, limit, known)
    ]


def short_slope(run: MeasuredRun) -> Slope | None:
    """None where no slope is told from another, or sticks are too few or not throughout."""
    seen = np.isfinite(run.motion.x)
    time, x = run.motion.time[seen], run.motion.x[seen]
    each = max(int(2.0 * math.pi / run.natural_frequency / run.motion.interval / DENSITY), 1)
    time, x = averaged(time, each), averaged(x, each)
    if time.size < STICKS * SAMPLES:
        return None
    pieces, cost = _best_cut(run, time, x, scatter(run) / math.sqrt(each))
    # a sample at either end may be of the slip
    sticks = [(a + 1, b - 1) for kind, a, b in pieces if kind == STICK and b - a >= SAMPLES + 2]
    swing = float(np.ptp(np.quantile(x, (0.01, 0.99))))
    if len(sticks) < STICKS or not throughout(np.array([a for a, _ in sticks]), x, swing):
        return None
    along = math.copysign(1.0, run.surface_speed)
    found = along * np.array([np.polyfit(time[a:b] - time[a], x[a:b], 1)[0] for a, b in sticks])
    more = math.sqrt(max(cost / time.size, 1.0))
    error = more * 1.2533 * float(np.std(found, ddof=1)) / math.sqrt(found.size)
    return Slope(run, float(np.median(found)), error)


def _best_cut(
    run: MeasuredRun, time: np.ndarray, x: np.ndarray, noise: float
) -> tuple[list[tuple[int, int, int]], float]:
    """Pieces and misfit, in units of the noise squared, of the slope that fits best.

    Where the stated one is better than those beside it, no other is tried.
    """

    def cut(number: int) -> tuple[list[tuple[int, int, int]], float]:
        speed = math.exp(_STEP * number) * run.surface_speed
        return partition_cost(time, x, speed, run.natural_frequency, noise)

    cuts = {number: cut(number) for number in NEAR}
    if min(cuts.values(), key=lambda found: found[1]) is not cuts[0]:
        cuts |= {number: cut(number) for number in FAR if number not in cuts}
    return min(cuts.values(), key=lambda found: found[1])
