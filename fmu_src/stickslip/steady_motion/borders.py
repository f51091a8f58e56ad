"""How near a rig is to a border: at which values of its numbers its motion becomes another.

Each number is changed alone, in steps, until the block does something else: sticks no more, or
leaves its line. Between the last two values the border is bisected.

And how far the springs must be stretched for a block to keep to its line. Springs without
pretension push sideways where they are compressed, and turn the block away from the line on which
friction drags it. Pretension holds it there, as the tension of a string does.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TypeVar

import numpy as np

from ..parameters import Parameters
from .live import DRY, Interface, RunEnded
from .regimes import ENDED, regime_of
from .stability import GRAZING, Stability, cycle_stability
from .starts import disturbed

SPEED, RAMP, DAMPING = "surface.speed", "surface.run_up_time", "structural_damping.coefficient"
PRETENSION, RATIO = "pretension", "mu_s/mu_k"


@dataclass(frozen=True)
class Number:
    """A number that can be changed.

    Attributes
    ----------
    key, unit : `table.key` of a scenario, or what it is made of
    value : as the rig has it
    least : below which it cannot be
    first : what is tried first where it is 0
    change : the rig with another value
    """

    key: str
    unit: str
    value: float
    least: float
    first: float
    change: Callable[[Parameters, float], Parameters]


def numbers_of(parameters: Parameters) -> list[Number]:
    """Speed, its ramp, damping, pretension where the block is not guided, and mu_s/mu_k."""
    rig, surface, friction = parameters.rig, parameters.surface, parameters.friction
    damping = parameters.structural_damping.coefficient
    found = [
        Number(SPEED, "m/s", abs(surface.speed), 0.0, 0.01, at_speed),
        Number(RAMP, "s", surface.run_up_time, 0.0, 1.0, _setting("surface", "run_up_time")),
        Number(
            DAMPING,
            "N s/m",
            damping,
            0.0,
            1e-3 * parameters.critical_damping,
            _setting("structural_damping", "coefficient"),
        ),
    ]
    if rig.degrees_of_freedom != ("x",):
        stretched = round(rig.spring_length - rig.spring_natural_length, 12)
        first = 0.01 * rig.spring_length
        found.append(Number(PRETENSION, "m", stretched, 0.0, first, with_pretension))
    if friction.mu_k > 0.0 and not friction.has_table:
        ratio = friction.mu_s / friction.mu_k
        found.append(Number(RATIO, "1", ratio, 1.0, 0.1, with_ratio))
    return found


def at_speed(parameters: Parameters, speed: float) -> Parameters:
    """The same rig on a surface of another speed; a block that starts with the surface's keeps it.

    The direction is that of the rig.
    """
    surface = parameters.surface
    speed = -abs(speed) if surface.speed < 0.0 else abs(speed)
    changed = parameters.with_values("surface", speed=speed)
    rides = parameters.initial.vx == surface.speed
    return changed.with_values("initial", vx=speed) if rides else changed


def with_ratio(parameters: Parameters, ratio: float) -> Parameters:
    """The same rig with another mu_s/mu_k at its mu_k."""
    return parameters.with_values("friction", mu_s=ratio * parameters.friction.mu_k)


def with_pretension(parameters: Parameters, pretension: float) -> Parameters:
    """The same rig, its springs stretched by ``pretension`` (m) as installed."""
    natural = parameters.rig.spring_length - pretension
    return parameters.with_values("rig", spring_natural_length=natural)


def _setting(table: str, key: str) -> Callable[[Parameters, float], Parameters]:
    return lambda parameters, value: parameters.with_values(table, **{key: value})


#: Factors at which a number is tried, up and down, and of one that is 0, times its first value.
FACTORS, FROM_NOTHING = (1.1, 1.25, 1.5, 2.0), (1.0, 2.0, 5.0, 10.0)
#: To what part of itself a border is found, and where it is asked for.
COARSE, FINE = 0.01, 1e-4
#: Range of `all_borders`, as a factor, and how many values of it are tried.
FARTHEST, COUNT = 10.0, 49

#: What a block does: the name of its regime, and whether it does so beside its line.
Kind = tuple[str, bool]
Seen = TypeVar("Seen")


@dataclass(frozen=True)
class Border:
    """A value of a number at which the motion becomes another.

    below, above : what the block does on either side: a name of `regimes`, "ended" where no run can
        be followed, and whether it does so beside its line
    """

    number: Number
    value: float
    below: Kind
    above: Kind

    @property
    def beyond(self) -> Kind:
        """What the block does on the side on which the rig is not."""
        return self.above if self.value > self.number.value else self.below

    @property
    def margin(self) -> float | None:
        """How far the number may change, as a part of what it is above its least; None: of 0."""
        own = self.number.value - self.number.least
        return abs(self.value - self.number.value) / own if own > 0.0 else None

    def as_dict(self) -> dict[str, object]:
        """Plain numbers."""
        name, aside = self.beyond
        return {
            "key": self.number.key,
            "unit": self.number.unit,
            "value": self.number.value,
            "border": self.value,
            "margin": self.margin,
            "beyond": name,
            "aside": aside,
        }


def nearest_borders(
    parameters: Parameters, duration: float = 30.0, interface: Interface = DRY
) -> list[Border]:
    """The nearest border in each of `numbers_of`, within half and twice what it is above its least.

    The nearest of all first. Of the run as it starts, a little disturbed, as long at constant speed
    as it is in ``duration`` (s). A number without a border in that range is not in the list. Raises
    `work.OutOfWork`.
    """
    steady = duration - parameters.surface.run_up_time
    found = []
    for number in numbers_of(parameters):
        does = follower(disturbed(parameters), number, steady, interface)
        sides = (next(changes(does, number, values, COARSE), None) for values in _outward(number))
        found += sorted(filter(None, sides), key=lambda border: border.margin or 0.0)[:1]
    return sorted(found, key=lambda border: 1.0 if border.margin is None else border.margin)


def all_borders(
    parameters: Parameters,
    number: Number,
    duration: float = 30.0,
    interface: Interface = DRY,
    look: Callable[[], object] = lambda: None,
) -> list[Border]:
    """Every border in a number, from a tenth of what it is above its least to ten times that.

    From the run's own start. Of one that is 0, about its first value. look: called after each
    step.
    """
    least = number.least
    own = number.value - least if number.value > least else number.first
    values = least + own * np.geomspace(1.0 / FARTHEST, FARTHEST, COUNT)
    steady = duration - parameters.surface.run_up_time
    does = follower(parameters, number, steady, interface)

    def counted(value: float) -> Kind:
        kind = does(value)
        look()
        return kind

    return list(changes(counted, number, values.tolist(), FINE))


def follower(
    parameters: Parameters, number: Number, steady: float, interface: Interface = DRY
) -> Callable[[float], Kind]:
    """What the block does for a value of a number, in a run of ``steady`` s at constant speed."""

    def does(value: float) -> Kind:
        changed = number.change(parameters, value)
        try:
            regime = regime_of(changed, steady + changed.surface.run_up_time, interface)
        except RunEnded:
            return ENDED, False
        return regime.name, regime.is_aside

    return does


def changes(
    does: Callable[[float], Kind], number: Number, values: Sequence[float], resolution: float
) -> Iterator[Border]:
    """Borders between values that are tried one after the other, bisected."""
    for pair in pairwise((value, does(value)) for value in values):
        if pair[0][1] != pair[1][1]:
            (low, below), (high, above) = sorted(bisected(does, *pair, resolution, number.least))
            yield Border(number, 0.5 * (low + high), below, above)


def bisected(
    does: Callable[[float], Seen],
    one: tuple[float, Seen],
    other: tuple[float, Seen],
    part: float = 0.0,
    least: float = 0.0,
    within: float = 0.0,
) -> tuple[tuple[float, Seen], tuple[float, Seen]]:
    """Two values near to each other and what is seen there, from two at which that differs.

    They are no further apart than a part of what they are above the least, or than ``within``.
    """
    while abs(other[0] - one[0]) > max(part * (max(one[0], other[0]) - least), within):
        middle = 0.5 * (one[0] + other[0])
        seen = middle, does(middle)
        one, other = (seen, other) if seen[1] == one[1] else (one, seen)
    return one, other


def _outward(number: Number) -> tuple[list[float], list[float]]:
    """Values from the number's own on, up and down."""
    own, least = number.value, number.least
    if own <= least:
        return [own, *(least + factor * number.first for factor in FROM_NOTHING)], []
    up = [least + factor * (own - least) for factor in FACTORS]
    down = [least + (own - least) / factor for factor in FACTORS]
    return [own, *up], [own, *down]


