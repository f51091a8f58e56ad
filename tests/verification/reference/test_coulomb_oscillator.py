"""Block on a belt with Coulomb friction mu_s > mu_k: the limit cycle in closed form.

With a = (F_s - F_k)/K and omega = sqrt(K/m) a cycle slips for (2/omega)(pi - arctan(a omega/v))
and sticks for 2 a/v; the slip ends at F_k/K - a; the extremes are F_k/K -+ sqrt(a^2 + v^2/omega^2).
"""

import numpy as np
import pytest
from stickslip import Initial, Parameters, simulate
from stickslip.reference.coulomb_oscillator import CoulombOscillator

GRAVITY = 9.81
F_S, F_K, SPEED = 1.0, 0.5, 0.2
SLIP, PERIOD = 3.902605407814523, 8.902605407814523


def unit_oscillator(**changes) -> Parameters:
    """m = K = 1, F_s = 1 N, F_k = 0.5 N, v = 0.2 m/s; the block starts at rest on the belt."""
    blocks = {
        "rig": dict(mass=1.0, spring_length=10.0, spring_natural_length=10.0),
        "springs": dict(stiffness=0.25), "friction": dict(mu_s=F_S / GRAVITY, mu_k=F_K / GRAVITY),
        "surface": dict(speed=SPEED), "initial": Initial(vx=SPEED),
    }  # fmt: skip
    return Parameters(**(blocks | changes))


def test_converges_with_the_internal_tolerance():
    """The error against the closed form falls with solver.tolerance, to rounding."""
    errors = []
    for tolerance in (1e-6, 1e-8, 1e-10, 1e-12):
        run = simulate(unit_oscillator(solver=dict(tolerance=tolerance)), 90.0)
        last = run.slip_starts[-1]
        exact = run.slip_starts[0] + PERIOD * (len(run.slip_starts) - 1)
        errors.append(abs(last - exact))
    # loose tolerances share the bound that keeps events from being stepped over, T/12: 4e-9
    assert errors == sorted(errors, reverse=True)
    assert errors[0] < 1e-8
    assert errors[-1] < 5e-11  # ten periods of 8.9 s


def test_coulomb_closed_form():
    oscillator = CoulombOscillator(1.0, 1.0, 0.2, 1.0, 0.5)
    assert oscillator.slip_time == pytest.approx(SLIP, abs=1e-14)
    assert oscillator.period == pytest.approx(PERIOD, abs=1e-14)
    assert oscillator.centre == oscillator.excess  # slips end where the springs are slack
    assert oscillator.amplitude == pytest.approx(np.sqrt(0.29), abs=1e-15)
