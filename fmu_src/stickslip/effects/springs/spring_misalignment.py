"""The springs stand off the axis: turned, each or with their frame, or with anchors shifted."""

from math import radians

from ...quantity import Table, quantity
from ..effect import Case, Effect


class SpringMisalignment(Table):
    """The springs stand off the axis: turned, each or with their frame, or with anchors shifted.

    angle_deg : turn of every spring about its attachment
    frame_angle_deg : turn of all anchors about the middle of the rig
    lateral_offset : shift of all anchors along y
    diagonal_offset : shift of the anchors of springs 1 and 4 along y, of 2 and 3 by as much the
        other way
    """

    angle_deg: float = quantity(0.0, "deg", ge=-60, le=60, typical=(-10, 10))
    frame_angle_deg: float = quantity(0.0, "deg", ge=-60, le=60, typical=(-10, 10))
    lateral_offset: float = quantity(0.0, "m", ge=-1, le=1, typical=(-0.03, 0.03))
    diagonal_offset: float = quantity(0.0, "m", ge=-1, le=1, typical=(-0.03, 0.03))


def spring_turn(angle_deg: float) -> float:
    """Turn of every spring about its attachment, rad."""
    return radians(angle_deg)


def frame_turn(frame_angle_deg: float) -> float:
    """Turn of all anchors about the middle of the rig, rad."""
    return radians(frame_angle_deg)


def anchor_shift(lateral_offset: float) -> float:
    """Shift of every anchor along y, m."""
    return lateral_offset


def diagonal_shift(diagonal_offset: float) -> float:
    """Shift along y of the anchors on one diagonal, and of the others the other way, m."""
    return diagonal_offset


EFFECT = Effect(
    id="spring_misalignment",
    table=SpringMisalignment,
    switch=("angle_deg", "frame_angle_deg", "lateral_offset", "diagonal_offset"),
    enters="springs",
    source="the source study: spring angles only estimated",
    terms=(spring_turn, frame_turn, anchor_shift, diagonal_shift),
    case=Case({"angle_deg": 10.0}),
)
