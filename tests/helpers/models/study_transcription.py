"""The source study's scheme once more, flat, from its equations and its listing.

Nothing is shared with `stickslip.reference`: springs are summed as the listing sums them, a block
of slip is one matrix exponential of the motion under a load that is held, and friction is a sum
over a hundred strips. What the print leaves open is an argument.
"""

import math

import numpy as np
from scipy.linalg import expm

R, LENGTH, STRIPS, BLOCK, BLOCKS = 0.05, 0.2, 100, 0.01, 100
BETA = np.radians([160.0, 20.0, 200.0, 340.0])
A, B = R * np.cos(BETA), R * np.sin(BETA)


def strips() -> tuple[np.ndarray, np.ndarray]:
    """Area (m2) and lever arm y (m) of each strip: fifty on either side, as the listing goes."""
    width = R / (STRIPS // 2)
    inner = width * np.arange(STRIPS // 2)
    outer = inner + width
    chord, next_chord = (np.sqrt(np.maximum(R**2 - y**2, 0.0)) for y in (inner, outer))
    area = width * (2.0 * next_chord + (chord - next_chord))
    arm = inner + 0.5 * width
    return np.concatenate([area, area]), np.concatenate([arm, -arm])


def stiffness(alpha: np.ndarray) -> np.ndarray:
    """K/k (3, 3), entry by entry as the potential energy's derivatives give them."""
    c, s = np.cos(alpha), np.sin(alpha)
    xx, xy, yy = (c * c).sum(), (c * s).sum(), (s * s).sum()
    xp, yp = (A * c * s - B * c * c).sum(), (A * s * s - B * c * s).sum()
    pp = (A * A * s * s - 2.0 * A * B * c * s + B * B * c * c).sum()
    return np.array([[xx, xy, xp], [xy, yy, yp], [xp, yp, pp]])


def transcribed(
    *,
    mass=0.67,
    k=20.17,
    speed=0.15,
    mu_s=0.2815,
    mu_k=0.2086,
    cycles=25,
    alpha0=(0.0,) * 4,
    updated=True,
    slope=0.0,
    slope_at=0.15,
    curvature=0.0,
    stick_springs=1,
    reach=1.0,
) -> tuple[np.ndarray, np.ndarray]:
    """Rows (n, 8): t, q, q', mode at every stick sample and block end; phases: begin, end, mode.

    slope: loss of mu_k per m/s of a strip's sliding speed above ``slope_at``, on a slab of
    ``curvature`` 1/R, held for a block. stick_springs: 1 as the listing has it, 4 as eq. 4.21.
    reach: the factor of the rise behind the spring angles, 1 as the listing has it, r if it is r.
    """  # fmt: skip
    area, arm = strips()
    pressure = mass * 9.81 / (math.pi * R**2)
    limit = mu_s * mass * 9.81
    inverse = 1.0 / np.array([mass, mass, mass * R**2])
    q, v, t = np.zeros(3), np.array([speed, 0.0, 0.0]), 0.0
    carried = v  # the listing never hands the belt's velocity over to slip
    alpha = np.array(alpha0)
    rows, phases = [], []

    for _ in range(cycles):
        begin = t
        grid = np.linspace(t, t + 20.0, 2000)
        place = speed * (grid - t) + q[0]
        stays = np.flatnonzero(stick_springs * k * place >= limit)[0]
        for one in range(stays):
            rows.append([grid[one], place[one], q[1], q[2], speed, 0.0, 0.0, 0])
        if stays:
            t, q = grid[stays - 1], np.array([place[stays - 1], q[1], q[2]])
        phases.append([begin, t, 0])
        begin, v = t, carried
        for _ in range(BLOCKS):
            # state, its rate, and the load, which is held over a block
            system = np.zeros((9, 9))
            system[:3, 3:6] = np.eye(3)
            system[3:6, :3] = -k * inverse[:, None] * stiffness(alpha)
            system[3:6, 6:9] = np.diag(inverse)
            advance = expm(system * BLOCK)
            sliding = np.abs(speed * (1.0 - curvature * arm) - v[0] + arm * v[2])
            mu = np.maximum(mu_k - slope * (sliding - slope_at), 0.0) if slope else mu_k
            force = pressure * mu * area
            load = np.array([force.sum(), 0.0, -(force * arm).sum()])
            state = advance[:6] @ np.concatenate([q, v, load])
            q, v, t = state[:3], state[3:], t + BLOCK
            rows.append([t, *q, *v, 1])
            if v[0] >= speed:
                break
            carried = v
            if updated:
                alpha = np.arctan2(reach * (np.sin(BETA + q[2]) - np.sin(BETA)), LENGTH)
        phases.append([begin, t, 1])
    return np.array(rows), np.array(phases)
