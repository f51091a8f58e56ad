"""A root between two places: here, since scipy's takes longer to import than to find it."""

from collections.abc import Callable
from math import copysign, sqrt


def root_between(
    function: Callable[[float], float],
    low: tuple[float, float],
    high: tuple[float, float],
    within: float,
) -> float:
    """Where a function is 0, by Ridders' method, which at least bisects.

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
