"""Windows: short stretches of a run, each simulated from a start state of its own.

Over a few cycles an error of the model shows but does not build up to a loss of phase. A window
starts where the state is well known: at the beginning of a stick, else in fast sliding, never near
the surface's velocity, where a small error would decide between stick and slip. What comes before
the first fast sliding is simulated and not compared: how long the block had rested before the
record begins, and what the contact had built up, nobody has measured.

Where a block just reaches the surface's speed at the crest of a swing, and does not stick to be
seen, a window ends: whether it sticks there hangs on how a contact reverses within micrometres,
and sticking once, an ideal one holds it for long.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.signal import find_peaks

from cosim.gap.data import Campaign, MeasuredRun, Track
from cosim.gap.data.units import cycle_of
from cosim.gap.weak_form import across

from .sticks import Stick, smoothed, sticks_of

#: What the block's position is made of, in the order of the states.
AXES = ("x", "y", "phi")
#: Cycles in a window: enough for the period to tell, few enough for its error to stay small.
CYCLES = 3.0
#: Samples on either side of a window's start that its first guess is read off.
REACH = 6
#: A stick shorter than this part of a cycle may be none: it would hold a block that creeps.
SHORTEST_STICK = 1.0 / 6.0
#: No window is shorter than this part of the others: the rest of a run joins the last one.
REMNANT = 0.5
#: Part of the free vibration's period below which no cycle lasts: sticks only make it longer.
FASTEST = 0.8
#: Least part of a cycle between two swings.
SWING = 0.6
#: A block grazes the surface's speed that slides at the crest of a swing by less than this part of
#: it, in the mean over so many 1 / omega to either side. While it slides there by less than the
#: last it is not compared: a stick too short to be seen lies within, and no longer one.
GRAZING, CREST, SLOW, LONGEST_CREST = 0.1, 0.25, 0.2, 2.5
#: Motion across the surface is seen where its scatter or its mean exceeds that of the noise so much
#: (a mean, so many standard deviations: 3 of 1000 channels at rest).
SCATTER, MEAN = 0.5, 3.0


@dataclass(frozen=True)
class Windows:
    """The windows of one run, in order of time, without gaps.

    Attributes
    ----------
    channels : the measured quantities that the model is compared with
    first : (w,) row of the track at which each starts; it ends before the next
    states : (w, 6) first guess of x, y, phi (m, m, rad), vx, vy, omega (m/s, m/s, rad/s), as the
        tracker reads them; NaN: the model's own goes on
    free : (w, 6) whether each is fitted
    hold_since : (w,) when the stick began in which a window starts, s; NaN: it starts in slip
    led_in : whether the first window is simulated and not compared
    lets_go : (b,) rows in fast sliding, one for every swing: what the contact holds next time may
        differ from there on
    crests : (n,) whether a row is so near to a crest that grazes the surface's speed that it is
        not compared
    """

    channels: tuple[str, ...]
    first: np.ndarray
    states: np.ndarray
    free: np.ndarray
    hold_since: np.ndarray
    led_in: bool
    lets_go: np.ndarray
    crests: np.ndarray

    @property
    def grazes(self) -> bool:
        """Whether the block reaches the surface's speed somewhere without a stick to be seen."""
        return bool(self.crests.any())

    @property
    def begin(self) -> int:
        """First row that is compared."""
        return int(self.first[1]) if self.led_in else 0

    @property
    def is_planar(self) -> bool:
        """Whether the block also moves across the surface."""
        return len(self.channels) > 1


def windows_of_campaign(campaign: Campaign, cycles: float = CYCLES) -> dict[str, Windows]:
    """run's name -> windows, of every run with a track."""
    planar = moves_across(campaign)
    runs = [run for run in campaign.runs if run.track is not None]
    return {run.name: windows_of(run, planar, cycles) for run in runs}


