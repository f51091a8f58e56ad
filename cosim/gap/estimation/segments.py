"""Where a measured run is cut, and from which state the model starts each piece."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

#: Stick-slip cycles in a segment: enough for the period to tell, few enough for a small error of
#: the period to stay small.
CYCLES = 3
#: Numbers of a segment's state, and which of them are friction of that stretch.
STATES, FRICTION = 8, (6, 7)
#: Where positions across the motion stand in it.
ACROSS = {"y": 1, "phi": 2}
#: Half width, in samples, of the stretch that tells position and velocity outside a stick.
_REACH = 6
#: A segment starts with a stick that lasts this part of a cycle; a shorter one may be none, and
#: would hold the block where it creeps.
_LASTS = 1.0 / 6.0
#: A segment that would leave less than this share of its length at the end of a run takes it in.
_REMNANT = 0.5


@dataclass(frozen=True)
class Segment:
    """A piece of a run: samples first ... last - 1.

    Attributes
    ----------
    state : (8,) first guess of x, y, phi, vx, vy, omega (NaN: the model's own goes on), and of the
        logarithms by which friction, and static friction beside it, are larger than the run's
    free : which of them are fitted
    hold_since : when the stick began that it starts in, s; NaN in slip
    """

    first: int
    last: int
    state: np.ndarray
    free: tuple[int, ...]
    hold_since: float


def cut(
    track,
    sticks,
    speed: float,
    period: float,
    across: Sequence[str] = (),
    cycles: float = CYCLES,
) -> tuple[Segment, ...]:
    """Segments of a run.

    period : of a cycle, s. A segment starts at the beginning of a stick where there is one near the
    place where it is due, else where the block moves against the surface as fast as it ever does:
    near a stick a small error of the velocity would decide between stick and slip.
    across : which of y and phi were measured, where the model may move across
    """
    length = cycles * period
    sticks = [stick for stick in sticks if stick.end - stick.start >= _LASTS * period]
    onsets = np.array([stick.first for stick in sticks if np.isfinite(stick.start_sd)], dtype=int)
    starts = _starts(track, onsets, speed, length, period)
    ends = [*starts[1:], len(track.time)]
    return tuple(
        _segment(track, first, last, _held(sticks, first), speed, across)
        for first, last in zip(starts, ends, strict=True)
    )


def _held(sticks, row: int):
    """The stick that a sample is in, well before its end; None in slip."""
    for stick in sticks:
        if stick.first <= row < stick.last - _REACH or row == stick.first:
            return stick
    return None


def joined(segments: Sequence[Segment], time: np.ndarray, length: float) -> tuple[Segment, ...]:
    """The same segments put together to longer ones of about this length, s.

    A longer one starts where a short one does, and thus from a state that a fit in short segments
    has found.
    """
    ends = [time[segment.last - 1] for segment in segments]
    chosen = [0]
    for number in range(1, len(segments)):
        begin = time[segments[number].first]
        due = time[segments[chosen[-1]].first] + length
        rest = ends[-1] - begin
        if begin + 0.5 * (ends[number] - begin) > due and rest > _REMNANT * length:
            chosen.append(number)
    lasts = [segments[number].first for number in chosen[1:]] + [segments[-1].last]
    return tuple(replace(segments[i], last=last) for i, last in zip(chosen, lasts, strict=True))


def _starts(track, onsets, speed: float, length: float, period: float) -> list[int]:
    time = track.time
    starts, end = [0], time[-1] - _REMNANT * length
    while True:
        due = time[starts[-1]] + length
        if due > end:
            return starts
        near = onsets[np.abs(time[onsets] - due) < max(0.5 * length, period)]
        near = near[(time[near] <= end) & (near > starts[-1])]
        if near.size:
            starts.append(int(near[np.abs(time[near] - due).argmin()]))
        else:
            starts.append(_fastest(track, due, speed, period))


def _fastest(track, due: float, speed: float, period: float) -> int:
    """The sample within half a cycle of ``due`` at which the sliding is fastest."""
    low, high = np.searchsorted(track.time, [due - 0.5 * period, due + 0.5 * period])
    low, high = max(low, 1), min(high, len(track.time))
    seen = low + np.flatnonzero(np.isfinite(track.x[low:high]))
    if seen.size < 2 * _REACH:
        return int(np.searchsorted(track.time, due))
    steps = np.arange(_REACH, seen.size - _REACH + 1)
    moved = track.x[seen[steps + _REACH - 1]] - track.x[seen[steps - _REACH]]
    time = track.time[seen[steps + _REACH - 1]] - track.time[seen[steps - _REACH]]
    return int(seen[steps[np.abs(moved / time - speed).argmax()]])


def _segment(track, first: int, last: int, stick, speed: float, across: Sequence[str]) -> Segment:
    state = np.full(STATES, np.nan)
    state[list(FRICTION)] = 0.0
    if first == 0:
        state[:] = 0.0  # what is measured is put in its place
    swings: tuple[int, ...] = ()  # friction along x alone leaves a block that sticks free to do so
    for name, at in ACROSS.items():
        if name in across:
            _fill_moving(track, first, state, track[name], at)
            swings += (at, at + 3)
        elif first == 0 and across:  # how it was put down, nobody has seen
            swings += (at,)
    if stick is None:
        _fill_moving(track, first, state, track.x, 0)
        return Segment(first, last, state, (0, 3, *swings), np.nan)
    rows = slice(first, stick.last + 1)
    time = track.time[rows] - track.time[first]
    state[0] = np.nanmean(track.x[rows] - speed * time)
    return Segment(first, last, state, (0, *swings), stick.start)


def _fill_moving(track, first: int, state: np.ndarray, values: np.ndarray, at: int) -> None:
    """Position and velocity from a parabola through the samples about the first.

    values : (n,) measured positions; at : where they stand in the state
    """
    low, high = max(0, first - _REACH), min(len(track.time), first + _REACH + 1)
    time = track.time[low:high] - track.time[first]
    seen = np.isfinite(values[low:high])
    if seen.sum() > 3:
        fit = np.polynomial.polynomial.polyfit(time[seen], values[low:high][seen], 2)
        state[at], state[at + 3] = fit[0], fit[1]
    elif np.isnan(state[at]) and seen.any():
        state[at], state[at + 3] = np.mean(values[low:high][seen]), 0.0
