"""What a rig can do, read off what its campaign did."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from cosim.gap.data import Campaign, MeasuredRun

#: Surface speeds: from the slowest that was used, divided by this, to the fastest, times this.
SPEED_FACTOR = 3.0
#: The heaviest block may carry as much again; beside each of the stiffest springs goes another.
LOAD_FACTOR = STIFFNESS_FACTOR = 2.0
#: Speeds tried, evenly spaced on a logarithmic scale.
SPEEDS = 6
#: How a run may start: laid on the running surface with slack springs and carried along, or pulled
#: as far as the campaign has seen the block and let go.
STARTS = ("carried", "let go")


@dataclass(frozen=True)
class Experiment:
    """A run that could be made.

    Attributes
    ----------
    mass, stiffness, surface_speed : kg, N/m (one of four springs), m/s
    start : one of `STARTS`
    pull : m, where the block is let go
    changed : how many of mass and stiffness the campaign has not used
    """

    mass: float
    stiffness: float
    surface_speed: float
    start: str
    pull: float
    changed: int


def tracked(campaign: Campaign) -> list[MeasuredRun]:
    """The runs that were seen moving."""
    return [run for run in campaign.runs if run.track is not None]


def experiments(campaign: Campaign, most: int | None = None) -> list[Experiment]:
    """All combinations within the range, the ones that need nothing new first.

    most : about so many at most; stiffness and mass are left as they were before speeds are.
    """
    runs = tracked(campaign)
    used_masses = sorted({run.mass for run in runs})
    used_springs = sorted({run.stiffness for run in runs})
    masses = [*used_masses, LOAD_FACTOR * used_masses[-1]]
    springs = [*used_springs, STIFFNESS_FACTOR * used_springs[-1]]
    choices = ((masses, springs), (masses, used_springs), (used_masses, used_springs[:1]))
    speeds = _speeds(runs)
    for masses, springs in choices:
        if most is None or len(masses) * len(springs) * len(speeds) * len(STARTS) <= most:
            break
    pull = _farthest(runs)
    found = [
        Experiment(m, k, v, start, pull, (m not in used_masses) + (k not in used_springs))
        for k, m, v, start in product(springs, masses, speeds, STARTS)
    ]
    return sorted(found, key=lambda one: one.changed)


def _speeds(runs: Sequence[MeasuredRun]) -> list[float]:
    """Two digits, which is what a drive is set to; in the direction of most runs."""
    used = np.abs([run.surface_speed for run in runs])
    used = used[used > 0.0]
    if not used.size:
        return []
    sign = -1.0 if sum(np.sign(run.surface_speed) for run in runs) < 0.0 else 1.0
    grid = np.geomspace(used.min() / SPEED_FACTOR, used.max() * SPEED_FACTOR, SPEEDS)
    return [sign * float(f"{speed:.2g}") for speed in grid]


def _farthest(runs: Sequence[MeasuredRun]) -> float:
    """Where the block was farthest out, m, signed, to a tenth of a millimetre."""
    ends = [run.motion.x[np.nanargmax(np.abs(run.motion.x))] for run in runs]
    return round(float(max(ends, key=abs)), 4)
