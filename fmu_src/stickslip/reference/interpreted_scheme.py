"""The study's scheme without a compiler: strips in Python, `scipy.signal.lsim` per block.

What the scheme costs when it is written as a script: the measure for run times. `updated` solves
anew every 10 ms with a hundred samples of friction; a treatment with constant springs needs one
solution a slip, over the 2 s and at the 100 samples a second of the study. The motion is that of
`linearised` with faults F6 and F15 and the constant mu_k.
"""

import math

import numpy as np
from numpy.random import Generator
from scipy import signal

from .linearised import GRAVITY, Scheme
from .scheme import INTERVAL, STEPS
from .study_rig import ATTACHMENT_ANGLES, ATTACHMENT_RADIUS, STRIPS, fixed_angles, stiffness_matrix

WHOLE_SLIP, WHOLE_SLIP_SAMPLES = 2.0, 200


def load_strip_by_strip(
    samples: int, kinetic_force: float, scatter: float, rng: Generator
) -> np.ndarray:
    """Force and moment (samples, 2), one strip after the other."""
    load = np.zeros((samples, 2))
    width = 2.0 * ATTACHMENT_RADIUS / STRIPS
    disc = math.pi * ATTACHMENT_RADIUS**2
    for sample in range(samples):
        for j in range(STRIPS):
            low = -ATTACHMENT_RADIUS + j * width
            high = low + width
            chords = [2.0 * math.sqrt(max(ATTACHMENT_RADIUS**2 - y**2, 0.0)) for y in (low, high)]
            area = 0.5 * (chords[0] + chords[1]) * width
            pressure = (kinetic_force + scatter * rng.standard_normal()) / disc
            load[sample, 0] += pressure * area
            load[sample, 1] -= pressure * area * 0.5 * (low + high)
    return load


def linear_system(mass: float, stiffness: float, alpha: np.ndarray) -> signal.StateSpace:
    """State x, y, phi, x', y', phi'; inputs force and moment; outputs the state."""
    inertia = mass * ATTACHMENT_RADIUS**2
    rate = -stiffness * stiffness_matrix(alpha) / np.array([[mass], [mass], [inertia]])
    a = np.block([[np.zeros((3, 3)), np.eye(3)], [rate, np.zeros((3, 3))]])
    b = np.zeros((6, 2))
    b[3, 0], b[5, 1] = 1.0 / mass, 1.0 / inertia
    return signal.StateSpace(a, b, np.eye(6), np.zeros((6, 2)))


def interpreted_run(duration: float, scheme: Scheme) -> np.ndarray:
    """Time, x, y, phi at every block or sample, (n, 4); starts at rest on the surface."""
    rng = np.random.default_rng(0)
    weight = scheme.mass * GRAVITY
    friction = scheme.mu_k * weight, scheme.scatter * weight
    limit, speed = scheme.mu_s * weight / (4 * scheme.stiffness), scheme.speed
    updated = scheme.treatment == "updated"
    length, samples = (INTERVAL, STEPS + 1) if updated else (WHOLE_SLIP, WHOLE_SLIP_SAMPLES)
    state, time, rows, sticking = np.zeros(6), 0.0, [], True
    while time < duration:
        if sticking:
            state[0] += speed * INTERVAL
            state[3:] = speed, 0.0, 0.0
            time += INTERVAL
            rows.append([time, *state[:3]])
            sticking = state[0] + speed * INTERVAL < limit
            continue
        alpha = _alpha(state[2], scheme) if updated else fixed_angles(scheme.treatment)
        times = np.linspace(0.0, length, samples)
        forces = load_strip_by_strip(samples, *friction, rng)
        system = linear_system(scheme.mass, scheme.stiffness, alpha)
        states = signal.lsim(system, forces, times, state)[2]
        last = samples - 1 if updated else _first_at(states[:, 3], speed)
        rows += (
            [[time + times[last], *states[last, :3]]]
            if updated
            else [[time + times[i], *states[i, :3]] for i in range(1, last + 1)]
        )
        state, time = states[last].copy(), time + times[last]
        sticking = state[3] >= speed
    return np.array(rows)


def _alpha(phi: float, scheme: Scheme) -> np.ndarray:
    rise = np.sin(ATTACHMENT_ANGLES + phi) - np.sin(ATTACHMENT_ANGLES)
    return np.arctan2(ATTACHMENT_RADIUS * rise, scheme.spring_length)


def _first_at(speeds: np.ndarray, speed: float) -> int:
    """First sample after the start that reaches ``speed``, else the last."""
    reached = np.flatnonzero(speeds[1:] >= speed)
    return int(reached[0]) + 1 if len(reached) else len(speeds) - 1
