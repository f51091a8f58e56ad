"""How far the springs must be stretched for a block to keep to its line.

Springs without pretension push sideways where they are compressed, and turn the block away from the
line on which friction drags it. Pretension holds it there, as the tension of a string does.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import copysign, sqrt

import numpy as np

from ..parameters import Parameters
from .live import DRY, Interface
from .stability import GRAZING, Stability, cycle_stability

#: Pretensions that are looked at, as parts of the spring's installed length: steps and the most.
FINE, COARSE, MOST = 0.005, 0.01, 0.30
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
    parameters: Parameters, duration: float = 30.0, interface: Interface = DRY, step: float = FINE
) -> PretensionBorders:
    """Where a run of ``duration`` (s) is unstable, everything but the pretension as given.

    interface: its temperature and the water in it. step: of the search, part of the installed
    length. Raises `live.RunEnded` where a motion cannot be followed.
    """

    def at(pretension: float) -> Stability:
        return cycle_stability(with_pretension(parameters, pretension), duration, interface)

    def excess(motion: Stability) -> float:
        return motion.growth - 1.0 - ROUNDING

    steps = parameters.rig.spring_length * np.arange(0.0, MOST + 0.5 * step, step)
    found = [at(pretension) for pretension in steps]
    unstable = [one.multipliers.size > 0 and one.growth > 1.0 + ROUNDING for one in found]
    borders, resolution = [0.0] if unstable[0] else [], RESOLUTION
    for i in np.flatnonzero(np.diff(unstable)):
        if GRAZING in (found[i].verdict, found[i + 1].verdict):
            border, resolution = 0.5 * (steps[i] + steps[i + 1]), steps[1]
        else:
            low, high = ((float(steps[n]), excess(found[n])) for n in (i, i + 1))
            border = root_between(lambda pretension: excess(at(pretension)), low, high, RESOLUTION)
        borders.append(float(border))
    closed = [*borders[1::2], None] if unstable[-1] else borders[1::2]
    return PretensionBorders(tuple(zip(borders[::2], closed, strict=True)), float(resolution))


def root_between(
    function: Callable[[float], float],
    low: tuple[float, float],
    high: tuple[float, float],
    within: float,
) -> float:
    """Where a function is 0, by Ridders' method, which at least bisects.

    Here, since scipy's takes longer to import than to find it.

    low, high : two places and the function's values there, of different signs; within : to which
    the root is found

    >>> round(root_between(lambda x: x * x - 2.0, (0.0, -2.0), (2.0, 2.0), 1e-9), 8)
    1.41421356
    """
    (a, at_a), (b, at_b) = low, high
    best = a if at_a == 0.0 else b
    while at_a * at_b < 0.0 and abs(b - a) > within:
        middle = 0.5 * (a + b)
        at_middle = function(middle)
        half, curved = middle - a, sqrt(at_middle * at_middle - at_a * at_b)
        found = middle + half * copysign(1.0, at_a) * at_middle / curved
        at_found = function(found)
        if abs(found - best) <= within or at_found == 0.0:
            return found
        best = found
        for place, value in ((middle, at_middle), (found, at_found)):
            if a < place < b or b < place < a:
                if value * at_a < 0.0:
                    b, at_b = place, value
                else:
                    a, at_a = place, value
    return best


def with_pretension(parameters: Parameters, pretension: float) -> Parameters:
    """The same rig, its springs stretched by ``pretension`` (m) as installed."""
    natural = parameters.rig.spring_length - pretension
    return parameters.with_values("rig", spring_natural_length=natural)
