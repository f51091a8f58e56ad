"""From measured runs to the shooting segments that the model is simulated in.

Long records are cut down to what a fit needs, then into segments, long ones and short ones.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from stickslip import Parameters

from cosim.gap.data import Campaign, MeasuredRun, Stick, Track

from .segmented_run import TOLERANCE, SegmentedRun
from .segments import ACROSS, CYCLES, cut, joined

#: Cycles in the short segments in which a fit sets out: hardly a phase to be lost.
SHORT_CYCLES = 1.2
#: A cycle is at most this much slower than sticks follow each other.
_SLOWER = 0.7
#: Most samples and cycles of a run: beyond them more data cost time and tell nothing new.
MOST_SAMPLES, MOST_CYCLES = 3000, 60
#: Most swings of the free oscillator, if that leaves so many cycles.
MOST_SWINGS, FEWEST_CYCLES = 600, 10
#: Samples kept on either side of a corner, where the motion tells most.
_CORNER = 8


def prepare(
    campaign: Campaign, runs: Sequence[MeasuredRun], planar: bool, cycles: float = CYCLES
) -> tuple[SegmentedRun, ...]:
    """Runs of runs with a track. planar: the model moves across and turns as the rig allows."""
    return tuple(_segmented(campaign, run, planar, cycles) for run in runs)


def _segmented(campaign: Campaign, run: MeasuredRun, planar: bool, cycles: float) -> SegmentedRun:
    track = run.motion
    known = known_parameters(campaign, run, planar)
    seen = ("x", "y", "phi") if planar else ("x",)
    channels = {name: track[name] for name in track.channels if name in seen}
    across = [name for name in ACROSS if name in channels]
    cycle = period(run)
    segments = cut(track, run.sticks, run.surface_speed, cycle, across, min(cycles, SHORT_CYCLES))
    if cycles > SHORT_CYCLES:
        segments = joined(segments, track.time, cycles * cycle)
    noise = {name: run.noise[name] for name in channels}
    temperature = known["temperature_dependence.reference_degC"]
    return SegmentedRun(
        run.name,
        known,
        run.surface_speed,
        temperature,
        track.time,
        channels,
        noise,
        segments,
        campaign.setup_of(run),
    )


def known_parameters(campaign: Campaign, run: MeasuredRun, planar: bool) -> dict[str, float]:
    """Every parameter of the model, what is to be fitted at its default; on a line or planar."""
    with warnings.catch_warnings(action="ignore"):  # friction is for the fit
        parameters = Parameters.model_validate(campaign.parameters(run), strict=True)
    known = dict(parameters.flat()) | {"solver.tolerance": TOLERANCE}
    return known if planar else known | {"rig.free_y": 0.0, "rig.free_phi": 0.0}


def period(run: MeasuredRun) -> float:
    """Of a stick-slip cycle, or of the strongest oscillation where nothing sticks, s.

    That of the strongest line in the spectrum of x: no slower than sticks follow each other, of
    which some may not have been recognised, or than a quarter of the free oscillation.
    """
    free = run.natural_frequency / (2.0 * np.pi)
    onsets = np.array([stick.start for stick in run.sticks])
    slowest = _SLOWER / np.median(np.diff(onsets)) if onsets.size > 3 else free / 4.0
    return _strongest_period(run.motion, slowest, max(2.0 * free, 2.0 * slowest), 1.0 / free)


def _strongest_period(track: Track, slowest: float, fastest: float, default: float) -> float:
    """From the spectrum of x between two frequencies, Hz."""
    seen = np.isfinite(track.x)
    time = np.arange(track.time[0], track.time[-1], track.interval)
    x = np.interp(time, track.time[seen], track.x[seen])
    power = np.abs(np.fft.rfft((x - x.mean()) * np.hanning(x.size), 8 * x.size))
    frequency = np.fft.rfftfreq(8 * x.size, track.interval)
    inside = (frequency > slowest) & (frequency < fastest)
    if not inside.any():
        return default
    return float(1.0 / frequency[inside][power[inside].argmax()])


@dataclass(frozen=True)
class Data:
    """The segmented runs of a campaign: for fitting and held out, in long and in short segments.

    Every long segment starts where a short one does.
    """

    fit: tuple[SegmentedRun, ...]
    short: tuple[SegmentedRun, ...]
    held_out: tuple[SegmentedRun, ...]
    held_out_short: tuple[SegmentedRun, ...]


def prepared(
    campaign: Campaign, fit: Sequence[MeasuredRun], held_out: Sequence[MeasuredRun], planar: bool
) -> Data:
    """Runs with a track. planar: the model moves across and turns as the rig allows."""
    return Data(
        prepare(campaign, fit, planar),
        prepare(campaign, fit, planar, SHORT_CYCLES),
        prepare(campaign, held_out, planar),
        prepare(campaign, held_out, planar, SHORT_CYCLES),
    )


def thinned(run: MeasuredRun) -> MeasuredRun:
    """The run as it is, or its first cycles with few of the samples inside long sticks."""
    track = run.motion
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
    """How many are used: long sticks of a fast oscillator cost the model many steps."""
    first = run.motion.time[0]
    swings = np.array([s.start - first for s in run.sticks]) * run.natural_frequency / (2.0 * np.pi)
    return int(np.clip(np.searchsorted(swings, MOST_SWINGS), FEWEST_CYCLES, MOST_CYCLES))


def _with_rows(run: MeasuredRun, rows: np.ndarray) -> MeasuredRun:
    track = run.motion
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
