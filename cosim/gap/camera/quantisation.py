"""Whether a tracker writes its numbers in steps, and whether these are felt.

A step q rounds every sample; what that leaves is uniform over a step, of variance q^2 / 12
(Bennett 1948), beside the noise. It is no number of a smooth fit, so it is read off the data:

* the lattice: the numbers that come back are multiples of one step, up to a zero of the run's own.
  On a lattice of q / 2, half of them would be multiples of q as well: it is q where more than
  three quarters are, which n >= 30 samples of the finer one are less often than once in 300 times;
* the size: n samples tell a variance to a part sqrt(2 / n). A step is felt where q^2 / 12 is more
  than what chance makes of the noise's variance at the level stated.

A file's own decimals are a lattice as well, and fall under the second test.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy import stats

from cosim.gap.data import Campaign, MeasuredRun

#: Rate at which a lattice that is not felt passes for one that is.
LEVEL = 1e-3
#: Channels that are lengths: one chip makes both of them.
LENGTHS = ("x", "y")
#: A number lies on a lattice within this part of a step: a file's decimals are rounded too.
_NEAR = 0.02
#: Part of the numbers on a lattice that no finer one would leave.
_ON = 0.75
#: Fewest samples and steps that tell a lattice; steps tried, finest first.
_FEWEST, _FEWEST_STEPS, _TRIED = 30, 3, 30


@dataclass(frozen=True)
class Quantisation:
    """A step of the numbers that is felt.

    step : m; share : of the samples on the lattice; p : chance that noise alone had a variance
    larger than its own by as much as the step's
    """

    step: float
    share: float
    p: float


def lattice(values: np.ndarray) -> tuple[float, float]:
    """(step, share of the values on it) of the coarsest lattice of values (n,); (0, 0): none."""
    values = values[np.isfinite(values)]
    levels, counts = np.unique(values, return_counts=True)
    levels = levels[counts > 1]  # outliers do not come back
    if values.size < _FEWEST or levels.size <= _FEWEST_STEPS:
        return 0.0, 0.0
    gaps = np.diff(levels)
    tried = np.unique(gaps[gaps > 1e-9 * np.ptp(levels)])
    for rough in _coarsest_first(tried):
        step, share = _fitted(values, levels, rough)
        if share > _ON and np.ptp(levels) > _FEWEST_STEPS * step:
            return step, share
    return 0.0, 0.0


def _coarsest_first(gaps: np.ndarray) -> np.ndarray:
    """Some steps to try: those near the finest ones, from the coarse end."""
    return gaps[:_TRIED][::-1]


def _fitted(values: np.ndarray, levels: np.ndarray, rough: float) -> tuple[float, float]:
    """The step near a rough one that the levels' whole numbers give, and the share on it."""
    origin = levels[np.argmin(np.abs(levels - np.median(values)))]
    step = rough
    numbers = np.rint((levels - origin) / step)
    near = np.abs((levels - origin) / step - numbers) < 0.25
    if np.any(numbers[near] != 0.0):
        step = float(numbers[near] @ (levels - origin)[near] / (numbers[near] @ numbers[near]))
    off = (values - origin) / step
    return step, float(np.mean(np.abs(off - np.rint(off)) < _NEAR))


def felt(step: float, noise: float, samples: int) -> float:
    """Chance that white noise of so many samples shows a variance larger by q^2 / 12."""
    part = 1.0 + (step / noise) ** 2 / 12.0
    return float(stats.chi2.sf(part * samples, samples))


def find_quantisation(runs: Sequence[MeasuredRun]) -> Quantisation | None:
    """The coarsest step that more than half of the runs' x are written in, where it is felt."""
    tracks = [run for run in runs if run.track is not None]
    found = [lattice(run.motion.x) for run in tracks]
    steps = [step for step, _ in found if step > 0.0]
    if 2 * len(steps) <= len(tracks):
        return None
    step = float(np.median(steps))
    samples = sum(int(np.isfinite(run.motion.x).sum()) for run in tracks)
    noise = math.sqrt(float(np.mean([run.noise["x"] ** 2 for run in tracks])))
    share = float(np.mean([share for _, share in found if share > 0.0]))
    p = felt(step, noise, samples)
    return Quantisation(step, share, p) if p < LEVEL else None


def with_steps(campaign: Campaign, step: float) -> Campaign:
    """The campaign with noise of which the rounding is a part: sqrt(noise^2 + q^2 / 12).

    Where the noise was estimated from the rounded samples it holds some of that, and is only raised
    to what the rounding leaves. What a sum of squares gains by it says nothing for the step: its
    likelihood counts -log(noise) for every sample.
    """
    rounding = step / math.sqrt(12.0)

    def wider(channel: str, noise: float) -> float:
        if channel not in LENGTHS:
            return noise
        if channel in campaign.noise_estimated:
            return max(noise, rounding)
        return math.hypot(noise, rounding)

    runs = tuple(
        replace(run, noise={name: wider(name, value) for name, value in run.noise.items()})
        for run in campaign.runs
    )
    noise = {name: wider(name, value) for name, value in campaign.noise.items()}
    return replace(campaign, runs=runs, noise=noise)
