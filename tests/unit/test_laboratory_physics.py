"""The foreign laboratory against closed forms: motion, contacts, disc, memories, integrators."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[1]))
from blind.laboratory.apparatus import CONTACTS, GRAVITY, apparatus, spread_contact  # noqa: E402
from blind.laboratory.friction_law import (  # noqa: E402
    AGE,
    SLOW,
    age_contact,
    coefficient,
    half_space,
)
from blind.laboratory.simulation import (  # noqa: E402
    COLUMNS,
    FRICTION,
    SLIP,
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


def test_decay_by_linear_damping():
    p = apparatus(0.67, 20.17, 0.0, 0.0, 0.0, contact="jump", **LINEAR)
    p["damping"], p["damping_power"], p["damping_speed"] = 0.2, 1.0, 1.0
    peaks = np.abs(turning_points(simulate(p, placed(0.02), 10.0)[:, 0]))
    rate = 0.2 / (2 * 0.67)
    omega = np.sqrt(4 * 20.17 / 0.67 - rate**2)
    assert peaks[1:] / peaks[:-1] == pytest.approx(np.exp(-rate * np.pi / omega), rel=2e-3)


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


@pytest.mark.parametrize("contact", ["lugre", "elasto_plastic"])
def test_presliding_stiffness(contact):
    """Far below break-away the contact is a spring of mu_s N / presliding."""
    p = apparatus(0.5, 5.0, 0.0, 0.3, 0.2, contact=contact, **LINEAR)
    p["presliding"], p["bristle_damping"] = 5e-5, 0.0
    rows = simulate(p, placed(vx=1e-5), 0.5, sample=STEP)
    stiffness = 0.3 * 0.5 * GRAVITY / 5e-5 + 20.0
    crossings = np.flatnonzero(np.diff(np.sign(rows[:, 0])))
    half = np.polyfit(np.arange(crossings.size), crossings * STEP, 1)[0]
    assert half == pytest.approx(np.pi / np.sqrt(stiffness / 0.5), rel=5e-3)


def test_static_friction_holds_up_to_break_away_and_jumps():
    p = apparatus(0.67, 20.17, 0.01, 0.3, 0.2, contact="jump", **LINEAR)
    rows = simulate(p, at_rest_on_belt(p, 0.0), 4.0)
    held = rows[:, SLIP] < 1e-6
    first = np.argmin(held[1:]) + 1
    assert rows[first, 0] == pytest.approx(0.3 * 0.67 * GRAVITY / (4 * 20.17), rel=2e-3)
    sliding = np.flatnonzero(~held)
    assert rows[sliding[2], FRICTION] == pytest.approx(0.2 * 0.67 * GRAVITY, rel=1e-6)


# observed order of each integrator, and the largest error at the step in use, m
ORDERS = {"lugre": 0.8, "elasto_plastic": 1.7, "smooth": 3.5, "jump": 0.6}
ERRORS = {"lugre": 2e-5, "elasto_plastic": 1e-6, "smooth": 1e-7, "jump": 6e-5}


@pytest.mark.parametrize("contact", CONTACTS)
def test_convergence_in_the_step(contact):
    p = apparatus(0.67, 20.17, 0.1, 0.26, 0.2, contact=contact, **LINEAR)
    start = at_rest_on_belt(p, 0.005)
    steps = np.array([2e-4, 1e-4, 5e-5, 6.25e-6])
    paths = [simulate(p, start, 2.0, step=h)[:, 0] for h in steps]
    errors = np.array([np.sqrt(np.mean((x - paths[-1]) ** 2)) for x in paths[:-1]])
    order = np.polyfit(np.log(steps[:-1]), np.log(errors + 1e-16), 1)[0]
    assert order > ORDERS[contact]
    assert errors[1] < ERRORS[contact]


@pytest.mark.parametrize("contact", CONTACTS)
def test_disc_spinning_on_the_spot(contact):
    """Moment 2/3 mu N a of a uniform disc (two rings are 1.1 % off)."""
    a, mu = 0.04, 0.2
    p = apparatus(0.5, 1e-6, 0.0, mu, mu, contact=contact, guided=False, planar=True)
    rows = simulate(p, placed(omega=30.0), 0.3)
    expected = 2 / 3 * mu * 0.5 * GRAVITY * a / (0.5 * 0.5 * a**2)
    spin = rows[50:200, 5]
    assert -np.polyfit(np.arange(150) * 1e-3, spin, 1)[0] == pytest.approx(expected, rel=0.015)


@pytest.mark.parametrize("pressure,radius2", [("uniform", 0.5), ("domed", 1 / 3)])
def test_disc_spinning_slowly_while_it_slides(pressure, radius2):
    """Moment mu N <x^2> omega / v where the spin is slow, with <x^2> half the mean of r^2."""
    a, mu, v = 0.04, 0.2, 2.0
    p = apparatus(0.5, 1e-6, 0.0, mu, mu, contact="smooth", guided=False, planar=True)
    spread_contact(p, a, pressure)
    rows = simulate(p, placed(vx=v, omega=1.0), 0.02)
    expected = mu * 0.5 * GRAVITY * 0.5 * radius2 * a**2 / v / (0.5 * 0.5 * a**2)
    assert -np.log(rows[-1, 5] / rows[0, 5]) / 0.02 == pytest.approx(expected, rel=0.02)
    assert (rows[0, 3] - rows[-1, 3]) / 0.02 == pytest.approx(mu * GRAVITY, rel=1e-3)


def test_disc_on_a_symmetric_rig_moves_along_x_alone():
    p = apparatus(0.67, 20.17, 0.1, 0.3, 0.2, guided=False, planar=True)
    rows = simulate(p, at_rest_on_belt(p, 0.0), 3.0)
    line = apparatus(0.67, 20.17, 0.1, 0.3, 0.2, guided=True)
    assert np.abs(rows[:, [1, 2]]).max() < 1e-9
    assert rows[:, 0] == pytest.approx(simulate(line, placed(vx=0.1), 3.0)[:, 0], abs=1e-6)


def test_a_motion_goes_on_from_any_of_its_rows():
    p = apparatus(0.67, 20.17, 0.1, 0.3, 0.2)
    whole = simulate(p, at_rest_on_belt(p, 0.0), 2.0)
    rest = simulate(p, whole[700], 1.3, begin=0.7)
    assert np.array_equal(rest[:, 0], whole[700:, 0])


def test_heat_memory_is_a_half_space():
    weights, rates = half_space()
    t = np.geomspace(0.01, 10.0, 30)
    kernel = (weights * np.exp(-np.outer(t, rates))).sum(axis=1)
    assert kernel == pytest.approx(1 / np.sqrt(np.pi * t), rel=0.02)


def test_age_grows_in_stick_and_is_lost_in_slip():
    p = apparatus(0.67, 20.17, 0.1, 0.3, 0.2)
    slow = np.zeros(SLOW)
    for _ in range(1000):
        age_contact(p.reshape(1)[0], slow, 0.0, 0.0, 1e-3)
    assert slow[AGE] == pytest.approx(1.0)
    for _ in range(100):
        age_contact(p.reshape(1)[0], slow, 0.1, 0.0, 1e-3)
    assert slow[AGE] < 0.01