#: Pretensions that are looked at, as parts of the spring's installed length: steps and the most.
FINE_STEP, COARSE_STEP, MOST = 0.005, 0.01, 0.30
#: Of a multiplier of 1, that of a motion beside which nothing grows or dies out.
ROUNDING = 1e-5
#: To which a border is found that the multipliers pass through 1 at, m.
RESOLUTION = 1e-5


@dataclass(frozen=True)
class PretensionBorders:
    """Extensions of the springs as installed at which a motion is unstable.

    windows : (begin, end), m, growing; an end of None is beyond what was looked at, `MOST` of the
        installed length. A window narrower than a step of the search can be missed.
    resolution : to which they are known, m: a step of the search where the motion grazes there
    """

    windows: tuple[tuple[float, float | None], ...]
    resolution: float = RESOLUTION

    @property
    def least(self) -> float | None:
        """Least pretension that is not unstable, m; None where there is none."""
        if not self.windows or self.windows[0][0] > 0.0:
            return 0.0
        return self.windows[0][1]


def pretension_borders(
    parameters: Parameters,
    duration: float = 30.0,
    interface: Interface = DRY,
    step: float = FINE_STEP,
) -> PretensionBorders:
    """Where a run of ``duration`` (s) is unstable, everything but the pretension as given.

    interface: its temperature and the water in it. step: of the search, part of the installed
    length. Raises `live.RunEnded` where a motion cannot be followed.
    """

    def at(pretension: float) -> Stability:
        return cycle_stability(with_pretension(parameters, pretension), duration, interface)

    def is_unstable(motion: Stability) -> bool:
        return motion.multipliers.size > 0 and motion.growth > 1.0 + ROUNDING

    steps = (parameters.rig.spring_length * np.arange(0.0, MOST + 0.5 * step, step)).tolist()
    found = [at(pretension) for pretension in steps]
    unstable = [*map(is_unstable, found)]
    borders, resolution = [0.0] if unstable[0] else [], RESOLUTION
    for i in np.flatnonzero(np.diff(unstable)):
        ends = (steps[i], unstable[i]), (steps[i + 1], unstable[i + 1])
        if GRAZING in (found[i].verdict, found[i + 1].verdict):
            resolution = steps[1]
        else:
            ends = bisected(lambda each: is_unstable(at(each)), *ends, within=RESOLUTION)
        borders.append(0.5 * (ends[0][0] + ends[1][0]))
    closed = [*borders[1::2], None] if unstable[-1] else borders[1::2]
    return PretensionBorders(tuple(zip(borders[::2], closed, strict=True)), resolution)
