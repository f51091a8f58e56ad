"""Measured and modelled motion of a run, sample by sample."""

from __future__ import annotations

import numpy as np

from cosim.gap.data import MeasuredRun
from cosim.gap.result import Gap
from cosim.gap.windows import FittedRun
from cosim.gap.windows.windows import AXES, cycle

#: Cycles in an excerpt.
CYCLES = 4.0


def shown_runs(gap: Gap) -> list[MeasuredRun]:
    """The runs that both models were simulated in."""
    names = {run.name for run in gap.plain.runs} & {run.name for run in gap.extended.runs}
    return [run for run in gap.campaign.runs if run.name in names]


def channels_of(fitted: FittedRun) -> tuple[str, ...]:
    """Those that the model is compared with: x alone where the block only moves along it."""
    return tuple(AXES[axis] for axis in np.unique(fitted.axes))


def channels(gap: Gap) -> list[str]:
    """Those that the models are compared with in some run."""
    found = {c for run in shown_runs(gap) for c in channels_of(gap.plain.run(run.name))}
    return [name for name in AXES if name in found]


def residuals(run: MeasuredRun, fitted: FittedRun, channel: str) -> np.ndarray:
    """(n,) model less data in units of the noise; NaN where nothing was compared."""
    left, here = np.full(run.motion.time.size, np.nan), fitted.axes == AXES.index(channel)
    left[fitted.rows[here]] = fitted.residuals[here]
    return left


def starts(fitted: FittedRun) -> np.ndarray:
    """(w - 1,) samples at which the model sets out anew from the data, the first left out."""
    first = [fitted.begin] * (fitted.begin > 0)
    return np.append(first, fitted.rows[np.flatnonzero(np.diff(fitted.window)) + 1]).astype(int)


def modelled(run: MeasuredRun, fitted: FittedRun, channel: str) -> np.ndarray:
    """(n,) of the model, m or rad; cut where it sets out anew, and where a block that just reaches
    the surface's speed is not compared."""
    values = fitted.track[:, AXES.index(channel)].copy()
    is_left_out = np.isfinite(run.motion.x) & (np.arange(values.size) >= fitted.begin)
    is_left_out[fitted.rows] = False
    values[is_left_out] = np.nan
    values[starts(fitted) - 1] = np.nan
    return values


def worst(gap: Gap) -> tuple[MeasuredRun, str, float, float]:
    """Run, channel, begin and end (s) of the worst cycles of the run that the user's model misses
    most: the run that `where` names."""
    run = max(shown_runs(gap), key=lambda run: gap.plain.run(run.name).gap)
    time, fitted = run.motion.time, gap.plain.run(run.name)
    length = min(CYCLES * cycle(run), float(time[-1] - time[0]))
    first = np.flatnonzero(time + length <= time[-1] + 1e-9)
    last = np.searchsorted(time, time[first] + length)
    found = []
    for channel in channels_of(fitted):
        squares = np.nan_to_num(residuals(run, fitted, channel)) ** 2
        total = np.append(0.0, np.cumsum(squares))
        mean = (total[last] - total[first]) / np.maximum(last - first, 1)
        found.append((float(mean.max()), channel, float(time[first[np.argmax(mean)]])))
    _, channel, begin = max(found)
    return run, channel, begin, begin + length


def title(run: MeasuredRun) -> str:
    """Name, operating point, and whether it was held out."""
    at = f"{run.name}: {run.mass:.4g} kg, {run.stiffness:.4g} N/m, {run.surface_speed:.4g} m/s"
    return f"{at}{', held out' if run.hold_out else ''}"
