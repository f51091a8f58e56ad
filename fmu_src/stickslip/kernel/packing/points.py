"""Curves through given points: how many there are, and slopes that keep them monotone.

Fritsch & Butland, SIAM J. Sci. Stat. Comput. 5 (1984). In ``v`` a curve is two rows of CURVE_LIMIT
places, abscissae and ordinates. In ``p`` it is points of a width: abscissa, ordinate, slope there.
"""

from __future__ import annotations

from .. import Floats
from ..layout import CURVE_LIMIT


def count_points(v: Floats, first: int) -> int:
    """Points of the curve whose abscissae begin at ``v[first]``: it ends where they stop growing.

    The places that it leaves unused do not count, and one point is no curve: then 0.
    """
    count = 1
    while count < CURVE_LIMIT and v[first + count] > v[first + count - 1]:
        count += 1
    if count == 1:
        return 0
    return count


def copy_points(v: Floats, x: int, y: int, count: int, p: Floats, at: int, width: int):
    """Put abscissae ``v[x:]`` and ordinates ``v[y:]`` into the points ``p[at:]``."""
    for i in range(count):
        p[at + width * i] = v[x + i]
        p[at + width * i + 1] = v[y + i]


def secant(p: Floats, at: int, width: int) -> float:
    """Slope from the point ``p[at:]`` to the next."""
    return (p[at + width + 1] - p[at + 1]) / (p[at + width] - p[at])


def inner_slope(p: Floats, at: int, width: int) -> float:
    """Slope at a point between two: weighted harmonic mean of the secants; 0 at an extremum."""
    rise_before = secant(p, at - width, width)
    rise_after = secant(p, at, width)
    if rise_before * rise_after <= 0.0:
        return 0.0
    span_before = p[at] - p[at - width]
    span_after = p[at + width] - p[at]
    before = 2.0 * span_after + span_before
    after = span_after + 2.0 * span_before
    return (before + after) / (before / rise_before + after / rise_after)


def end_slope(span: float, rise: float, next_span: float, next_rise: float) -> float:
    """PCHIP's slope at an end: of the parabola through three points, kept monotone.

    span and rise: width and secant of the piece at the end, next_span and next_rise: of that beside
    it.
    """
    slope = ((2.0 * span + next_span) * rise - span * next_rise) / (span + next_span)
    if slope * rise <= 0.0:
        return 0.0
    if rise * next_rise <= 0.0 and abs(slope) > 3.0 * abs(rise):
        return 3.0 * rise
    return slope
