"""Kinetic friction by a table over the local sliding speed: PCHIP inside, constant outside.

Piecewise cubic Hermite interpolation with the slopes of Fritsch & Butland (SIAM J. Sci. Stat.
Comput. 5, 1984): it passes the points, is smooth between them, and neither rises nor falls where
the points do not. The slopes are made once, in `packing`.
"""

from __future__ import annotations

from .. import Floats
from ..layout import P_TABLE, P_TABLE_POINTS, TABLE_WIDTH


def table_coefficient(p: Floats, speed: float) -> float:
    """The table's coefficient at a local sliding speed, m/s; ``p`` holds two points at least."""
    last = P_TABLE + TABLE_WIDTH * (int(p[P_TABLE_POINTS]) - 1)
    if speed <= p[P_TABLE]:
        return p[P_TABLE + 1]
    if speed >= p[last]:
        return p[last + 1]
    at = P_TABLE
    while speed > p[at + TABLE_WIDTH]:
        at += TABLE_WIDTH
    span = p[at + 3] - p[at]
    t = (speed - p[at]) / span
    rise = p[at + 4] - p[at + 1]
    a = span * p[at + 2]
    b = span * p[at + 5]
    return p[at + 1] + t * (a + t * (3.0 * rise - 2.0 * a - b + t * (a + b - 2.0 * rise)))
