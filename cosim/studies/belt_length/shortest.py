"""The shortest belt on which the drift stays below a limit: of a rig as it is, and in doubt.

In doubt it is between the lengths for which the doubt is known.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from scipy.optimize import brentq

from .case import Case
from .uncertainty import INTERVAL, Uncertainty

#: Longest belt that is looked at, m.
LONGEST = 50.0
#: How well the length is found, relative; the drift is known to less.
_TOLERANCE = 5e-3
#: The rises of a study -> the quantiles of each in `Uncertainty`.
QUANTILES = {
    "run": {"median": "median", "high": "high"},
    "interface": {"median": "interface_median", "high": "interface_high"},
}
#: What the levels are called.
LEVELS = {"median": "median", "high": f"{INTERVAL[1]:.0%} level"}


@dataclass(frozen=True)
class Length:
    """Shortest belt, m; None with the reason. says: for tables, such as 1.6, <1 or >4."""

    length: float | None
    says: str
    reason: str = ""


def shortest_belt(
    case: Case, limit: float, drift: Callable[[Case], float], longest: float = LONGEST
) -> float | None:
    """Length, m; the shortest that has room when that does already, None when `longest` does not.

    drift: of a case, K; it falls with the length. limit: K, > 0.
    """

    def excess(log_length: float) -> float:
        return math.log(max(drift(case.with_length(math.exp(log_length))), 1e-9) / limit)

    low, high = math.log(case.shortest), math.log(max(longest, case.shortest))
    if excess(low) <= 0.0:
        return case.shortest
    if excess(high) > 0.0:
        return None
    return math.exp(brentq(excess, low, high, xtol=_TOLERANCE))


def shortest_in_doubt(
    lengths: Sequence[float], doubts: Sequence[Uncertainty | None], limit: float
) -> dict[str, dict[str, Length]]:
    """Shortest belts by rise and level, `QUANTILES`; limit in K.

    lengths: in m, increasing, with the doubt on each. Nothing is told beyond them.
    """
    if None in doubts:
        unknown = Length(None, "", "no doubt was computed: --samples 0, or the ice melts")
        return {rise: dict.fromkeys(levels, unknown) for rise, levels in QUANTILES.items()}
    return {
        rise: {
            level: _between(lengths, [getattr(one, name) for one in doubts], limit, LEVELS[level])
            for level, name in levels.items()
        }
        for rise, levels in QUANTILES.items()
    }


def _between(lengths: Sequence[float], rises: Sequence[float], limit: float, level: str) -> Length:
    """Beyond the last belt that is above the limit; straight in the logarithms of both."""
    above = [i for i, rise in enumerate(rises) if rise > limit]
    if not above:
        return Length(lengths[0], f"<{lengths[0]:g}", "the shortest of the belts asked for")
    last = above[-1]
    if last == len(lengths) - 1:
        return Length(
            None,
            f">{lengths[-1]:g}",
            f"on {lengths[-1]:g} m, the longest belt asked for, the {level} is {rises[-1]:.2g} K",
        )
    # a rise that falls to nothing within a step would draw the place to the shorter belt
    below = max(rises[last + 1], 0.1 * limit)
    part = math.log(rises[last] / limit) / math.log(rises[last] / below)
    length = lengths[last] * (lengths[last + 1] / lengths[last]) ** part
    return Length(length, f"{length:.2g}")
