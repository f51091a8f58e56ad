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


def channels_of(run: MeasuredRun, fitted: FittedRun) -> tuple[str, ...]:
    """Those that the model is compared with: x alone where the block only moves along it."""
    return _compared(run, fitted)[0]


def _compared(run: MeasuredRun, fitted: FittedRun) -> tuple[tuple[str, ...], np.ndarray]:
    """The channels, and (n, c) which of their samples there are."""
    names = tuple(name for name in AXES if name in run.motion.channels)
    there = np.isfinite(np.column_stack([run.motion[name] for name in names]))
    there[: fitted.begin] = False
    if np.count_nonzero(there) == fitted.residuals.size:
        return names, there
    return AXES[:1], there[:, :1]


def channels(gap: Gap) -> list[str]:
    """Those that the models are compared with in some run."""
    found = {c for run in shown_runs(gap) for c in channels_of(run, gap.plain.run(run.name))}
    return [name for name in AXES if name in found]


def residuals(run: MeasuredRun, fitted: FittedRun, channel: str) -> np.ndarray:
    """(n,) model less data in units of the noise; NaN where nothing was compared."""
    names, there = _compared(run, fitted)
    left = np.full(there.shape, np.nan)
    left[there] = fitted.residuals
    return left[:, names.index(channel)] if channel in names else np.full(len(left), np.nan)


def starts(run: MeasuredRun, fitted: FittedRun) -> np.ndarray:
    """(w - 1,) samples at which the model sets out anew from the data, the first left out."""
    rows, _ = np.nonzero(_compared(run, fitted)[1])
    first = [fitted.begin] * (fitted.begin > 0)
    return np.concatenate([first, rows[np.flatnonzero(np.diff(fitted.window)) + 1]]).astype(int)


def modelled(run: MeasuredRun, fitted: FittedRun, channel: str) -> np.ndarray:
    """(n,) of the model, m or rad; cut where it sets out anew."""
    values = fitted.track[:, AXES.index(channel)].copy()
    values[starts(run, fitted) - 1] = np.nan
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
    for channel in channels_of(run, fitted):
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