def windows_of(run: MeasuredRun, planar: bool = False, cycles: float = CYCLES) -> Windows:
    """Windows of ``cycles`` cycles. planar: y and phi, where measured, are compared as well."""
    track, period = run.motion, cycle(run)
    sticks = [s for s in sticks_of(run) if s.duration >= SHORTEST_STICK * period]
    seen = [name for name in (AXES if planar else AXES[:1]) if name in track.channels]
    begin = _begin(track, sticks, run.surface_speed, period)
    crests = _crests(run, period)
    begun, ended = (np.searchsorted(times, track.time) for times in crests.T)
    passed = np.searchsorted(track.time, crests[:, 1], side="right")
    first = _starts(track, sticks, passed, run.surface_speed, period, cycles, begin)
    if begin:
        first = np.concatenate([[0], first])
    states, free = np.full((len(first), 6), np.nan), np.zeros((len(first), 6), dtype=bool)
    if planar:  # what was not seen is free as well: carried over it would tie windows together
        states[:], free[:] = 0.0, True
    states[0] = 0.0
    hold_since = np.full(len(first), np.nan)
    for number, row in enumerate(first):
        for name in seen:
            axis = AXES.index(name)
            states[number, [axis, axis + 3]] = _place_and_velocity(track, track[name], row)
            free[number, [axis, axis + 3]] = True
        stick = _stick_at(sticks, row)
        if stick is not None:
            rows = slice(row, stick.last + 1)
            line = track.x[rows] - run.surface_speed * (track.time[rows] - track.time[row])
            states[number, [0, 3]] = np.nanmean(line), np.nan
            free[number, 3] = False
            hold_since[number] = stick.start
    free[0] &= begin == 0
    lets_go = _swings(run, period) if sticks else np.zeros(0, dtype=int)
    return Windows(tuple(seen), first, states, free, hold_since, begin > 0, lets_go, begun > ended)


def _crests(run: MeasuredRun, period: float) -> np.ndarray:
    """(c, 2) from when to when the block just reaches the surface's speed and does not stick, s.

    A crest is half way between where it turns and turns back, which noise hardly moves.
    """
    track, sticks, omega = smoothed(run), sticks_of(run), run.natural_frequency
    time, speed = track.time, track.sliding / run.surface_speed
    turns = np.diff((speed < 1.0).astype(int))
    begins, ends = np.flatnonzero(turns == 1), np.flatnonzero(turns == -1)
    ends, found = ends[ends > begins.min(initial=time.size)], []
    for begin, end in zip(time[begins], time[ends], strict=False):
        about = np.abs(time - 0.5 * (begin + end))
        slow = time[(speed < SLOW) & (about < 0.5 * (end - begin))]
        if not slow.size or end - begin < 0.25 * period or np.ptp(slow) > LONGEST_CREST / omega:
            continue
        is_stick = any(stick.start < end and begin < stick.end for stick in sticks)
        if not is_stick and np.mean(speed[about < CREST / omega]) < GRAZING:
            found.append((slow[0], slow[-1]))
    return np.reshape(found, (-1, 2))


def _swings(run: MeasuredRun, period: float) -> np.ndarray:
    """Rows at which the block slides fastest, once in a cycle."""
    track = smoothed(run)
    least = max(round(SWING * period / track.interval), 1)
    speed = np.abs(np.where(track.slips_mask, track.sliding, 0.0))
    peaks, _ = find_peaks(speed, height=abs(run.surface_speed), distance=least)
    return np.unique(np.searchsorted(run.motion.time, track.time[peaks]))


def cycle(run: MeasuredRun) -> float:
    """Period of the motion, s: of upward crossings of the mean of x, else 2 pi / omega."""
    free, found = 2.0 * math.pi / run.natural_frequency, cycle_of(run)
    return max(found, FASTEST * free) if math.isfinite(found) else free


def _begin(track: Track, sticks: list[Stick], speed: float, period: float) -> int:
    """Row of the first fast sliding, from which a run is compared; 0 where there is none."""
    begins_in_stick = bool(sticks) and math.isinf(sticks[0].start_sd) and sticks[0].first <= REACH
    rest = sticks[0].end if begins_in_stick else float(track.time[0])
    row = _fastest(track, rest + 0.5 * period, speed, period)
    return row if np.isfinite(track.x[row:]).sum() > 2 * REACH else 0


