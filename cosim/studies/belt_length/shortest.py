"""The shortest belt on which the drift stays below a limit."""

from __future__ import annotations

import math
from collections.abc import Callable

from scipy.optimize import brentq

from .case import Case

#: Longest belt that is looked at, m.
LONGEST = 50.0
#: How well the length is found, relative; the drift is known to less.
_TOLERANCE = 5e-3


def shortest_belt(case: Case, limit: float, drift: Callable[[Case], float],
                  longest: float = LONGEST) -> float | None:
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
