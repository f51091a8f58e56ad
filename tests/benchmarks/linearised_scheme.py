"""The source study's scheme with updated spring angles, written anew from its equations.

The peer of the mechanics benchmark: slip in blocks of 10 ms. In each block the spring angles
alpha_i are taken from the motion, the stiffness matrix K = k sum g_i g_i^T is formed with
g = (C, D, D A - C B), and the linear system M q'' + K q = (F, 0, M_F) is sampled a hundred times by
`scipy.signal.lsim` under friction summed over a hundred strips of the contact, with normal scatter.
Stick moves with the belt until the springs reach mu_s N (here with all four springs). The strips
are summed by numpy; the study loops over them in Python.
"""

import numpy as np
from scipy import signal

GRAVITY = 9.81
ATTACHMENT, LENGTH = 0.05, 0.20
ANGLES = np.radians([160.0, 20.0, 200.0, 340.0])
BLOCK, SAMPLES, STRIPS = 0.01, 100, 100


def stiffness_matrix(k: float, alpha: np.ndarray) -> np.ndarray:
    """K = k sum g_i g_i^T, shape (3, 3), for spring angles ``alpha`` (4,)."""
    a, b = ATTACHMENT * np.cos(ANGLES), ATTACHMENT * np.sin(ANGLES)
    c, d = np.cos(alpha), np.sin(alpha)
    g = np.array([c, d, d * a - c * b])
    return k * g @ g.T


def slip_block(state, mass, k, kinetic_force, scatter, rng):
    """States (SAMPLES, 6) over one block; order x, y, phi, x', y', phi'."""
    alpha = np.arctan2(ATTACHMENT * (np.sin(ANGLES + state[2]) - np.sin(ANGLES)), LENGTH)
    inertia = mass * ATTACHMENT**2
    inverse = np.diag([1.0 / mass, 1.0 / mass, 1.0 / inertia])
    a = np.block(
        [[np.zeros((3, 3)), np.eye(3)], [-inverse @ stiffness_matrix(k, alpha), np.zeros((3, 3))]]
    )
    b = np.zeros((6, 2))
    b[3, 0], b[5, 1] = 1.0 / mass, 1.0 / inertia
    edges = np.linspace(-ATTACHMENT, ATTACHMENT, STRIPS + 1)
    middle = 0.5 * (edges[1:] + edges[:-1])
    area = 2.0 * np.sqrt(ATTACHMENT**2 - middle**2) * np.diff(edges)
    pressure = kinetic_force / area.sum() + scatter * rng.standard_normal((SAMPLES, STRIPS))
    strip_forces = pressure * area
    load = np.stack([strip_forces.sum(axis=1), strip_forces @ middle], axis=1)
    times = np.linspace(0.0, BLOCK, SAMPLES)
    system = signal.StateSpace(a, b, np.eye(6), np.zeros((6, 2)))
    _, _, states = signal.lsim(system, load, times, state)
    return states


def linearised_run(
    duration=20.0, mass=0.67, k=20.17, speed=0.15, mu_s=0.2815, mu_k=0.2086, scatter=0.0, seed=0
):
    """Positions (n, 3) at every block of 10 ms."""
    rng = np.random.default_rng(seed)
    state = np.zeros(6)
    positions, sticking = [], True
    for _ in range(round(duration / BLOCK)):
        if sticking:
            state[0] += speed * BLOCK
            state[3:] = speed, 0.0, 0.0
            sticking = 4.0 * k * state[0] < mu_s * mass * GRAVITY
        else:
            state = slip_block(state, mass, k, mu_k * mass * GRAVITY, scatter, rng)[-1].copy()
            sticking = state[3] >= speed
        positions.append(state[:3].copy())
    return np.array(positions)