def _starts(
    track: Track, sticks: list[Stick], passed: np.ndarray, speed: float, period: float,
    cycles: float, begin: int,
) -> np.ndarray:  # fmt: skip
    """(w,) rows, the first is ``begin``; each window has samples enough for its state.

    passed : rows behind crests at which the block grazes the surface's speed
    """
    length, time = cycles * period, track.time
    onsets = np.array([s.first for s in sticks if math.isfinite(s.start_sd)], dtype=int)
    seen = np.cumsum(np.isfinite(track.x))
    starts, due, last = [begin], time[begin] + length, time[-1] - REMNANT * length
    crests = passed[(passed > begin) & (passed < time.size)].tolist()
    while crests or due < last:
        if crests and (time[crests[0]] < due or due >= last):
            row, following = crests.pop(0), due
        else:
            near = onsets[np.abs(time[onsets] - due) < max(0.5 * length, 0.5 * period)]
            near = near[time[near] < last]
            row = _fastest(track, due, speed, period) if not near.size else None
            row = int(near[np.abs(time[near] - due).argmin()]) if row is None else row
            following = due + length
        if row > starts[-1] and seen[row] - seen[starts[-1]] > 2 * REACH < seen[-1] - seen[row]:
            starts.append(row)
            following = time[row] + length
        due = following
    return np.array(starts)


def _fastest(track: Track, due: float, speed: float, period: float) -> int:
    """Row within half a cycle of ``due`` at which the block slides fastest."""
    low, high = np.searchsorted(track.time, [due - 0.5 * period, due + 0.5 * period])
    rows = low + np.flatnonzero(np.isfinite(track.x[low:high]))
    if rows.size < 3 * REACH:
        return int(np.searchsorted(track.time, due))
    before, after = rows[: -2 * REACH], rows[2 * REACH :]
    velocity = (track.x[after] - track.x[before]) / (track.time[after] - track.time[before])
    return int(rows[REACH + np.abs(velocity - speed).argmax()])


def _stick_at(sticks: list[Stick], row: int) -> Stick | None:
    """The stick that a row lies in, well before its end."""
    for stick in sticks:
        if stick.first <= row < stick.last - REACH or row == stick.first:
            return stick
    return None


def _place_and_velocity(track: Track, values: np.ndarray, row: int) -> tuple[float, float]:
    """Of a parabola through the samples about a row."""
    rows = np.arange(max(row - REACH, 0), min(row + REACH + 1, values.size))
    rows = rows[np.isfinite(values[rows])]
    if rows.size < 4:
        return float(np.nanmean(values[rows])) if rows.size else 0.0, 0.0
    place, velocity, _ = np.polynomial.polynomial.polyfit(
        track.time[rows] - track.time[row], values[rows], 2
    )
    return float(place), float(velocity)


def moves_across(campaign: Campaign) -> bool:
    """Whether any run shows motion along y, or a turn; False where the rig allows neither.

    As in the rows: an effect that they name across has nothing to move in a block that is guided.
    """
    free = set(campaign.rig.degrees_of_freedom) & {"y", "phi"}
    return bool(free) and any(
        _moves(run, channel, campaign.zero_sd(run, channel) / run.noise[channel])
        or (channel == "y" and across.moves_across(run))
        for run in campaign.runs
        if run.track is not None
        for channel in ("y", "phi")
        if channel in run.motion.channels
    )


def _moves(run: MeasuredRun, channel: str, zero: float) -> bool:
    """By means of a few samples each. zero: standard deviation of the tracker's, noise units."""
    values = run.motion[channel] / run.noise[channel]
    values = values[np.isfinite(values)]
    each = max(5, values.size // 200)
    means = values[: values.size // each * each].reshape(-1, each).mean(axis=1)
    scatter = math.sqrt(max(float(np.var(means)) - 1.0 / each, 0.0))
    return scatter > SCATTER or abs(float(means.mean())) > MEAN * math.hypot(zero, 1.0 / each)
