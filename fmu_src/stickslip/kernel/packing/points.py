"""Curves through given points: how many there are, and slopes that keep them monotone.

Fritsch & Butland, SIAM J. Sci. Stat. Comput. 5 (1984). In ``v`` a curve is two rows of CURVE_LIMIT
places, abscissae and ordinates. In ``p`` it is points of a width: abscissa, ordinate, slope there.
"""

from __future__ import annotations

from .. import Floats
from ..friction.table import joined_slope
from ..layout import CURVE_LIMIT


def count_points(v: Floats, first: int) -> int:
    """Points of the curve whose abscissae begin at ``v[first]``, see `count_grown`."""
    return count_grown(v, first, CURVE_LIMIT)


def count_grown(v: Floats, first: int, limit: int) -> int:
    """Numbers of a row of ``limit`` places from ``v[first]`` on: it ends where they stop growing.

    The places that it leaves unused do not count, and one number is no row: then 0.
    """
    count = 1
    while count < limit and v[first + count] > v[first + count - 1]:
        count += 1
    if count == 1:
        return 0
    return count


def copy_points(v: Floats, x: int, y: int, count: int, p: Floats, at: int, width: int) -> None:
    """Put abscissae ``v[x:]`` and ordinates ``v[y:]`` into the points ``p[at:]``."""
    for i in range(count):
        p[at + width * i] = v[x + i]
        p[at + width * i + 1] = v[y + i]


def secant(p: Floats, at: int, width: int) -> float:
    """Slope from the point ``p[at:]`` to the next."""
    return (p[at + width + 1] - p[at + 1]) / (p[at + width] - p[at])


def inner_slope(p: Floats, at: int, width: int) -> float:
    """Slope at a point between two: weighted harmonic mean of the secants; 0 at an extremum."""
    span_before = p[at] - p[at - width]
    span_after = p[at + width] - p[at]
    return joined_slope(span_before, secant(p, at - width, width), span_after, secant(p, at, width))
