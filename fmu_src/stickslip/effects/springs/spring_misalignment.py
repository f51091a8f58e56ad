"""The springs stand off the axis: turned, each or with their frame, or with anchors shifted."""

from __future__ import annotations

from collections.abc import Iterator
from math import radians

from ...quantity import Table, quantity
from ..candidate import ACROSS, Candidate, FreeParameter, Scales
from ..effect import Case, Effect


class SpringMisalignment(Table):
    """The springs stand off the axis: turned, each or with their frame, or with anchors shifted."""

    angle_deg: float = quantity(
        0.0, "deg", "turn of every spring about its attachment", ge=-60, le=60, typical=(-10, 10)
    )
    frame_angle_deg: float = quantity(
        0.0,
        "deg",
        "turn of all anchors about the middle of the rig",
        ge=-60,
        le=60,
        typical=(-10, 10),
    )
    lateral_offset: float = quantity(
        0.0, "m", "shift of all anchors along y", ge=-1, le=1, typical=(-0.03, 0.03)
    )
    diagonal_offset: float = quantity(
        0.0,
        "m",
        "shift of the anchors of springs 1 and 4 along y, of 2 and 3 by as much the other way",
        ge=-1,
        le=1,
        typical=(-0.03, 0.03),
    )


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


def candidates(s: Scales) -> Iterator[Candidate]:
    """An angle or an offset either way, under friction across the motion or without."""
    for across in (ACROSS, {}):
        for sign in (3.0, -3.0):
            angle = FreeParameter("spring_misalignment.angle_deg", sign, 2.0, -60.0, 60.0)
            yield Candidate("spring_misalignment", "angle", (angle,), across, True)
        for sign in (0.005, -0.005):
            offset = FreeParameter("spring_misalignment.lateral_offset", sign, 0.003, -1.0, 1.0)
            yield Candidate("spring_misalignment", "offset", (offset,), across, True)


EFFECT = Effect(
    id="spring_misalignment",
    table=SpringMisalignment,
    switch=("angle_deg", "frame_angle_deg", "lateral_offset", "diagonal_offset"),
    enters="springs",
    source="the source study: spring angles only estimated",
    terms=(spring_turn, frame_turn, anchor_shift, diagonal_shift),
    candidates=candidates,
    case=Case({"angle_deg": 10.0}),
)
