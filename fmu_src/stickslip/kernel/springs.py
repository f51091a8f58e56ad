"""Four linear springs with exact geometry, between anchors in the rig and the block."""

from math import cos, sin, sqrt

from .layout import (
    P_ANCHOR,
    P_ATTACH,
    P_NATURAL_LENGTH,
    P_STIFFNESS,
    PHI,
    W_LOAD,
    X,
    Y,
)


def add_spring_forces(p: "float[:]", w: "float[:]", state: int):
    """Add force (N) and moment (N m) of the springs on the block to ``w[W_LOAD:]``.

    Spring i pulls its attachment r_i = (x, y) + R(phi) b_i towards its anchor A_i with
    k (l_i - l_0), l_i = |A_i - r_i|: no linearisation in x, y or phi.
    """
    c = cos(w[state + PHI])
    s = sin(w[state + PHI])
    k = p[P_STIFFNESS]
    for i in range(4):
        bx = p[P_ATTACH + 2 * i]
        by = p[P_ATTACH + 2 * i + 1]
        arm_x = c * bx - s * by
        arm_y = s * bx + c * by
        dx = p[P_ANCHOR + 2 * i] - w[state + X] - arm_x
        dy = p[P_ANCHOR + 2 * i + 1] - w[state + Y] - arm_y
        length = sqrt(dx * dx + dy * dy)
        tension = k * (length - p[P_NATURAL_LENGTH]) / length
        w[W_LOAD] += tension * dx
        w[W_LOAD + 1] += tension * dy
        w[W_LOAD + 2] += tension * (arm_x * dy - arm_y * dx)


def spring_energy(p: "float[:]", x: float, y: float, phi: float) -> float:
    """Elastic energy of the four springs, J."""
    c = cos(phi)
    s = sin(phi)
    energy = 0.0
    for i in range(4):
        bx = p[P_ATTACH + 2 * i]
        by = p[P_ATTACH + 2 * i + 1]
        dx = p[P_ANCHOR + 2 * i] - x - (c * bx - s * by)
        dy = p[P_ANCHOR + 2 * i + 1] - y - (s * bx + c * by)
        stretch = sqrt(dx * dx + dy * dy) - p[P_NATURAL_LENGTH]
        energy += 0.5 * p[P_STIFFNESS] * stretch * stretch
    return energy


def shortest_spring(p: "float[:]", z: "float[:]", block: int) -> float:
    """Length of the shortest of the four springs at a block of ``z``, m."""
    c = cos(z[block + PHI])
    s = sin(z[block + PHI])
    shortest = 1e300
    for i in range(4):
        bx = p[P_ATTACH + 2 * i]
        by = p[P_ATTACH + 2 * i + 1]
        dx = p[P_ANCHOR + 2 * i] - z[block + X] - (c * bx - s * by)
        dy = p[P_ANCHOR + 2 * i + 1] - z[block + Y] - (s * bx + c * by)
        shortest = min(shortest, sqrt(dx * dx + dy * dy))
    return shortest
