"""Where the springs are held, and their force-length curve."""

from __future__ import annotations

from math import cos, radians, sin

from .. import Floats
from ..layout import *
from ..terms import with_anchor_shift, with_diagonal_shift, with_frame_turn, with_spring_turn
from .imperfections import departure
from .points import copy_points, count_points, inner_slope, secant


def place_springs(v: Floats, d: Floats, p: Floats) -> None:
    """Attachments on the block, and anchors one spring length away from them.

    The springs lie along x, but for the turn and the shift that an effect gives them. A spring
    shorter than a twentieth of its installed length has collapsed: the block has been carried into
    the anchor, where the direction of the spring force has no meaning any more.
    """
    length = v[V_RIG_SPRING_LENGTH]
    if p[P_STIFFNESS] > 0.0:
        p[P_SHORTEST] = 0.05 * length
    turn = with_spring_turn(p, v, 0.0)
    frame = with_frame_turn(p, v, 0.0)
    shift = with_anchor_shift(p, v, 0.0)
    diagonal = with_diagonal_shift(p, v, 0.0)
    for i in range(4):
        angle = radians(v[V_RIG_ATTACHMENT_ANGLES_DEG + i])
        bx = v[V_RIG_ATTACHMENT_RADIUS] * cos(angle)
        by = v[V_RIG_ATTACHMENT_RADIUS] * sin(angle)
        outward = length
        if bx < 0.0:
            outward = -length
        p[P_ATTACH + 2 * i] = bx
        p[P_ATTACH + 2 * i + 1] = by
        ax = bx + outward * cos(turn)
        ay = by + outward * sin(turn)
        aside = shift - diagonal
        if i == 0 or i == 3:
            aside = shift + diagonal
        p[P_ANCHOR + 2 * i] = cos(frame) * ax - sin(frame) * ay
        p[P_ANCHOR + 2 * i + 1] = sin(frame) * ax + cos(frame) * ay + aside
    for i in range(4):
        more = departure(d, D_SPRING_STIFFNESS + i, v[V_IMPERFECTIONS_SPRING_STIFFNESS])
        p[P_RELATIVE_STIFFNESS + i] = 1.0 + more
    for i in range(8):
        p[P_ANCHOR + i] += departure(d, D_ANCHOR_POSITION + i, v[V_IMPERFECTIONS_ANCHOR_POSITION])


def set_force_curve(v: Floats, p: Floats) -> None:
    """Points of the force-length curve with monotone slopes, and the energies under it, J.

    Beyond its ends it goes on as straight as its first and its last piece on the whole.
    """
    extension = V_SPRINGS_FORCE_CURVE_EXTENSION
    count = count_points(v, extension)
    if count == 0:
        return
    p[P_CURVE_POINTS] = float(count)
    copy_points(v, extension, V_SPRINGS_FORCE_CURVE_FORCE, count, p, P_CURVE, CURVE_WIDTH)
    last = P_CURVE + CURVE_WIDTH * (count - 1)
    p[P_CURVE + 2] = secant(p, P_CURVE, CURVE_WIDTH)
    p[last + 2] = secant(p, last - CURVE_WIDTH, CURVE_WIDTH)
    for i in range(1, count - 1):
        at = P_CURVE + CURVE_WIDTH * i
        p[at + 2] = inner_slope(p, at, CURVE_WIDTH)
    energy = 0.0
    for i in range(1, count):
        at = P_CURVE + CURVE_WIDTH * i
        before = at - CURVE_WIDTH
        h = p[at] - p[before]
        mean = h * (p[before + 1] + p[at + 1]) / 2.0
        energy += mean + h * h * (p[before + 2] - p[at + 2]) / 12.0
        p[at + 3] = energy
