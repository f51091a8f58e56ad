"""How long to wait between two runs: the least pause after which the next one is as the first."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import brentq

from thermal import SteadySliding

from .case import Case

#: Shortest and longest pause that is looked at, s.
SHORTEST_PAUSE, LONGEST_PAUSE = 1.0, 6.0 * 3600.0
#: How well a pause is found, relative.
_TOLERANCE = 1e-2
#: Places at which the belt is looked at, for each length of the contact.
_PLACES = 4


@dataclass(frozen=True)
class Wait:
    """Least pauses before run number `before`, s, all pauses being equal; None with the reason.

    belt, ice: until the warmest place of the belt's face, and the ice's face, are less than the
    limit above the air; begin: both. drift: until the belt's rise at entry stays below the limit
    through that run, too.
    """

    before: int
    belt: float | None
    ice: float | None
    begin: float | None
    drift: float | None
    reason: str


def wait(case: Case, limit: float) -> Wait:
    """Of a case before its last run, the second if it has but one; limit in K."""
    runs = max(2, case.protocol.runs)
    sliding = case.sliding()
    first = replace(case, protocol=replace(case.protocol, runs=1)).follow(sliding)[1].entry
    after_first = sliding.snapshot()

    def begin(pause: float) -> tuple[float, float]:
        """Rises of belt and ice, K, where the last run begins."""
        sliding.restore(after_first)
        for run in range(1, runs):
            if run > 1:
                _one_run(case, sliding)
            case.rest(sliding, pause)
        return _warmest(sliding), sliding.state().ice_face

    def entry(pause: float) -> float:
        begin(pause)
        return _one_run(case, sliding)

    belt = _least(lambda pause: abs(begin(pause)[0]), limit)
    ice = _least(lambda pause: abs(begin(pause)[1]), limit)
    through = None if first > limit else _least(entry, limit)
    return Wait(
        runs,
        belt,
        ice,
        None if None in (belt, ice) else max(belt, ice),
        through,
        _reason(belt, ice, through, first, limit),
    )


def _one_run(case: Case, sliding: SteadySliding) -> float:
    once = replace(case, protocol=replace(case.protocol, runs=1))
    return once.follow(sliding)[1].entry


def _warmest(sliding: SteadySliding) -> float:
    """Largest rise of the belt's face, or fall below the air, K."""
    length = sliding.parameters.belt.length
    places = math.ceil(_PLACES * length / sliding.footprint.length)
    return float(np.abs(sliding.face(np.linspace(0.0, length, places, endpoint=False))).max())


def _least(rise: Callable[[float], float], limit: float) -> float | None:
    """Least pause (s) after which a rise (K) that falls with it is below the limit."""

    def excess(log_pause: float) -> float:
        return math.log(max(rise(math.exp(log_pause)), 1e-9) / limit)

    if rise(0.0) <= limit:
        return 0.0
    low, high = math.log(SHORTEST_PAUSE), math.log(LONGEST_PAUSE)
    if excess(low) <= 0.0:
        return SHORTEST_PAUSE
    if excess(high) > 0.0:
        return None
    return math.exp(brentq(excess, low, high, xtol=_TOLERANCE))


def _reason(
    belt: float | None, ice: float | None, through: float | None, first: float, limit: float
) -> str:
    """Why what is None is."""
    hours = LONGEST_PAUSE / 3600.0
    said = [
        f"the {name} is not within {limit:g} K of the air after {hours:g} h"
        for name, value in (("belt", belt), ("ice", ice))
        if value is None
    ]
    if through is None:
        said.append(
            f"the belt enters {first:.2g} K warm at the end of the first run already"
            if first > limit
            else f"after {hours:g} h the next run still takes the belt above {limit:g} K"
        )
    return "; ".join(said)
