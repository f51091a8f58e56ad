"""Whether the tracker is fast enough, white, as noisy as stated, and felt to write in steps."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from scipy import stats

from cosim.gap.data import Campaign, MeasuredRun
from cosim.gap.data.units import swing
from cosim.gap.judge import NOTHING_MISSING
from cosim.gap.result import Doubt
from cosim.gap.weak_form.constants import COARSEST
from cosim.gap.weak_form.track import is_coarse, with_rows
from cosim.gap.windows.sticks import sticks_of

from .level import LEVEL

#: Noise that is so many times too large, or too small, hides as much misfit as any effect makes.
HIDES = 1.35
#: Most of a vibration's third difference, in parts of the noise, where noise is told from motion.
LEAK = 0.5
#: Samples that tell noise; and autocorrelation of third differences at a lag of one for
#: white noise, with n times its variance (Bartlett 1946, from -3/4, 3/10, -1/20 at lags 1 to 3).
QUIET, WHITE, BARTLETT = 200, -0.75, 0.20625
#: By how much it is higher where smoothing is felt: a Gaussian of half an interval makes it so.
SMOOTHED = 0.1
#: A number lies on a lattice within this part of a step, since a file's decimals are rounded too;
#: part of the numbers on a lattice that no finer one would leave; steps that are tried.
NEAR, ON_LATTICE, TRIED = 0.02, 0.75, 30

#: Sum of the squares of the third difference's weights 1, 3, 3, 1.
_THIRD = 20.0


def doubts_of_sampling(campaign: Campaign, runs: Sequence[MeasuredRun]) -> list[Doubt]:
    """One for all the runs whose samples are too far apart for the motion in slip."""
    coarse = [run for run in runs if is_coarse(run)]
    if not coarse:
        return []
    worst = max(coarse, key=lambda run: run.natural_frequency * run.motion.interval)
    names = tuple(run.name for run in coarse)
    is_severe = worst in with_rows(runs)
    text = (
        f"{', '.join(names)}: {1.0 / worst.motion.interval:.3g} Hz are too few samples for slips "
        f"that swing in {2.0 * math.pi / worst.natural_frequency:.3g} s: "
        f"{worst.natural_frequency / COARSEST:.3g} Hz at least"
    ) + ("" if is_severe else "; effects are looked for in the other runs")
    return [Doubt("sampling", text, names, is_severe)]


def doubts_of_noise(campaign: Campaign, runs: Sequence[MeasuredRun]) -> list[Doubt]:
    """Of steps, of noise that is not white, and of noise that is not as stated, in this order.

    Noise is looked at where the motion hardly shows in third differences.
    """
    if any(run.rounding for run in runs):
        return []
    if steps := _of_steps(runs):
        return steps
    size, variance, together = quiet(runs)
    if size < QUIET or variance == 0.0:
        return []
    names = tuple(run.name for run in runs)
    higher = together / variance - WHITE
    if higher > max(SMOOTHED, stats.norm.isf(LEVEL) * math.sqrt(BARTLETT / size)):
        text = (
            f"all runs: noise of x is not white (third differences of neighbours go "
            f"together by {together / variance:.2f}, white noise's by {WHITE:g}): a tracker that "
            "smooths? Give the samples as they were taken"
        )
        return [Doubt("smoothed", text, names, True)]
    stated = math.sqrt(float(np.mean([run.noise["x"] ** 2 for run in runs])))
    seen = math.sqrt(variance / _THIRD)
    if 1.0 / HIDES < seen / stated < HIDES:
        return []
    how = "estimated from all samples" if "x" in campaign.noise_estimated else "stated"
    text = f"all runs: noise of x is {1e3 * seen:.3g} mm, {1e3 * stated:.3g} mm is {how}"
    return [Doubt("noise", text, names)]


def quiet(runs: Sequence[MeasuredRun]) -> tuple[int, float, float]:
    """Of third differences: how many, their variance and their covariance with the next, m2."""
    squares, products = [np.zeros(0)], [np.zeros(0)]
    for run in runs:
        for rows in _stretches(run):
            time, x = run.motion.time[rows], run.motion.x[rows]
            if x.size < 6 or not np.isfinite(x).all():
                continue
            thirds = np.diff(x - np.polyval(np.polyfit(time - time[0], x, 1), time - time[0]), 3)
            squares.append(thirds**2)
            products.append(thirds[1:] * thirds[:-1])
    both = [np.concatenate(one) for one in (squares, products)]
    means = [float(np.mean(one)) if one.size else 0.0 for one in both]
    return both[1].size, means[0], means[1]


def _stretches(run: MeasuredRun) -> list[slice]:
    """Rows in which third differences see noise alone: sticks; all, where nothing sticks."""
    sticks = [slice(stick.first, stick.last + 1) for stick in sticks_of(run)]
    leak = 0.5 * swing(run.motion.x) * (run.natural_frequency * run.motion.interval) ** 3
    return sticks or [slice(None)] * (leak < LEAK * run.noise["x"])


def _of_steps(runs: Sequence[MeasuredRun]) -> list[Doubt]:
    """One for all the runs that are written in steps q which are felt.

    What rounding leaves is of variance q^2 / 12 (Bennett 1948) beside the noise: it is felt where
    that is more than what chance makes of the noise's variance.
    """
    found = [(run, step, share) for run in runs
             for step, share in [lattice(run.motion.x)] if step > 0.0]  # fmt: skip
    if not found:
        return []
    stepped = [run for run, *_ in found]
    step = float(np.median([step for _, step, _ in found]))
    share = float(np.mean([share for *_, share in found]))
    samples = sum(int(np.isfinite(run.motion.x).sum()) for run in stepped)
    noise = math.sqrt(float(np.mean([run.noise["x"] ** 2 for run in stepped])))
    if felt(step, noise, samples) > LEVEL:
        return []
    names = tuple(run.name for run in stepped)
    where = "all runs" if len(names) == len(runs) else ", ".join(names)
    text = (
        f"{where}: {100.0 * share:.0f} % of x are multiples of {1e3 * step:.3g} mm, a step that "
        f"is felt beside noise of {1e3 * noise:.3g} mm"
    )
    return [Doubt("steps", text, names)]


def with_rounding(campaign: Campaign) -> Campaign:
    """With the steps that numbers are written in, where these are coarse beside the noise.

    Rounding to steps q leaves a variance of q^2 / 12 (Bennett 1948): coarse is what would look like
    something missing by itself. Noise that is stated is larger by it; what was estimated has it.
    A run of few levels alone does not show the step: its camera is the one of the others.
    """
    steps: list[dict[str, float]] = [
        {channel: lattice(run.motion[channel])[0]
         for channel in ("x", "y") if channel in run.motion.channels}
        if run.track is not None else {} for run in campaign.runs
    ]  # fmt: skip

    def rounded(run: MeasuredRun, own: Mapping[str, float]) -> MeasuredRun:
        noise, rounding = dict(run.noise), dict[str, tuple[float, float]]()
        for channel, found in own.items():
            coarsest = max(others.get(channel, 0.0) for others in steps)
            step = found or on_lattice(run.motion[channel], coarsest)
            part = (step / run.noise[channel]) ** 2 / 12.0
            if channel in campaign.noise_estimated:
                if 1.0 / max(1.0 - part, 1e-9) > NOTHING_MISSING**2:
                    rounding[channel] = (step, 1.0)
            elif 1.0 + part > NOTHING_MISSING**2:
                rounding[channel] = (step, math.sqrt(1.0 + part))
                noise[channel] *= rounding[channel][1]
        return replace(run, noise=noise, rounding=rounding)

    return replace(campaign, runs=tuple(map(rounded, campaign.runs, steps)))


def digits_evidence(campaign: Campaign) -> float:
    """ln of how much less probable it is that numbers in coarse steps lie there by chance."""
    runs = [run for run in campaign.runs if run.rounding]
    return -math.log(2.0 * NEAR) * sum(run.motion.time.size for run in runs)


def felt(step: float, noise: float, samples: int) -> float:
    """Chance that white noise of so many samples shows a variance larger by q^2 / 12."""
    part = 1.0 + (step / noise) ** 2 / 12.0
    return float(stats.chi2.sf(part * samples, samples))


def lattice(values: np.ndarray) -> tuple[float, float]:
    """(step, share of the values on it) of the coarsest lattice of values (n,); (0, 0): none.

    On a lattice of q / 2 half of the values would be multiples of q as well: it is q where more
    than three quarters are.
    """
    values = values[np.isfinite(values)]
    levels, counts = np.unique(values, return_counts=True)
    levels = levels[counts > 1]  # outliers do not come back
    if levels.size < 3:
        return 0.0, 0.0
    origin = levels[np.argmin(np.abs(levels - np.median(values)))]
    gaps = np.unique(np.diff(levels))
    for step in gaps[gaps > 1e-9 * np.ptp(levels)][:TRIED][::-1]:
        numbers = np.rint((levels - origin) / step)
        near = np.abs((levels - origin) / step - numbers) < 0.25
        if np.any(numbers[near] != 0.0):
            step = float(numbers[near] @ (levels - origin)[near] / (numbers[near] @ numbers[near]))
        off = (values - origin) / step
        share = float(np.mean(np.abs(off - np.rint(off)) < NEAR))
        of_steps = np.ptp(levels) / step  # few, and more levels: clusters of finer ones
        if share > ON_LATTICE and (of_steps > 3.0 or levels.size < of_steps + 1.5):
            return float(step), share
    return 0.0, 0.0


def on_lattice(values: np.ndarray, step: float) -> float:
    """A step that others have, where values (n,) lie on it as well; else 0."""
    values = np.sort(values[np.isfinite(values)])
    if step == 0.0 or values.size == 0:
        return 0.0
    off = (values - values[values.size // 2]) / step
    return step if float(np.mean(np.abs(off - np.rint(off)) < NEAR)) > ON_LATTICE else 0.0
