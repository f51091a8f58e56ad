"""Features of runs whose motion is known in closed form."""

import math

import numpy as np
import pytest
from stickslip import Friction, Initial, Parameters, Rig, Springs, Surface, simulate
from stickslip.packing import GRAVITY
from stickslip.trajectory import break_away_frequency, counted_break_aways

from cosim.report import trajectory_columns
from cosim.report.run_summary import after_ramp
from cosim.studies.sweep import FEATURES, features

MASS, STIFFNESS, SPEED = 0.67, 20.17, 0.15
MU_S, MU_K = 0.2815, 0.2086
RATE = math.sqrt(4.0 * STIFFNESS / MASS)
# elongation lost in a jump from mu_s to mu_k, and the closed form of the slip phase
JUMP = (MU_S - MU_K) * GRAVITY / RATE**2
SLIP = 2.0 / RATE * (math.pi - math.atan(JUMP * RATE / SPEED))
STICK = 2.0 * JUMP / SPEED
MIDDLE = MU_K * GRAVITY / RATE**2
SWING = math.hypot(JUMP, SPEED / RATE)


def numbers_of(run):
    return features(trajectory_columns(run, run.parameters, ""))


@pytest.fixture(scope="module")
def coulomb():
    """The Coulomb oscillator, begun where it re-sticks: in its cycle from the start."""
    straight = Rig(mass=MASS, degrees_of_freedom=("x",), spring_length=0.2)
    case = Parameters(
        rig=straight, springs=Springs(stiffness=STIFFNESS), friction=Friction(mu_s=MU_S, mu_k=MU_K),
        surface=Surface(speed=SPEED), initial=Initial(x=MIDDLE - JUMP, vx=SPEED),
    )  # fmt: skip
    return numbers_of(simulate(case, 60.0, 0.01))


def test_every_feature_is_there_with_unit_and_words(coulomb):
    assert list(coulomb) == list(FEATURES)
    assert all(math.isfinite(value) for value in coulomb.values())
    assert all(one.unit and one.long_name for one in FEATURES.values())


@pytest.mark.parametrize("name, value, error", [
    # located events and cubics through positions and velocities: far below a row's distance
    ("slip_time", SLIP, 1e-9),
    ("x_max", MIDDLE + SWING, 1e-7),
    ("x_min", MIDDLE - SWING, 1e-7),
    # by the mean period: located events, whatever the window cuts off
    ("frequency", 1.0 / (SLIP + STICK), 1e-9),
    ("slip_share", SLIP / (SLIP + STICK), 0.5 / 60.0),
    ("x_mean", MIDDLE, 2e-4),
    # the force jumps at re-stick: a row's mean is first order
    ("kinetic_coefficient", MU_K, 1e-12),
    ("friction_coefficient", MU_K, 2e-3),
    ("phi_max", 0.0, 0.0),
    ("y_mean", 0.0, 0.0),
    ("energy_residual", 0.0, 1e-9),
])  # fmt: skip
def test_coulomb_oscillator(coulomb, name, value, error):
    assert coulomb[name] == pytest.approx(value, abs=error, rel=0.0)


def test_heat_is_force_times_way(coulomb):
    heat = MU_K * MASS * GRAVITY * coulomb["sliding_distance"]
    assert coulomb["heat"] == pytest.approx(heat, rel=1e-9)


def test_a_run_without_constant_speed_has_totals_only():
    run = simulate(Parameters(surface=Surface(run_up_time=10.0)), 5.0, 0.1)
    numbers = numbers_of(run)
    assert math.isnan(numbers["x_mean"]) and math.isnan(numbers["frequency"])
    assert numbers["heat"] >= 0.0


def test_a_block_that_rests_has_no_slip_time():
    held = Parameters(surface=Surface(speed=0.001), initial=Initial(vx=0.001))
    numbers = numbers_of(simulate(held, 2.0, 0.1))
    assert numbers["frequency"] == numbers["slip_share"] == 0.0
    assert math.isnan(numbers["slip_time"]) and math.isnan(numbers["kinetic_coefficient"])


def test_the_frequency_is_that_of_a_summary():
    """One definition, from whatever it is read: events, counts in rows, a summary."""
    case = Parameters(surface=Surface(speed=SPEED), initial=Initial(vx=SPEED))
    run = simulate(case, 7.3, 0.01)
    found = numbers_of(run)["frequency"]
    starts = run.slip_starts
    assert found == break_away_frequency(starts) == pytest.approx(1.0 / np.diff(starts).mean())
    assert after_ramp(trajectory_columns(run, case, "").to_xarray())["frequency"] == found
    counted = counted_break_aways(run.time, run["slip_count"])
    assert counted == pytest.approx(starts, abs=0.005001)  # half a row either way
    assert break_away_frequency(starts[:0]) == 0.0 and math.isnan(break_away_frequency(starts[:1]))
