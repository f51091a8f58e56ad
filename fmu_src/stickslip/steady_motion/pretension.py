"""How far the springs must be stretched for a block to keep to its line.

Springs without pretension push sideways where they are compressed, and turn the block away from the
line on which friction drags it. Pretension holds it there, as the tension of a string does.
"""

from dataclasses import dataclass

import numpy as np

from ..parameters import Parameters
from .borders import bisected
from .live import DRY, Interface
from .numbers import with_pretension
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
