"""Four springs with exact geometry between anchors in the rig and the block, and the damping."""

from math import cos, sin, sqrt

from ..cubic import between
from ..layout import *
from ..terms import with_spring_energy, with_spring_force


def curve_piece(p: Floats, extension: float) -> int:
    """Index into ``p`` of the piece of the force-length curve that an extension falls into.

    The first and the last piece extend the curve beyond its ends.
    """
    last = int(p[P_CURVE_POINTS]) - 2
    piece = 0
    while piece < last and extension > p[P_CURVE + CURVE_WIDTH * (piece + 1)]:
        piece += 1
    return P_CURVE + CURVE_WIDTH * piece


def curve_force(p: Floats, extension: float) -> float:
    """Force of the tabulated curve, N: cubic Hermite pieces, straight lines outside."""
    at = curve_piece(p, extension)
    span = p[at + 4] - p[at]
    t = (extension - p[at]) / span
    if t < 0.0:
        return p[at + 1] + p[at + 2] * (extension - p[at])
    if t > 1.0:
        return p[at + 5] + p[at + 6] * (extension - p[at + 4])
    return between(t, p[at + 1], p[at + 5], span * p[at + 2], span * p[at + 6])


def curve_energy(p: Floats, extension: float) -> float:
    """Energy under the tabulated curve from its first point, J."""
    at = curve_piece(p, extension)
    span = p[at + 4] - p[at]
    t = (extension - p[at]) / span
    if t < 0.0:
        d = extension - p[at]
        return p[at + 3] + d * (p[at + 1] + 0.5 * p[at + 2] * d)
    if t > 1.0:
        d = extension - p[at + 4]
        return p[at + 7] + d * (p[at + 5] + 0.5 * p[at + 6] * d)
    rise = p[at + 5] - p[at + 1]
    a = span * p[at + 2]
    b = span * p[at + 6]
    c = 3.0 * rise - 2.0 * a - b
    d = a + b - 2.0 * rise
    return p[at + 3] + span * t * (p[at + 1] + t * (a / 2.0 + t * (c / 3.0 + t * d / 4.0)))


def spring_tension(p: Floats, extension: float) -> float:
    """Force of one spring, N: linear or by the tabulated curve, and what the effects add."""
    more = with_spring_force(p, 0.0, extension)
    if p[P_CURVE_POINTS] > 0.0:
        return curve_force(p, extension) + more
    return p[P_STIFFNESS] * extension + more


def spring_energy(p: Floats, extension: float) -> float:
    """Energy of one spring, J: the integral of `spring_tension`."""
    more = with_spring_energy(p, 0.0, extension)
    if p[P_CURVE_POINTS] > 0.0:
        return curve_energy(p, extension) + more
    return 0.5 * p[P_STIFFNESS] * extension * extension + more


def add_spring_forces(p: Floats, w: Floats, state: int) -> None:
    """Add force (N) and moment (N m) of the springs on the block to ``w[W_LOAD:]``.

    Spring i pulls its attachment r_i = (x, y) + R(phi) b_i towards its anchor A_i with the tension
    of its extension |A_i - r_i| - l_0: no linearisation in x, y or phi.
    """
    c = cos(w[state + PHI])
    s = sin(w[state + PHI])
    x = w[state + X]
    y = w[state + Y]
    force_x = 0.0
    force_y = 0.0
    moment = 0.0
    for i in range(4):
        bx = p[P_ATTACH + 2 * i]
        by = p[P_ATTACH + 2 * i + 1]
        arm_x = c * bx - s * by
        arm_y = s * bx + c * by
        dx = p[P_ANCHOR + 2 * i] - x - arm_x
        dy = p[P_ANCHOR + 2 * i + 1] - y - arm_y
        length = sqrt(dx * dx + dy * dy)
        tension = p[P_RELATIVE_STIFFNESS + i] * spring_tension(p, length - p[P_NATURAL_LENGTH])
        pull = tension / length
        force_x += pull * dx
        force_y += pull * dy
        moment += pull * (arm_x * dy - arm_y * dx)
    w[W_LOAD] += force_x
    w[W_LOAD + 1] += force_y
    w[W_LOAD + 2] += moment


def damping_per_speed(p: Floats, vx: float, vy: float) -> float:
    """Damping force over the speed in the frame, N s/m: d + q |v| + F / (v^2 + v_0^2)^(1/2)."""
    if p[P_DAMPING_QUADRATIC] == 0.0 and p[P_DAMPING_DRY] == 0.0:
        return p[P_DAMPING]
    square = vx * vx + vy * vy
    d = p[P_DAMPING] + p[P_DAMPING_QUADRATIC] * sqrt(square)
    return d + p[P_DAMPING_DRY] / sqrt(square + p[P_DAMPING_DRY_SPEED] * p[P_DAMPING_DRY_SPEED])


def add_damping(p: Floats, w: Floats, state: int) -> None:
    """Add the damping against the frame (structural_damping) to ``w[W_LOAD:]``."""
    d = damping_per_speed(p, w[state + VX], w[state + VY])
    w[W_LOAD] -= d * w[state + VX]
    w[W_LOAD + 1] -= d * w[state + VY]
    w[W_LOAD + 2] -= p[P_DAMPING_ROTATION] * w[state + OMEGA]


def damping_power(p: Floats, w: Floats, state: int) -> float:
    """Power that the damping takes, W."""
    vx = w[state + VX]
    vy = w[state + VY]
    omega = w[state + OMEGA]
    d = damping_per_speed(p, vx, vy)
    return d * (vx * vx + vy * vy) + p[P_DAMPING_ROTATION] * omega * omega


def spring_length(p: Floats, z: Floats, instant: int, i: int) -> float:
    """Length of spring i at an instant in ``z``, m."""
    c = cos(z[instant + PHI])
    s = sin(z[instant + PHI])
    bx = p[P_ATTACH + 2 * i]
    by = p[P_ATTACH + 2 * i + 1]
    dx = p[P_ANCHOR + 2 * i] - z[instant + X] - (c * bx - s * by)
    dy = p[P_ANCHOR + 2 * i + 1] - z[instant + Y] - (s * bx + c * by)
    return sqrt(dx * dx + dy * dy)


def elastic_energy(p: Floats, z: Floats, instant: int) -> float:
    """Elastic energy of the four springs at an instant in ``z``, J."""
    energy = 0.0
    for i in range(4):
        extension = spring_length(p, z, instant, i) - p[P_NATURAL_LENGTH]
        energy += p[P_RELATIVE_STIFFNESS + i] * spring_energy(p, extension)
    return energy


def shortest_spring(p: Floats, z: Floats, instant: int) -> float:
    """Length of the shortest of the four springs at an instant in ``z``, m."""
    shortest = 1e300
    for i in range(4):
        shortest = min(shortest, spring_length(p, z, instant, i))
    return shortest
