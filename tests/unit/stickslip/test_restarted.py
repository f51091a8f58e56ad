"""Runs set to states: the model's own motion goes on, also that of a contact that creeps."""

import numpy as np
import pytest
from stickslip import Friction, Parameters, simulate
from stickslip.kernel import layout
from stickslip.kernel.layout import O_MODE, O_VX, O_X
from stickslip.restarted import Restarts, simulate_restarted, track_restarted

SPEED, COLD = 0.05, -8.0


@pytest.fixture(scope="module")
def parameters():
    return Parameters()


@pytest.fixture(scope="module")
def p(parameters):
    return parameters.pack()


def state(*values):
    return np.array([*values, *[0.0] * (6 - len(values))])


FROM_REST = Restarts.at([0], [state()])
CARRIED = Restarts.at([0], [state(0, 0, 0, SPEED)])


def test_one_restart_is_the_plain_simulation(parameters, p):
    times = np.linspace(0.0, 5.0, 501)
    outputs = simulate_restarted(p, SPEED, COLD, times, FROM_REST)
    surface = parameters.surface.model_copy(update={"speed": SPEED})
    moving = parameters.model_copy(update={"surface": surface})
    plain = simulate(moving, 5.0, 0.01, interface_temperature=COLD)
    assert np.abs(outputs[:, O_X] - plain["x"]).max() < 1e-9


def test_places_alone_are_those_of_the_outputs(p):
    times = np.linspace(0.0, 3.0, 301)
    start = Restarts.at([0, 150], [state(0.01), state(0.02)])
    outputs = simulate_restarted(p, SPEED, COLD, times, start)
    places = track_restarted(p, SPEED, COLD, times, start)
    assert np.array_equal(places, outputs[:, O_X : O_X + 3])


@pytest.fixture(scope="module")
def creeping(parameters):
    return parameters.model_copy(update={"friction": Friction(stick_creep=2e-3)}).pack()


def test_a_window_in_a_stick_has_the_velocity_of_the_stick(creeping):
    times = np.linspace(0.0, 8.0, 801)
    whole = simulate_restarted(creeping, SPEED, COLD, times, CARRIED)
    sticks = whole[:, O_MODE] == 0.0
    begin = int(np.flatnonzero(sticks[1:] & ~sticks[:-1])[1]) + 1
    row = begin + 20
    assert sticks[begin : row + 1].all()
    only_x = np.full(6, np.nan)
    only_x[0] = whole[row, O_X]
    # the model has not come there by itself: it was set to slip before
    set_to = [state(0.01, 0, 0, 0.5 * SPEED), only_x]
    again = Restarts.at([0, row], set_to, [np.nan, times[begin]])
    cut = simulate_restarted(creeping, SPEED, COLD, times, again)
    assert np.abs(cut[row:, [O_X, O_VX]] - whole[row:, [O_X, O_VX]]).max() < 1e-9


def test_a_window_in_slip_slips_however_slow(creeping):
    """Also where the block before it stuck, and could have crept as fast."""
    times = np.linspace(0.0, 1.0, 1001)
    slow = Restarts.at([0, 100], [state(0, 0, 0, SPEED), state(0.005, 0, 0, SPEED - 5e-4)])
    outputs = simulate_restarted(creeping, SPEED, COLD, times, slow)
    assert outputs[99, O_MODE] == 0.0 and outputs[100, O_MODE] == 1.0
    assert outputs[100, O_VX] == SPEED - 5e-4


@pytest.fixture(scope="module")
def sheared(parameters):
    friction = Friction(mu_s=0.3, mu_k=0.2, transition_speed=3e-3, presliding_distance=5e-5)
    return parameters.model_copy(update={"friction": friction}).pack()


def test_bristles_have_the_shear_that_a_window_asks_for(sheared):
    """In stick that of a load that grows, in slip that of steady sliding: what is left is small.

    The way into a break-away, some 0.1 s after the first window's begin, makes more of it.
    """
    times = np.linspace(0.0, 6.0, 601)
    whole = simulate_restarted(sheared, SPEED, COLD, times, CARRIED)
    sticks = whole[:, O_MODE] == 0.0
    begin = int(np.flatnonzero(sticks[1:] & ~sticks[:-1])[1]) + 1
    only_x = np.full(6, np.nan)
    only_x[0] = whole[begin + 15, O_X]
    held = begin + 15, only_x, times[begin]
    slip = int(np.flatnonzero(whole[:, O_X + 3] < 0.2 * SPEED)[20])  # well inside one
    moved = slip, whole[slip, O_X : O_X + 6], np.nan
    for row, reached, since in (held, moved):
        # the model has not come there by itself: it was set to slip before
        first = state(0.01, 0, 0, 0.5 * SPEED)
        window = Restarts.at([0, row], [first, reached], [np.nan, since])
        cut = simulate_restarted(sheared, SPEED, COLD, times, window)
        rows = slice(row, row + 15)
        assert cut[row, O_MODE] == whole[row, O_MODE]
        apart = np.abs(cut[rows, O_X] - whole[rows, O_X])
        assert apart[:8].max() < 1e-6 and apart.max() < 3e-5


@pytest.mark.parametrize("contact", ["p", "sheared"])
def test_a_window_that_sets_nothing_leaves_the_model_s_own_state(request, contact):
    """By nan; in stick and in slip, and the shear of bristles, too."""
    p, times = request.getfixturevalue(contact), np.linspace(0.0, 3.0, 301)
    whole = simulate_restarted(p, SPEED, COLD, times, CARRIED)
    rows = (30, 80, 130, 180, int(np.flatnonzero(whole[:, O_X + 3] < 0.2 * SPEED)[20]))
    assert {*whole[list(rows), O_MODE]} == {0.0, 1.0}
    for row in rows:
        window = Restarts.at([0, row], [state(0, 0, 0, SPEED), np.full(6, np.nan)])
        cut = simulate_restarted(p, SPEED, COLD, times, window)
        assert np.abs(cut[:, O_X] - whole[:, O_X]).max() < 1e-7


@pytest.mark.parametrize("table", [{}, {"table_speed": (0.0, 1.0), "table_mu": (0.2, 0.2)}])
def test_friction_of_a_window_is_a_part_of_all_that_the_model_has(table):
    """mu_s and mu_k 0.9 times as large, in stick and in slip, by mu_k and by a table of it."""
    times = np.linspace(0.0, 3.0, 301)
    whole = Parameters(friction=Friction(mu_s=0.3, mu_k=0.2, **table)).pack()
    less = {
        name: tuple(0.9 * mu for mu in v) if name == "table_mu" else v for name, v in table.items()
    }
    part = Parameters(friction=Friction(mu_s=0.27, mu_k=0.18, **less)).pack()
    windows = FROM_REST._replace(friction=np.array([[0.9, 0.9]]))
    scaled = simulate_restarted(whole, SPEED, COLD, times, windows)
    meant = simulate_restarted(part, SPEED, COLD, times, FROM_REST)
    assert (meant[:, O_MODE] == layout.SLIP).any()
    assert scaled[:, O_X] == pytest.approx(meant[:, O_X], abs=1e-7)
