"""Runs set to states: the model's own motion goes on, a contact creeps as it is loaded."""

import numpy as np
import pytest
from stickslip import Parameters, simulate
from stickslip.kernel.layout import O_FRICTION_X, O_MODE, O_X, P_MU_S, P_NORMAL_FORCE
from stickslip.restarted import Restart, simulate_restarted

SPEED, COLD = 0.05, -8.0
O_VX = O_X + 3


@pytest.fixture(scope="module")
def parameters():
    return Parameters()


@pytest.fixture(scope="module")
def p(parameters):
    return parameters.pack()


def state(*values):
    return np.array([*values, *[0.0] * (6 - len(values))])


def test_one_restart_is_the_plain_simulation(parameters, p):
    times = np.linspace(0.0, 5.0, 501)
    outputs = simulate_restarted(p, SPEED, COLD, times, [Restart(0, state())])
    surface = parameters.surface.model_copy(update={"speed": SPEED})
    moving = parameters.model_copy(update={"surface": surface})
    plain = simulate(moving, 5.0, 0.01, interface_temperature=COLD)
    assert np.abs(outputs[:, O_X] - plain["x"]).max() < 1e-9


def test_restarts_with_the_model_s_own_states_change_nothing(p):
    times = np.linspace(0.0, 4.0, 401)
    whole = simulate_restarted(p, SPEED, COLD, times, [Restart(0, state())])
    slips = np.flatnonzero(whole[:, O_MODE] == 1.0)
    rows = slips[(slips > 50) & (slips < 350)][::7]
    again = [Restart(int(row), whole[row, O_X : O_X + 6]) for row in rows]
    cut = simulate_restarted(p, SPEED, COLD, times, [Restart(0, state()), *again])
    assert np.abs(cut[:, O_X] - whole[:, O_X]).max() < 1e-7


def test_nan_leaves_the_model_s_own_state(p):
    times = np.linspace(0.0, 4.0, 401)
    whole = simulate_restarted(p, SPEED, COLD, times, [Restart(0, state())])
    row = int(np.flatnonzero(whole[:, O_MODE] == 1.0)[60])
    own = Restart(row, np.full(6, np.nan))
    cut = simulate_restarted(p, SPEED, COLD, times, [Restart(0, state()), own])
    assert np.abs(cut[:, O_X] - whole[:, O_X]).max() < 1e-7


def test_a_contact_creeps_in_proportion_to_its_load(p):
    creep = 2e-3
    times = np.linspace(0.0, 8.0, 1601)
    outputs = simulate_restarted(p, SPEED, COLD, times, [Restart(0, state(0, 0, 0, SPEED))],
                                 creep=creep)
    holds = outputs[:, O_MODE] == 0.0
    both = holds[1:] & holds[:-1]
    speed = np.diff(outputs[:, O_X])[both] / np.diff(times)[both]
    friction = p[P_MU_S] * p[P_NORMAL_FORCE]
    load = outputs[:-1, O_FRICTION_X][both] / friction
    assert both.sum() > 400 and load.max() > 0.9
    # the load is known in twentieths, and is that of the row before
    assert np.abs(speed - (SPEED - creep * load)).max() < creep * (0.5 / 20.0 + 1e-3)


def test_creep_delays_the_break_away_by_what_it_takes_off(p):
    times = np.linspace(0.0, 8.0, 1601)
    start = [Restart(0, state(0, 0, 0, SPEED))]
    first = []
    for creep in (0.0, 2e-3):
        outputs = simulate_restarted(p, SPEED, COLD, times, start, creep=creep)
        away = int(np.flatnonzero(outputs[:, O_MODE] == 1.0)[0])
        first.append((times[away], outputs[away - 1, O_X]))
    (rigid, x), (late, x_late) = first
    assert x_late == pytest.approx(x, abs=2.0 * SPEED * 0.005)
    # x' = V - c x / x_s: the way x_s takes (x_s / c) ln(V / (V - c)) instead of x_s / V
    assert late / rigid == pytest.approx(SPEED / 2e-3 * np.log(SPEED / (SPEED - 2e-3)), abs=5e-3)
