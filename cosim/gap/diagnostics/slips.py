"""The force on a measured block, stretch by stretch between its corners.

Between two corners the block obeys m x'' + K x = f: the springs and the inertia are known, f is
friction and what nobody has named. x is then a free vibration and the response to f, which is
linear in the coefficients of any formula for f; no second derivative of a noisy track is taken, and
no stretch reaches across a corner, where the velocity's slope jumps.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.signal import savgol_filter
from stickslip.packing import GRAVITY

from cosim.gap.data import MeasuredRun, Stick
from cosim.gap.diagnostics.response import Stretch, slip_stretch

from .features import Feature, Moment

#: Fewest samples of a stretch; samples left out at a corner, whose place is not known exactly.
_FEWEST, _MARGIN = 12, 2
#: Where the block slides less than this part of its fastest it may be held, or about to be.
_SLOW = 0.15
#: Longest stretch in periods of the free vibration: an unknown start is then soon forgotten.
_LONGEST = 2.5
#: Velocities are the slopes of cubics over this part of a period.
_SMOOTH = 0.1


@dataclass(frozen=True)
class Slip:
    """A stretch of slip with what was known of the block in it."""

    stretch: Stretch
    moment: Moment[np.ndarray]


def slips_of(runs: Sequence[MeasuredRun]) -> list[Slip]:
    """All stretches of all runs, cut to at most a few periods."""
    return [slip for number, run in enumerate(runs) for slip in _slips(number, run)]


def _slips(number: int, run: MeasuredRun) -> list[Slip]:
    moment = _moments(run)
    track, omega = run.motion, run.natural_frequency
    rows = np.flatnonzero(_moving(run, moment) & np.isfinite(track.x))
    found = []
    for part in np.split(rows, np.flatnonzero(np.diff(rows) > 1 + 2 * _MARGIN) + 1):
        pieces = (
            1 + int(np.ptp(track.time[part]) * omega / (2.0 * np.pi * _LONGEST)) if len(part) else 1
        )
        for piece in np.array_split(part, pieces):
            if len(piece) >= _FEWEST:
                stretch = slip_stretch(
                    number, piece, track.time[piece], track.x[piece] / run.noise["x"],
                    run.noise["x"], run.mass, omega,
                )  # fmt: skip
                found.append(Slip(stretch, Moment(*(values[piece] for values in moment))))
    return found


def _moving(run: MeasuredRun, moment: Moment[np.ndarray]) -> np.ndarray:
    """(n,) whether a sample lies in slip for sure: no stick, and not so slow that it may be one."""
    sliding = np.abs(moment.sliding)
    held = sliding < _SLOW * np.percentile(sliding, 95)
    for stick in run.sticks:
        held[stick.first : stick.last + 1] = True
    near = np.convolve(held, np.ones(2 * _MARGIN + 1), mode="same")
    return near < 0.5


def _moments(run: MeasuredRun) -> Moment[np.ndarray]:
    """At all samples; in sticks the block moves as the surface does."""
    track = run.motion
    x, vx = _smooth(run)
    sliding = run.surface_speed - vx
    for stick in run.sticks:
        sliding[stick.first : stick.last + 1] = 0.0
    direction = np.sign(run.surface_speed) * np.ones(x.size)
    # where the block is nearly as fast as the surface a noisy velocity says little of the direction
    direction[sliding * direction < -_SLOW * np.percentile(np.abs(sliding), 95)] *= -1.0
    direction[sliding == 0.0] = 0.0
    steps = np.diff(track.time, prepend=track.time[0])
    return Moment(
        x, vx, sliding, direction, track.time, np.cumsum(np.abs(sliding) * steps),
        np.abs(run.surface_speed * track.time - (x - x[0])),
        np.full(x.size, run.mass * GRAVITY),
    )  # fmt: skip


def _smooth(run: MeasuredRun) -> tuple[np.ndarray, np.ndarray]:
    """(n,) position and velocity from cubics through the samples about each."""
    track = run.motion
    seen = np.isfinite(track.x)
    step = track.interval
    count = int(round(track.duration / step)) + 1
    even = track.time[0] + step * np.arange(count)
    x = np.interp(even, track.time[seen], track.x[seen])
    period = 2.0 * np.pi / run.natural_frequency
    width = max(5, 2 * int(0.5 * _SMOOTH * period / step) + 1)
    smooth = [savgol_filter(x, width, 3, deriv=order, delta=step) for order in (0, 1)]
    position, velocity = (np.interp(track.time, even, values) for values in smooth)
    return position, velocity


def holding(
    runs: Sequence[MeasuredRun], force: Callable[[Moment[np.ndarray]], np.ndarray]
) -> list[float]:
    """Coefficients of static friction at the break-aways that were seen, under a force, N."""
    found = []
    for run in runs:
        moment = _moments(run)
        sticks = [stick for stick in run.sticks if np.isfinite(stick.end_sd)]
        ends = np.array([stick.last for stick in sticks], dtype=int)
        x = np.array([_broken_away(run, stick) for stick in sticks])
        acting = force(Moment(*(values[ends] for values in moment))._replace(x=x))
        found += list(np.abs(run.total_stiffness * x - acting) / moment.load[ends])
    return [float(value) for value in found]


def _broken_away(run: MeasuredRun, stick: Stick) -> float:
    """Where the block was at the end of a stick, in which it moved as the surface does, m."""
    rows = slice(stick.first, stick.last + 1)
    since = run.motion.time[rows] - stick.end
    return float(np.nanmean(run.motion.x[rows] - run.surface_speed * since))


def rows_of(slips: Sequence[Slip], features: Sequence[Feature]) -> tuple[np.ndarray, np.ndarray]:
    """(r, f) responses to the features and (r,) what is seen, in units of the noise.

    The motion that each stretch starts with is projected out of both.
    """
    columns, seen = [], []
    for slip in slips:
        inputs = np.stack([feature.of(slip.moment) for feature in features], axis=1)
        stretch = slip.stretch
        columns.append(stretch.free(stretch.respond(inputs) / stretch.noise))
        seen.append(stretch.free(stretch.residual))
    return np.concatenate(columns), np.concatenate(seen)
