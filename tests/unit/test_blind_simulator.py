"""The simulator of the hidden campaigns: closed forms, energy; and whom it knows."""

import ast
from math import atan, cos, hypot, pi, sin, sqrt
from pathlib import Path

import numpy as np
import pytest
from blind.motion import FINE, walk
from blind.simulator.coulomb import plain_motion
from blind.simulator.hidden import Hidden, State
from blind.simulator.plane import ANGLES, anchors, spring_load

pytestmark = pytest.mark.slow  # numba compiles the simulator, and no answer hangs on it
TESTS = Path(__file__).resolve().parents[1]

PRODUCT = {"stickslip", "thermal", "cosim"}
NOISE = 1e-4  # m, of the best tracker that a campaign draws
G = 9.81


def coulomb_cycle(p):
    """Period of the plain model's stick-slip in s, and its largest displacement in m."""
    k, n = 4 * p.stiffness, p.mass * G
    a, omega = (p.mu_s - p.mu_k) * n / k, sqrt(k / p.mass)
    period = 2 / omega * (pi - atan(a * omega / p.speed)) + 2 * a / p.speed
    return period, p.mu_k * n / k + hypot(a, p.speed / omega)


def mean_period(x, step):
    """Mean time between upward passages of the mean, s."""
    z = x - x.mean()
    up = np.flatnonzero((z[:-1] < 0) & (z[1:] >= 0))
    return np.diff(up - z[up] / (z[up + 1] - z[up])).mean() * step


def test_no_file_imports_the_product():
    imported = set()
    for file in (TESTS / "blind").rglob("*.py"):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                imported |= {alias.name.split(".")[0] for alias in node.names}
            elif isinstance(node, ast.ImportFrom) and not node.level:
                imported.add(node.module.split(".")[0])
    assert "numpy" in imported
    assert not imported & PRODUCT


def test_springs_against_the_vectors_of_the_paper():
    p = Hidden()
    x, y, phi = 0.012, -0.007, 0.2
    total = np.zeros(3)
    for angle in ANGLES:
        rest = p.attachment * np.array([cos(angle), sin(angle)])
        anchor = rest + [np.sign(rest[0]) * p.length, 0.0]
        arm = p.attachment * np.array([cos(angle + phi), sin(angle + phi)])
        spring = anchor - arm - [x, y]
        force = p.stiffness * (1 - p.natural / np.linalg.norm(spring)) * spring
        total += [*force, arm[0] * force[1] - arm[1] * force[0]]
    load = spring_load(p, anchors(p), x, y, cos(phi), sin(phi))
    assert load == pytest.approx(tuple(total), rel=1e-12)


def test_closed_form_of_the_plain_model():
    # m = k = 1, v = 0.2, F_s = 1, F_k = 0.5: period known to sixteen digits
    x = plain_motion(0.5, 0.2, 1.0, 1.0, 0.2, 1 / G, 0.5 / G, 1e-3, 90000)
    assert mean_period(x, 1e-3) == pytest.approx(8.902605407814523, abs=1e-7)
    assert x.max() == pytest.approx(0.5 + hypot(0.5, 0.2), abs=1e-7)


@pytest.mark.parametrize("speed", [0.008, 0.06, 0.12])
def test_smoothed_friction_keeps_the_coulomb_cycle(speed):
    p = Hidden(speed=speed)
    x = walk(p, State(vx=speed), False, FINE[False], 20000)[4000:, 0]
    period, largest = coulomb_cycle(p)
    # what the smoothing does to one cycle is less than the best tracker's noise
    assert abs(mean_period(x, 1e-3) - period) * speed < NOISE
    assert abs(x.max() - largest) < NOISE


def test_energy_of_free_motion_in_the_plane():
    p = Hidden(mu_s=0.0, mu_k=0.0)
    rows = walk(p, State(x=0.01, y=0.005, phi=0.1, vx=0.05), True, FINE[True], 5000)

    def energy(row):
        x, y, phi, vx, vy, omega = row[:6]
        total = 0.5 * p.mass * (vx**2 + vy**2) + 0.5 * p.inertia * omega**2
        for a, b, ax, ay in anchors(p):
            reach_x = ax - x - a * cos(phi) + b * sin(phi)
            reach_y = ay - y - a * sin(phi) - b * cos(phi)
            total += 0.5 * p.stiffness * (hypot(reach_x, reach_y) - p.natural) ** 2
        return total

    energies = np.array([energy(row) for row in rows[::50]])
    swing = 0.5 * p.mass * (rows[:, 3] ** 2).max()
    assert np.ptp(energies) < 1e-5 * swing
