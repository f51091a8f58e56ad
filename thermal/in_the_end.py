"""Where steady sliding ends: how warm the interface gets for ever, and when it is nearly there."""

import math
from functools import lru_cache
from typing import NamedTuple

from .parameters import ThermalParameters
from .steady_sliding import SteadySliding

#: Waves of the belt's series in a metre, and at most: the mean interface needs no more, 0.5 %.
_WAVES_PER_METRE, _MOST_WAVES = 150, 1500
#: Steps are so much longer than usual, which changes a rise by less than 1 %.
_COARSENESS = 4.0
#: First look after the ramp, s, and from one to the next a factor; the last, s (some 30 years).
_FIRST, _FACTOR, _LAST = 1.0, 1.5, 1e9


class End(NamedTuple):
    """Of steady sliding that goes on for ever.

    rise: of the interface, mean of the two faces, K above the air; None where the block melts for
    ever. reached: time from standstill, s, from which on the interface is within a part `within` of
    that rise.
    """

    rise: float | None
    reached: float | None
    within: float


@lru_cache(maxsize=16)
def in_the_end(
    parameters: ThermalParameters, speed: float, force: float, ramp: float, within: float = 0.05
) -> End:
    """The end of a belt's sliding at a speed (m/s, > 0) under friction (N, > 0) after a ramp (s).

    NoSteadyState where the belt gives its heat to nothing.

    >>> found = in_the_end(ThermalParameters(), 0.15, 1.4, 10.0)
    >>> round(found.rise, 2), round(found.reached, -2)
    (0.12, 1000.0)
    """
    waves = min(math.ceil(_WAVES_PER_METRE * max(1.0, parameters.belt.length)), _MOST_WAVES)
    sliding = SteadySliding(parameters, speed, force, waves)
    ended = sliding.settle()
    if ended.melting > 0.0:
        return End(None, None, within)
    sliding.reset()
    least = (1.0 - within) * ended.mean_interface
    before = sliding.ramp(ramp, _COARSENESS)
    span = _FIRST
    while before.time < _LAST:
        now = sliding.run(span, _COARSENESS)
        if now.mean_interface >= least:
            gained = now.mean_interface - before.mean_interface
            part = (least - before.mean_interface) / gained if gained > 0.0 else 1.0
            reached = before.time + max(part, 0.0) * (now.time - before.time)
            return End(ended.mean_interface, float(reached), within)
        before, span = now, _FACTOR * span
    return End(ended.mean_interface, None, within)
