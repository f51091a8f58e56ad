"""Dieterich's ageing law: steady friction, the critical stiffness, healing at rest.

Steady sliding at v has theta = D/v and mu = mu_k + (a - b) ln(v/v*). Under a spring of stiffness K
it is stable for K above N (b - a)/D and stick-slips below (Ruina, J. Geophys. Res. 88, 1983;
quasi-static). At rest the age grows and with it what the contact holds, b ln(10) a decade.
"""

import numpy as np
import pytest
from stickslip import Parameters, simulate

NORMAL, MU_K, DISTANCE = 0.67 * 9.81, 0.2086, 1e-5


def slow_belt(speed: float, stiffness: float, a: float, b: float, **law) -> Parameters:
    return Parameters(
        surface=dict(speed=speed),
        springs=dict(stiffness=stiffness / 4.0),
        rate_and_state=dict(direct=a, evolution=b, distance=DISTANCE, **law),
        initial=dict(vx=speed),
    )


@pytest.mark.parametrize("speed", [3e-5, 1e-4, 1e-3])
def test_steady_friction(speed):
    # what rounds the law off at the creep speed adds a/2 (v_c/v)^2 = 1.1e-7 at the slowest
    belt = slow_belt(speed, 20e3, 0.02, 0.01, creep_speed=1e-7)
    run = simulate(belt, 3e-3 / speed, 1e-4 / speed)
    mu = run["friction_force_x"][-1] / NORMAL
    assert mu == pytest.approx(MU_K + (0.02 - 0.01) * np.log(speed / 1e-4), abs=1e-6)


@pytest.mark.parametrize("factor, sticks", [(0.5, True), (2.0, False)])
def test_critical_stiffness(factor, sticks):
    critical = NORMAL * (0.02 - 0.01) / DISTANCE
    run = simulate(slow_belt(1e-4, factor * critical, 0.01, 0.02), 20.0)
    late = run["mode"][run.time > 10.0]
    assert np.any(late == 0) == sticks


def test_healing_at_rest():
    """First break-away: K v t = N mu(creep speed, age), the age grown by t."""
    run = simulate(slow_belt(1e-4, 2000.0, 0.01, 0.02, initial_age=5.0), 30.0)
    t = run.slip_starts[0]
    held = MU_K + 0.01 * np.log(1e-6 / 1e-4) + 0.02 * np.log(1e-4 * (5.0 + t) / DISTANCE)
    assert 2000.0 * 1e-4 * t / NORMAL == pytest.approx(held, rel=1e-9)
