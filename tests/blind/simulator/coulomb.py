"""The plain model without any smoothing: Coulomb friction along x, piecewise in closed form."""

from __future__ import annotations

from math import atan2, cos, hypot, pi, sin, sqrt

import numpy as np
from numba import njit


@njit(cache=True)
def glide_time(x, v, middle, omega, speed, sign):
    """Time until a gliding block has the speed of the surface again, s.

    x = middle + A cos(omega t + theta); sign is that of (speed - v). Infinite if it never has.
    """
    a, b = x - middle, v / omega
    amplitude, theta = hypot(a, b), atan2(-b, a)
    ratio = -speed / (amplitude * omega) if amplitude > 0.0 else 2.0
    if abs(ratio) >= 1.0:
        return np.inf
    first = np.arcsin(ratio)  # sin(omega t + theta) = ratio
    best = np.inf
    for root in (first, pi - first):
        turn = (root - theta) % (2.0 * pi)
        rising = -omega * amplitude * cos(root)
        # the relative speed closes only where the block accelerates towards the surface's
        if rising * sign > 0.0 and turn > 1e-9 and turn / omega < best:
            best = turn / omega
    return best


@njit(cache=True)
def plain_motion(x, v, mass, stiffness, speed, mu_s, mu_k, step, rows):
    """Displacement at step, 2 step, ... of a block on all four springs (stiffness: their sum), m.

    A block within 1e-3 of the surface's speed (m/s at least 1 um/s) counts as riding on it.
    """
    out = np.empty(rows)
    omega, n = sqrt(stiffness / mass), 9.81 * mass
    reach = mu_s * n / stiffness
    riding = abs(v - speed) <= 1e-3 * abs(speed) + 1e-6 and abs(x) < reach
    t, row = 0.0, 0
    while row < rows:
        if riding:
            goal = reach if speed > 0.0 else -reach
            left = max((goal - x) / speed, 0.0) if speed != 0.0 else np.inf
            while row < rows and (row + 1) * step <= t + left:
                out[row] = x + speed * ((row + 1) * step - t)
                row += 1
            t, x, v, riding = t + left, goal, speed, False
            sign = 1.0 if speed > 0.0 else -1.0
        else:
            sign = 1.0 if speed > v else -1.0
        middle = sign * mu_k * n / stiffness
        left = glide_time(x, v, middle, omega, speed, sign)
        a, b = x - middle, v / omega
        while row < rows and (row + 1) * step <= t + left:
            angle = omega * ((row + 1) * step - t)
            out[row] = middle + a * cos(angle) + b * sin(angle)
            row += 1
        if row < rows:
            angle = omega * left
            x = middle + a * cos(angle) + b * sin(angle)
            v, t = speed, t + left
            riding = abs(x) < reach
    return out


@njit(cache=True)
def replay(edges, x, v, seen, model, offset, thin, dense):
    """Squares of seen less plain x, summed, and their number; afresh at every edge.

    x, v, seen have rows every `dense` seconds, of which every `thin`-th is compared; model is
    (mass, stiffness, speed, mu_s, mu_k).
    """
    mass, stiffness, speed, mu_s, mu_k = model
    total, count = 0.0, 0
    for i_edge in range(len(edges) - 1):
        begin, end = edges[i_edge], edges[i_edge + 1]
        rows = (end - 1 - begin) // thin
        plain = plain_motion(
            x[begin] - offset, v[begin], mass, stiffness, speed, mu_s, mu_k, thin * dense, rows
        )
        for i in range(rows):
            total += (seen[begin + thin * (i + 1)] - plain[i] - offset) ** 2
        count += rows
    return total, count
