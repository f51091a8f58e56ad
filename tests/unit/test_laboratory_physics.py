"""The foreign laboratory against closed forms: contacts, energy, disc, memory."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[1]))
from blind.laboratory.apparatus import CONTACTS, GRAVITY, apparatus  # noqa: E402
from blind.laboratory.friction_law import (  # noqa: E402
    coefficient,
    half_space,
)
from blind.laboratory.simulation import (  # noqa: E402
    COLUMNS,
    FRICTION,
    STEP,
    at_rest_on_belt,
    simulate,
)

pytestmark = pytest.mark.slow  # numba compiles the simulator, and no answer hangs on it
LINEAR = {"spring_length": 0.2, "natural_length": 0.2}


def placed(x: float = 0.0, y: float = 0.0, vx: float = 0.0, omega: float = 0.0) -> np.ndarray:
    row = np.zeros(COLUMNS)
    row[[0, 1, 3, 5]] = x, y, vx, omega
    return row


def turning_points(x: np.ndarray) -> np.ndarray:
    """Extremes of a swing, the start left out."""
    return x[1:-1][np.diff(np.sign(np.diff(x))) != 0]


@pytest.mark.parametrize("contact", CONTACTS)
def test_swing_on_a_belt_at_rest_loses_four_deflections_a_period(contact):
    """Amplitude falls by 2 F/K each half period (Lorenz 1924)."""
    mu = 0.02
    p = apparatus(0.67, 20.17, 0.0, mu, mu, contact=contact, **LINEAR)
    p["presliding"], p["creep_speed"] = 5e-6, 3e-5
    rows = simulate(p, placed(0.03), 3.0, step=2e-5)
    peaks = np.abs(turning_points(rows[:, 0]))[:5]
    expected = 2 * mu * 0.67 * GRAVITY / (4 * 20.17)
    assert -np.diff(peaks) == pytest.approx(expected, rel=0.01)


@pytest.mark.parametrize("contact", CONTACTS)
def test_energy_balance(contact):
    """Work of friction is the change of kinetic and spring energy."""
    p = apparatus(0.67, 20.17, 0.1, 0.26, 0.2, contact=contact, **LINEAR)
    rows = simulate(p, at_rest_on_belt(p, 0.005), 3.0, sample=STEP)
    v = rows[:, 3]
    work = np.cumsum(rows[1:, FRICTION] * 0.5 * (v[1:] + v[:-1])) * STEP
    energy = 0.5 * 0.67 * v**2 + 0.5 * 4 * 20.17 * rows[:, 0] ** 2
    assert energy[1:] - energy[0] == pytest.approx(work, abs=2e-3 * energy.max())


@pytest.mark.parametrize("contact", ["lugre", "elasto_plastic", "smooth"])
@pytest.mark.parametrize("speed", [2e-3, 1e-2, 0.2])
def test_steady_sliding_follows_the_stribeck_curve(contact, speed):
    p = apparatus(1.0, 1e4, speed, 0.3, 0.2, contact=contact, **LINEAR)
    p["damping"], p["damping_power"], p["damping_speed"] = 300.0, 1.0, 1.0
    p["creep_speed"] = 2e-4
    end = simulate(p, placed(), 1.0)[-1]
    law = (0.2 + 0.1 * np.exp(-speed / 4e-3)) * GRAVITY
    assert end[FRICTION] == pytest.approx(law, rel=1e-3)
    assert coefficient(p.reshape(1)[0], 0.2, 0.1, speed) * GRAVITY == pytest.approx(law)


@pytest.mark.parametrize("contact", CONTACTS)
def test_disc_spinning_on_the_spot(contact):
    """Moment 2/3 mu N a of a uniform disc (two rings are 1.1 % off)."""
    a, mu = 0.04, 0.2
    p = apparatus(0.5, 1e-6, 0.0, mu, mu, contact=contact, guided=False, planar=True)
    rows = simulate(p, placed(omega=30.0), 0.3)
    expected = 2 / 3 * mu * 0.5 * GRAVITY * a / (0.5 * 0.5 * a**2)
    spin = rows[50:200, 5]
    assert -np.polyfit(np.arange(150) * 1e-3, spin, 1)[0] == pytest.approx(expected, rel=0.015)


def test_heat_memory_is_a_half_space():
    weights, rates = half_space()
    t = np.geomspace(0.01, 10.0, 30)
    kernel = (weights * np.exp(-np.outer(t, rates))).sum(axis=1)
    assert kernel == pytest.approx(1 / np.sqrt(np.pi * t), rel=0.02)
