"""Whether what is taken for noise is motion between samples that are too far apart.

Noise is estimated from third differences, in which a motion that is sampled densely does not show:
of a vibration of amplitude A they hold A (2 sin(omega dt / 2))^3 / sqrt(20). Noise of a sample is
told by none of the samples around it, motion is: so the part of the differences that samples beyond
their reach predict is motion. A model is then compared with a noise that is too large, and fits.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from cosim.gap.data import Campaign, MeasuredRun
from cosim.gap.data.noise import HUBER, huber_scale, third_differences

from .doubt import Doubt, listed, rounded

#: Root mean square, in units of the noise, that a model may leave and be taken for true
#: (`selection.decision.TAIL`): noise that is estimated so many times too large hides as much.
HIDES = 1.35
#: Part of the differences' variance that is motion, where the noise is estimated so much too large.
MOTION = 1.0 - HIDES**-2
#: Samples on either side, beyond the four of a difference, that predict it.
AROUND = 3
#: Fewest differences for each of their numbers.
_EACH = 5


def doubts_of_sampling(campaign: Campaign, runs: Sequence[MeasuredRun]) -> list[Doubt]:
    """One for all the runs whose estimated noise is motion; none where it is given."""
    if "x" not in campaign.noise_estimated:
        return []
    coarse = [run for run in runs if _gain(run) and motion_part(run) > MOTION]
    if not coarse:
        return []
    worst = max(coarse, key=lambda run: run.motion.interval * run.natural_frequency)
    period = 2.0 * math.pi / worst.natural_frequency
    amplitude = math.sqrt(2.0) * float(np.nanstd(worst.motion.x))
    wanted = period * least_rate(amplitude, worst.natural_frequency, worst.noise["x"])
    there = period / worst.motion.interval
    return [
        Doubt(
            "sampling",
            listed([run.name for run in coarse]),
            there,
            wanted,
            "samples a period",
            f"{listed([run.name for run in coarse])}: what is estimated as noise of x, "
            f"{rounded(1e3 * worst.noise['x'])} mm, is motion between the samples, "
            f"{rounded(there, 2)} in a period of the free block ({rounded(period)} s); expected "
            f"are {math.ceil(wanted)} at least ({math.ceil(wanted / period)} Hz), or noise.x "
            "given: sample faster",
            True,
        )  # fmt: skip
    ]


def _gain(run: MeasuredRun) -> bool:
    """Whether a vibration as large as the motion would show in the differences at all."""
    return leak(run, run.motion.interval) > math.sqrt(MOTION) * difference_scale(run)


def leak(run: MeasuredRun, interval: float) -> float:
    """What a vibration like the run's, so sampled, leaves in the third differences, m."""
    amplitude = math.sqrt(2.0) * float(np.nanstd(run.motion.x))
    return vibration_leak(amplitude, run.natural_frequency, interval)


def vibration_leak(amplitude: float, omega: float, interval: float) -> float:
    """Root mean square of the third differences of a vibration with corners, m.

    Corners have harmonics, which fall with the square of their order: up to the third. Beyond two
    samples a period differences pass everything. amplitude : m; omega : rad/s; interval : s
    """
    parts = [
        amplitude / order**2 * (2.0 * math.sin(0.5 * min(omega * order * interval, math.pi))) ** 3
        for order in (1, 2, 3)
    ]
    return math.hypot(*parts) / math.sqrt(40.0)


def least_rate(amplitude: float, omega: float, noise: float) -> float:
    """Samples a second at which a tenth of an estimated noise is motion, Hz."""
    rate = omega / math.pi
    while vibration_leak(amplitude, omega, 1.0 / rate) > 0.1 * noise and rate < 1e4 * omega:
        rate *= 1.05
    return rate


def difference_scale(run: MeasuredRun) -> float:
    """What a run by itself has as noise, m."""
    return huber_scale(third_differences(run.motion.time, run.motion.x))


def motion_part(run: MeasuredRun) -> float:
    """Part of the variance of the third differences that neighbours predict; 0.0 with too few."""
    seen = np.isfinite(run.motion.x)
    x = run.motion.x[seen]
    differences = x[3:] - 3.0 * x[2:-1] + 3.0 * x[1:-2] - x[:-3]
    count = differences.size - 2 * AROUND
    if count < _EACH * (2 * AROUND + 1):
        return 0.0
    limit = HUBER * max(huber_scale(differences), 1e-300)
    wanted = np.clip(differences[AROUND : AROUND + count], -limit, limit)
    places = [*range(AROUND), *range(AROUND + 4, 2 * AROUND + 4)]
    columns = np.stack([np.ones(count), *(x[at : at + count] for at in places)], axis=1)
    left = wanted - columns @ np.linalg.lstsq(columns, wanted, rcond=None)[0]
    freedom = count - columns.shape[1]
    total = float(np.sum((wanted - wanted.mean()) ** 2)) / (count - 1)
    return max(1.0 - float(left @ left) / freedom / total, 0.0) if total > 0.0 else 0.0
