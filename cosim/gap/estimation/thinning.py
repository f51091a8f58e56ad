"""Long records cut down to what a fit needs: the first cycles, with few samples in the sticks."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from cosim.gap.data import MeasuredRun, Stick, Track

#: Most samples and cycles of a run: beyond them more data cost time and tell nothing new.
MOST_SAMPLES, MOST_CYCLES = 3000, 60
#: Most swings of the free oscillator, if that leaves so many cycles.
MOST_SWINGS, FEWEST_CYCLES = 600, 10
#: Samples kept on either side of a corner, where the motion tells most.
_CORNER = 8


def thinned(run: MeasuredRun) -> MeasuredRun:
    """The run as it is, or its first cycles with few of the samples inside long sticks."""
    track = run.track
    cycles = _cycles(run)
    end = run.sticks[cycles].first if len(run.sticks) > cycles else track.time.size
    if end <= MOST_SAMPLES:
        return run if end == track.time.size else _with_rows(run, np.arange(end))
    idle = np.zeros(end, dtype=bool)
    for stick in run.sticks:
        idle[stick.first + _CORNER : max(stick.last + 1 - _CORNER, stick.first)] = True
    busy = np.flatnonzero(~idle)
    every = max(1, -(-int(idle.sum()) // max(MOST_SAMPLES - busy.size, MOST_SAMPLES // 3)))
    rows = np.union1d(busy, np.flatnonzero(idle)[::every])
    if rows.size > 2 * MOST_SAMPLES:  # hardly a stick to thin
        rows = rows[:: -(-rows.size // (2 * MOST_SAMPLES))]
    return _with_rows(run, rows)


def _cycles(run: MeasuredRun) -> int:
    """How many are looked at: long sticks of a fast oscillator cost the model many steps."""
    first = run.track.time[0]
    swings = np.array([s.start - first for s in run.sticks]) * run.natural_frequency / (2.0 * np.pi)
    return int(np.clip(np.searchsorted(swings, MOST_SWINGS), FEWEST_CYCLES, MOST_CYCLES))


def _with_rows(run: MeasuredRun, rows: np.ndarray) -> MeasuredRun:
    track = run.track
    channels = {name: track[name][rows] for name in track.channels}
    cut = Track(
        track.time[rows], time_offset=track.time_offset, outliers=track.outliers, **channels
    )
    sticks = []
    for stick in run.sticks:
        first, last = np.searchsorted(rows, [stick.first, stick.last + 1])
        if last - first >= 2:
            sticks.append(
                Stick(
                    stick.start, stick.end, int(first), int(last) - 1, stick.start_sd, stick.end_sd
                )
            )
    return replace(run, track=cut, sticks=tuple(sticks))
