"""Pieces of a cubic through given points, and slopes that keep it monotone (PCHIP).

Fritsch & Butland, SIAM J. Sci. Stat. Comput. 5 (1984).
"""


def between(t: float, low: float, high: float, a: float, b: float) -> float:
    """The cubic from ``low`` at t = 0 to ``high`` at t = 1, with the slopes a and b there."""
    rise = high - low
    return low + t * (a + t * (3.0 * rise - 2.0 * a - b + t * (a + b - 2.0 * rise)))


def joined_slope(
    span_before: float, rise_before: float, span_after: float, rise_after: float
) -> float:
    """PCHIP's slope at a point between two pieces of such widths and secants; 0 at an extremum."""
    if rise_before * rise_after <= 0.0:
        return 0.0
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
