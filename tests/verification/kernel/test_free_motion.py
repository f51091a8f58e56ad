"""Limits of the rig in which the motion is known in closed form."""

import numpy as np
import pytest
from stickslip import Parameters, simulate

GRAVITY = 9.81
FRICTIONLESS = dict(mu_s=0.0, mu_k=0.0)


@pytest.mark.parametrize("ratio", [0.0, 1.0])
@pytest.mark.parametrize("speed", [0.0, 0.15])
def test_free_vibration(ratio, speed):
    """x = x0 cos(omega t), omega = sqrt(4 k / m): along x the exact geometry is linear too."""
    run = simulate(
        Parameters(friction=FRICTIONLESS, lateral_friction=dict(ratio=ratio),
                   surface=dict(speed=speed), initial=dict(x=0.03)),
        20.0,
    )  # fmt: skip
    assert run.complete
    omega = np.sqrt(4.0 * 20.17 / 0.67)
    assert np.max(np.abs(run["x"] - 0.03 * np.cos(omega * run.time))) < 1e-9 * 0.03
    assert np.all(run["mode"] == 1)  # a block without friction slides


def test_block_at_rest_on_a_standing_belt_stays():
    run = simulate(Parameters(surface=dict(speed=0.0), initial=dict(x=0.01)), 5.0)
    assert np.all(run["x"] == 0.01)
    assert np.all(run["mode"] == 0)
    assert run["heat"][-1] == 0.0


def test_everything_zero():
    """No speed, no springs, no friction: nothing moves and nothing fails."""
    run = simulate(
        Parameters(surface=dict(speed=0.0), springs=dict(stiffness=0.0), friction=FRICTIONLESS), 5.0
    )
    assert run.complete
    assert all(np.all(run[name] == 0.0) for name in ("x", "y", "phi", "heat", "energy_residual"))


def test_block_decays_to_rest_in_the_dead_zone():
    """On a standing belt each half swing loses 2 F_k / K; the block stops where F_s holds it."""
    run = simulate(Parameters(surface=dict(speed=0.0), initial=dict(x=0.1)), 10.0)
    normal, stiffness = 0.67 * GRAVITY, 4.0 * 20.17
    x, swings = 0.1, 0
    while abs(x) * stiffness > 0.2815 * normal:
        x = -np.sign(x) * (abs(x) - 2.0 * 0.2086 * normal / stiffness)
        swings += 1
    assert run["x"][-1] == pytest.approx(x, abs=1e-11)
    assert run.events[-1, 0] == pytest.approx(swings * np.pi * np.sqrt(0.67 / stiffness), abs=1e-10)
    assert run["heat"][-1] == pytest.approx(0.5 * stiffness * (0.1**2 - x**2), rel=1e-10)


def test_coulomb_spinning_disc_stops():
    """A disc that only spins slows down at mu N (2/3) a / J and stops after omega0 / that."""
    rig = dict(spring_natural_length=0.2)
    run = simulate(
        Parameters(rig=rig, springs=dict(stiffness=0.0), surface=dict(speed=0.0),
                   lateral_friction=dict(ratio=1.0), initial=dict(omega=10.0)),
        3.0,
    )  # fmt: skip
    inertia = 0.5 * 0.67 * 0.04**2
    slowing = 0.2086 * 0.67 * GRAVITY * (2.0 / 3.0) * 0.04 / inertia
    assert run.events[-1, 0] == pytest.approx(10.0 / slowing, rel=1e-12)
    assert run["phi"][-1] == pytest.approx(0.5 * 10.0**2 / slowing, rel=1e-11)


def test_a_run_that_cannot_go_on_says_why():
    """Soft springs and much friction: the block is carried into an anchor; what it had is kept."""
    run = simulate(Parameters(springs=dict(stiffness=5.0), friction=dict(mu_s=1.5, mu_k=1.0)), 10.0)
    assert "anchor of a spring" in run.reason
    assert 0.0 < run.time[-1] < 10.0 and len(run["x"]) == len(run.time)
