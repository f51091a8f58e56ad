"""Which regime a run is in, and whether another exists beside it.

The model is started as `starts` has it, and each run is followed until its numbers repeat. Regimes
are the same where they are of one kind and their numbers agree: how often the block breaks away,
how far it swings, where, and how far it is turned.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from ..parameters import Parameters
from ..trajectory import Trajectory, break_away_frequency, slip_share
from .live import DRY, Interface, OutOfWork, RunEnded, simulated
from .starts import BALANCED, OWN, balanced, disturbed, other_starts, started

STICK_SLIP, SLIDING, STICKING, CREEPING = "stick-slip", "sliding", "sticking", "creeping"
#: Of a run that cannot be followed.
ENDED = "ended"
#: Beside the line by more than this, m and degrees, a motion is.
ASIDE_LENGTH, ASIDE_ANGLE_DEG = 2e-3, 2.0
#: Shortest run at constant speed that a regime is read from, s, and in natural periods.
SHORTEST, PERIODS = 20.0, 20.0
#: A run whose numbers do not repeat yet is made twice as long, so many times.
DOUBLINGS = 6
#: One whose frequency still wanders by more than this part after so many never repeats.
IRREGULAR, ENOUGH = 0.05, 2
#: One that swerves slowly is also started so many times as far aside, as long as that is little.
FURTHER_ASIDE = 3.0
#: Part of the run at constant speed, from its end, that is looked at.
LATE = 0.5
#: A contact that is said to stick, but slides at this part of the surface's speed, creeps.
FULL_SPEED = 0.9
#: Two regimes are the same where each number agrees to this part, or to this much (SI, degrees).
TOLERANCES = {
    "frequency": (0.01, 0.0),
    "mean_x": (0.02, 5e-4),
    "half_range_x": (0.05, 5e-4),
    "max_y": (0.1, 1e-3),
    "max_rotation_deg": (0.1, 1.0),
}
SIDEWAYS = ("max_y", "max_rotation_deg")
#: Of a block that slides: a swing that loses this part of itself from one half of the window to the
#: next dies out, one that changes by less than the second is kept up.
DIES_OUT, KEPT_UP = 1e-2, 1e-3
#: A distance from the line stays where it grows, or shrinks, by no more than these parts of itself
#: from half to half; growth by no more than the third, m or degrees, is rounding.
GROWN, SHRUNK, NOTHING = 0.002, 0.02, 1e-7


@dataclass(frozen=True)
class Regime:
    """What a run has come to in its last part.

    Attributes
    ----------
    name : stick-slip, sliding (does not stick), sticking (does not slip) or creeping (its contact
        is sheared at nearly the surface's speed and never breaks away)
    frequency : of the break-aways, from the first to the last, Hz; 0 of fewer than two
    slip_share : part of the time in slip
    mean_x, half_range_x : m; the mean of whole cycles where there are any
    max_y : largest distance from the line, m
    max_rotation_deg : largest rotation, deg
    change : of each number in `TOLERANCES`, from the first half of that part to the second
    """

    name: str
    frequency: float
    slip_share: float
    mean_x: float
    half_range_x: float
    max_y: float
    max_rotation_deg: float
    change: dict[str, float] = field(default_factory=dict)

    @property
    def repeats(self) -> bool:
        """Do its numbers stay as they are, or is it a swing that dies out while it slides?"""
        compared = {"frequency", "mean_x", "half_range_x"}
        if self.name == SLIDING and self.swing_change < 0.0:
            compared -= {"half_range_x"}
        return all(
            abs(self.change[name]) <= 0.5 * _tolerance(name, getattr(self, name))
            for name in compared
        ) and not (self.swerves or any(self._returns(name) for name in SIDEWAYS))

    @property
    def swerves(self) -> bool:
        """Does its distance from the line grow, or its rotation?"""
        return any(self.change[name] > GROWN * getattr(self, name) + NOTHING for name in SIDEWAYS)

    def _returns(self, name: str) -> bool:
        """Does a distance from the line that is more than little shrink?"""
        value = getattr(self, name)
        found: bool = value > TOLERANCES[name][1] and self.change[name] < -SHRUNK * value
        return found

    @property
    def is_aside(self) -> bool:
        """Does the block keep beside its line, or turned?"""
        return self.max_y >= ASIDE_LENGTH or self.max_rotation_deg >= ASIDE_ANGLE_DEG

    @property
    def swing_change(self) -> float:
        """Of its half range, as a part of that."""
        swing = self.half_range_x
        return self.change.get("half_range_x", 0.0) / swing if swing > 0.0 else 0.0

    def is_as(self, other: Regime) -> bool:
        """Is it the same regime, or on its way to the same?

        Numbers that still vary are the same where they are no further apart than they vary. The
        swing of a block that slides is not compared where in both it dies out, or in both is kept
        up: without damping it is as large as its start has made it.
        """
        if self.name != other.name:
            return False
        compared = set(TOLERANCES)
        if self.name == SLIDING and not _one_swings(self, other):
            compared -= {"half_range_x"}
        for name in compared:
            a, b = getattr(self, name), getattr(other, name)
            varies = abs(self.change.get(name, 0.0)) + abs(other.change.get(name, 0.0))
            if abs(a - b) > max(_tolerance(name, a), _tolerance(name, b), varies):
                return False
        return True


def _one_swings(one: Regime, other: Regime) -> bool:
    """Does one of two keep up a swing that dies out in the other?"""
    low, high = sorted((one.swing_change, other.swing_change))
    return low < -DIES_OUT and abs(high) < KEPT_UP


def _tolerance(name: str, value: float) -> float:
    part, absolute = TOLERANCES[name]
    return max(part * abs(value), absolute)


def regimes(
    parameters: Parameters, duration: float = 30.0, interface: Interface = DRY
) -> dict[str, Regime]:
    """The regime of the scenario's own run and of the other starts, by the names of `STARTS`.

    Each of the others is disturbed a little: what a rig cannot keep to is no regime of it.
    duration: of the own run, s. interface: its temperature and the water in it. Raises
    `live.RunEnded` where the own motion cannot be followed; another start of which that is so, or
    for which no work is left, is not in the answer.
    """
    found = {OWN: regime_of(parameters, duration, interface)}
    natural = PERIODS / max(parameters.natural_frequency, 0.1)
    steady = max(duration - parameters.surface.run_up_time, SHORTEST, natural)
    followed: list[tuple[Parameters, Regime]] = []
    for name, start in _starts(parameters, interface):
        known = next((regime for other, regime in followed if other == start), None)
        try:
            found[name] = known or settled_regime(start, steady, interface)
        except RunEnded:
            continue
        except OutOfWork:
            break
        followed.append((start, found[name]))
    return found


def _starts(parameters: Parameters, interface: Interface) -> Iterator[tuple[str, Parameters]]:
    """Starts by their names; the one that others may miss, of steady sliding, first."""
    try:
        yield BALANCED, disturbed(balanced(parameters, interface))
    except RunEnded:
        pass  # a rig without such a place has one start less
    for name, start in other_starts(parameters).items():
        yield name, disturbed(start)


def grouped(found: dict[str, Regime]) -> dict[str, str | None]:
    """Start -> the first start, the own one before all, that comes to the same regime.

    None for a run that has not come to one: its numbers still change.
    """
    groups: dict[str, str | None] = {}
    firsts = [OWN]
    for start, regime in found.items():
        same = [first for first in firsts if regime.is_as(found[first])]
        if not same and regime.repeats:
            firsts.append(start)
            same = [start]
        groups[start] = same[0] if same else None
    return groups | {OWN: OWN}


def coexisting(found: dict[str, Regime]) -> dict[str, Regime]:
    """Those of `regimes` that differ from the scenario's own and from each other."""
    groups = grouped(found)
    return {start: found[start] for start in found if start != OWN and groups[start] == start}


def settled_regime(parameters: Parameters, steady: float, interface: Interface = DRY) -> Regime:
    """The regime that a run comes to, made longer until its numbers repeat.

    steady: length at constant speed to begin with, s.
    """
    for doubling in range(DOUBLINGS + 1):
        length = parameters.surface.run_up_time + steady * 2.0**doubling
        found = regime_of(parameters, length, interface)
        irregular = abs(found.change["frequency"]) > IRREGULAR * found.frequency
        if found.repeats or (irregular and doubling >= ENOUGH):
            break
        if found.swerves and not found.is_aside:
            initial = parameters.initial
            further = {"y": FURTHER_ASIDE * initial.y, "phi": FURTHER_ASIDE * initial.phi}
            parameters = started(parameters, further)
    return found


def regime_of(parameters: Parameters, duration: float, interface: Interface = DRY) -> Regime:
    """The regime that a run of ``duration`` (s) has come to. RunEnded where it ends early."""
    period = 1.0 / max(parameters.natural_frequency, 0.1)
    interval = min(0.05 * period, 0.01 * duration)
    run = simulated(parameters, duration, interval, interface)
    constant = min(parameters.surface.run_up_time, duration)
    return read_regime(run, duration - LATE * (duration - constant))


def read_regime(run: Trajectory, begin: float) -> Regime:
    """The regime of a run from ``begin`` (s) on."""
    end = float(run.time[-1])
    middle = 0.5 * (begin + end)
    whole = _numbers(run, begin, end)
    first, second = _numbers(run, begin, middle), _numbers(run, middle, end)
    change = {name: second[name] - first[name] for name in TOLERANCES}
    return Regime(_name(run, begin, whole["slip_share"]), **whole, change=change)


def _numbers(run: Trajectory, begin: float, end: float) -> dict[str, float]:
    """Of a run between two times, s."""
    seen = (run.time >= begin) & (run.time <= end)
    time, x = run.time[seen], run["x"][seen]
    starts = run.slip_starts
    starts = starts[(starts >= begin) & (starts <= end)]
    frequency = break_away_frequency(starts)
    cycles = (time >= starts[0]) & (time <= starts[-1]) if starts.size > 1 else time >= begin
    if np.count_nonzero(cycles) < 2:
        cycles = time >= begin
    return {
        "frequency": 0.0 if math.isnan(frequency) else frequency,
        "slip_share": slip_share(*run.phases, begin, end),
        "mean_x": float(np.trapezoid(x[cycles], time[cycles]) / np.ptp(time[cycles])),
        "half_range_x": 0.5 * float(np.ptp(x)),
        "max_y": float(np.abs(run["y"][seen]).max()),
        "max_rotation_deg": float(np.degrees(np.abs(run["phi"][seen]).max())),
    }


def _name(run: Trajectory, begin: float, share: float) -> str:
    if share == 1.0:
        return SLIDING
    if share > 0.0:
        return STICK_SLIP
    late = run.time >= begin
    speed = abs(run["surface_speed_actual"][late][-1])
    slid = np.ptp(run["sliding_distance"][late]) / np.ptp(run.time[late])
    return CREEPING if speed > 0.0 and slid > FULL_SPEED * speed else STICKING
