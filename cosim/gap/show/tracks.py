"""Measured and modelled motion of a run, sample by sample."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from cosim.gap.data import MeasuredRun
from cosim.gap.result import Gap
from cosim.gap.windows import FittedRun
from cosim.gap.windows.windows import AXES, cycle

#: Cycles in an excerpt.
CYCLES = 4.0
UNITS = {"x": "m", "y": "m", "phi": "rad"}


class Excerpt(NamedTuple):
    """Run, channel, begin and end, s."""

    run: str
    channel: str
    begin: float
    end: float


def measured_run(gap: Gap, name: str) -> MeasuredRun:
    """A run by its name; KeyError."""
    return {run.name: run for run in gap.campaign.runs}[name]


def run_names(gap: Gap) -> list[str]:
    """Of the runs that both models were simulated in."""
    extended = {run.name for run in gap.extended.runs}
    return [run.name for run in gap.plain.runs if run.name in extended]


def seen(run: MeasuredRun, fitted: FittedRun) -> tuple[str, ...]:
    """Channels that the model is compared with: x alone where the block only moves along it."""
    names = tuple(name for name in AXES if name in run.motion.channels)
    count = sum(np.count_nonzero(np.isfinite(run.motion[name])) for name in names)
    return names if count == fitted.residuals.size else AXES[:1]


def channels(gap: Gap) -> tuple[str, ...]:
    """Those that the model is compared with in some run."""
    runs = [gap.plain.run(name) for name in run_names(gap)]
    found = {name for run in runs for name in seen(measured_run(gap, run.name), run)}
    return tuple(name for name in AXES if name in found)


def _rows(run: MeasuredRun, fitted: FittedRun) -> tuple[np.ndarray, np.ndarray]:
    """(m,) sample and number of the channel of each residual."""
    data = np.column_stack([run.motion[name] for name in seen(run, fitted)])
    rows, columns = np.nonzero(np.isfinite(data))
    return rows, columns


def residuals(run: MeasuredRun, fitted: FittedRun) -> dict[str, np.ndarray]:
    """Channel -> (n,) model less data in units of the noise; NaN where nothing was measured."""
    names, (rows, columns) = seen(run, fitted), _rows(run, fitted)
    left = np.full((run.motion.time.size, len(names)), np.nan)
    left[rows, columns] = fitted.residuals
    return dict(zip(names, left.T, strict=True))


def starts(run: MeasuredRun, fitted: FittedRun) -> np.ndarray:
    """(w - 1,) samples at which the model sets out anew from the data, the first left out."""
    rows, _ = _rows(run, fitted)
    return rows[np.flatnonzero(np.diff(fitted.window)) + 1]


def modelled(run: MeasuredRun, fitted: FittedRun, channel: str) -> np.ndarray:
    """(n,) of the model, cut where it sets out anew."""
    values = fitted.track[:, AXES.index(channel)].copy()
    values[starts(run, fitted) - 1] = np.nan
    return values


def excerpt(run: MeasuredRun, fitted: FittedRun) -> tuple[Excerpt, float]:
    """The few cycles in which a model is farthest off, and its mean square there."""
    time = run.motion.time
    length = min(CYCLES * cycle(run), float(time[-1]))
    ends = np.searchsorted(time, time + length, side="right")
    first = np.flatnonzero(time + length <= time[-1] + 1e-9)
    found = []
    for channel, left in residuals(run, fitted).items():
        total = np.concatenate([[0.0], np.cumsum(np.nan_to_num(left) ** 2)])
        squares = (total[ends[first]] - total[first]) / (ends[first] - first)
        best = int(first[np.argmax(squares)])
        begin = float(time[best])
        found.append((Excerpt(run.name, channel, begin, begin + length), float(squares.max())))
    return max(found, key=lambda one: one[1])


def worst(gap: Gap) -> Excerpt:
    """The few cycles of all runs in which the user's model is farthest off."""
    runs = [excerpt(measured_run(gap, name), gap.plain.run(name)) for name in run_names(gap)]
    return max(runs, key=lambda one: one[1])[0]


def title(run: MeasuredRun) -> str:
    """Name, operating point, and whether it was held out."""
    held = ", held out" if run.hold_out else ""
    return (
        f"{run.name}: {run.mass:.4g} kg, {run.stiffness:.4g} N/m, {run.surface_speed:.4g} m/s{held}"
    )
