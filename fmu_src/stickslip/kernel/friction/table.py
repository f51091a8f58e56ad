"""Kinetic friction by a table over the local sliding speed, and over the temperature: PCHIP.

Piecewise cubic Hermite interpolation with the slopes of Fritsch & Butland (SIAM J. Sci. Stat.
Comput. 5, 1984): it passes the points, is smooth between them, and neither rises nor falls where
the points do not; beyond the ends it is constant. A table over both has a row of the same speeds at
each temperature of the interface: each row is looked up at the speed, and what comes of them is
joined over the temperature in the same way. The rows' slopes are made once, in `packing`.
"""

from ..cubic import between, end_slope, joined_slope
from ..layout import *


def row_coefficient(p: Floats, row: int, speed: float) -> float:
    """Coefficient of a row of the table at a local sliding speed, m/s; it has two points at least.

    The row begins at ``p[row]``.
    """
    last = row + TABLE_WIDTH * (int(p[P_TABLE_POINTS]) - 1)
    if speed <= p[row]:
        return p[row + 1]
    if speed >= p[last]:
        return p[last + 1]
    at = row
    while speed > p[at + TABLE_WIDTH]:
        at += TABLE_WIDTH
    span = p[at + 3] - p[at]
    t = (speed - p[at]) / span
    return between(t, p[at + 1], p[at + 4], span * p[at + 2], span * p[at + 5])


def table_coefficient(p: Floats, speed: float, temperature: float) -> float:
    """The table's coefficient at a local sliding speed, m/s, and an interface temperature, degC."""
    rows = int(p[P_TABLE_ROWS])
    last = P_TABLE_TEMPERATURE + rows - 1
    if rows < 2 or temperature <= p[P_TABLE_TEMPERATURE]:
        return row_coefficient(p, P_TABLE, speed)
    if temperature >= p[last]:
        return row_coefficient(p, P_TABLE + TABLE_ROW * (rows - 1), speed)
    at = P_TABLE_TEMPERATURE
    while temperature > p[at + 1]:
        at += 1
    row = P_TABLE + TABLE_ROW * (at - P_TABLE_TEMPERATURE)
    low = row_coefficient(p, row, speed)
    high = row_coefficient(p, row + TABLE_ROW, speed)
    span = p[at + 1] - p[at]
    rise = (high - low) / span
    a = rise
    b = rise
    if at > P_TABLE_TEMPERATURE:
        span_before = p[at] - p[at - 1]
        rise_before = (low - row_coefficient(p, row - TABLE_ROW, speed)) / span_before
        a = joined_slope(span_before, rise_before, span, rise)
        if at + 1 == last:
            b = end_slope(span, rise, span_before, rise_before)
    if at + 1 < last:
        span_after = p[at + 2] - p[at + 1]
        rise_after = (row_coefficient(p, row + 2 * TABLE_ROW, speed) - high) / span_after
        b = joined_slope(span, rise, span_after, rise_after)
        if at == P_TABLE_TEMPERATURE:
            a = end_slope(span, rise, span_after, rise_after)
    return between((temperature - p[at]) / span, low, high, span * a, span * b)
