"""Friction that falls from mu_s to mu_k over a sliding speed: against scipy, and its limits.

mu(v) = mu_k + (mu_s - mu_k) exp(-(v / v_s)^p): a slip begins at rest with the friction that held
the block, grows by e in tau = m v_s / (N (mu_s - mu_k)), and ends where it comes to rest again.
"""

import numpy as np
import pytest
from line_rig import GRAVITY, MASS, MU_K, MU_S, STIFFNESS, line
from one_mass_model import OneMass, X
from stickslip import Parameters, friction_coefficient, simulate

SPEED, NORMAL = 0.05, MASS * GRAVITY


def on_a_line(duration, interval=0.01, transition_speed=0.0, **tables):
    rig = line(SPEED, {"transition_speed": transition_speed}, **tables)
    return simulate(rig, duration, interval)


def by_scipy(times, transition_speed, exponent, creep):
    """x and the events of the tests' own model, by scipy's DOP853 and its events.

    A stick creeps by v_c times the part of mu_s N that its load is.
    """

    def kinetic(sliding, state):
        fall = np.exp(-((sliding / transition_speed) ** exponent))
        return NORMAL * (MU_K + (MU_S - MU_K) * fall)

    model = OneMass(
        mass=MASS,
        pull=lambda x: -STIFFNESS * x,
        kinetic=kinetic,
        static=lambda rest, state: MU_S * NORMAL,
        speed=lambda t: SPEED,
        lag=lambda state: creep * STIFFNESS * state[X] / (MU_S * NORMAL),
    )
    samples, events = model.run(times)
    return samples[X], events[:, 0]


@pytest.mark.parametrize(
    ("transition_speed", "exponent", "creep"),
    [(1e-3, 1.0, 0.0), (1e-2, 1.0, 0.0), (3e-3, 2.0, 0.0), (3e-3, 3.0, 0.0), (3e-3, 1.0, 2e-3)],
)
def test_stick_and_slip_are_those_of_scipy(transition_speed, exponent, creep):
    law = {"transition_exponent": exponent, "stick_creep": creep}
    run = on_a_line(3.0, 0.01, transition_speed, friction=law)
    places, events = by_scipy(run.time, transition_speed, exponent, creep)
    assert np.abs(run["x"] - places).max() < 2e-9
    assert len(run.events) >= 6
    np.testing.assert_allclose(run.events[:6, 0], events[:6], rtol=0, atol=1e-7)
    assert np.abs(run["energy_residual"]).max() < 1e-10


def test_the_jump_is_the_limit():
    """The delay of a break-away is tau (a ln(1 / tau) + b): of first order but for the logarithm.

    The slip grows by e in tau from what the springs' load gains in tau, which is of order tau^2.
    """
    jump = on_a_line(1.5).slip_starts[1]
    speeds = np.array([1e-3, 1e-4, 1e-5, 1e-6])
    late = np.array([on_a_line(1.5, transition_speed=v).slip_starts[1] - jump for v in speeds])
    order = np.log10(late[:-1] / late[1:])
    assert np.all((order > 0.8) & (order < 1.0))
    assert np.all(np.diff(order) > 0.0)
    tau = MASS * speeds / (NORMAL * (MU_S - MU_K))
    a_decade = np.diff(late / tau)
    np.testing.assert_allclose(a_decade, a_decade.mean(), rtol=0.01)


def test_the_excess_is_on_top_of_what_mu_k_meets():
    """Other laws change mu_k; the excess is mu_s less what they make of mu_k at rest."""
    speeds = np.array([1e-4, 1e-3, 1e-2, 0.1])
    fall = np.exp(-((speeds / 4e-3) ** 2))
    law = {"mu_s": MU_S, "mu_k": MU_K, "transition_speed": 4e-3, "transition_exponent": 2.0}
    weakening = Parameters(friction=law, velocity_weakening={"hyperbolic": 3.0})
    expected = MU_K / (1.0 + 3.0 * speeds) + (MU_S - MU_K) * fall
    np.testing.assert_allclose(friction_coefficient(weakening, speeds), expected, rtol=1e-14)
    peak = Parameters(friction=law, velocity_weakening={"stribeck": 0.2, "stribeck_speed": 0.05})
    expected = MU_K * (1.0 + 0.2 * np.exp(-speeds / 0.05)) + (MU_S - 1.2 * MU_K) * fall
    np.testing.assert_allclose(friction_coefficient(peak, speeds), expected, rtol=1e-14)
    with pytest.warns(UserWarning, match="exceeds"):
        stronger = Parameters(friction=law | {"mu_s": 0.1})  # nothing to fall from
    np.testing.assert_allclose(friction_coefficient(stronger, speeds), MU_K, rtol=1e-15)


AGEING = {"saturating": 0.1, "saturation_time": 0.05}  # at 0.2 s of rest it has all of it


def test_the_age_of_a_contact_is_lost_over_a_distance():
    """In slip mu_s is what it would be at an age of theta_0 exp(-s / D), s the way in slip."""
    distance, v = 1e-3, 0.02
    run = on_a_line(0.8, 1e-4, v, static_strengthening=AGEING | {"slip_distance": distance})
    away, slip = run.slip_starts[0], run["mode"] == 1
    holds = (MU_S + 0.1 * -np.expm1(-away / 0.05)) * NORMAL
    assert STIFFNESS * SPEED * away == pytest.approx(holds, rel=1e-12)
    theta = away * np.exp(-run["sliding_distance"][slip] / distance)
    excess = MU_S + 0.1 * -np.expm1(-theta / 0.05) - MU_K
    expected = MU_K + excess * np.exp(-run["sliding_speed"][slip] / v)
    friction = run["friction_force_x"][slip] / NORMAL
    np.testing.assert_allclose(friction, expected, rtol=1e-9)
    assert theta[-1] < 1e-3 * theta[0]


def test_what_is_left_of_an_age_is_what_the_next_stick_begins_with():
    """With D far longer than a slip nothing is lost: the next stick goes on at the last's age."""
    kept, lost = (
        on_a_line(2.0, 0.01, 5e-3, static_strengthening=AGEING | {"slip_distance": distance})
        for distance in (1e3, 1e-5)
    )
    for run, begins in ((kept, kept.slip_starts[0]), (lost, 0.0)):
        stuck, away = run.events[1, 0], run.slip_starts[1]
        x = np.interp(stuck, run.time, run["x"])  # within 1e-4 m of the turn
        holds = MU_S + 0.1 * -np.expm1(-(begins + away - stuck) / 0.05)
        assert run.events[2, 2] == pytest.approx(holds * NORMAL / STIFFNESS, rel=1e-9)
        assert run.events[2, 2] > x


def test_without_a_transition_the_age_is_lost_at_once():
    runs = [
        on_a_line(3.0, static_strengthening=AGEING | {"slip_distance": distance})
        for distance in (1e-5, 1.0)
    ]
    for name in runs[0].columns:
        np.testing.assert_array_equal(runs[0][name], runs[1][name])


def test_of_the_excess_nothing_is_left_out_but_what_rounding_takes():
    """Thirty of `(v / v_s)^p` are felt to their digits, 45 not at all."""
    law = {"mu_s": 0.1, "mu_k": 0.0, "transition_speed": 4e-3, "transition_exponent": 1.3}
    speeds = 4e-3 * np.array([30.0, 45.0]) ** (1.0 / 1.3)
    left = friction_coefficient(Parameters(friction=law), speeds)
    np.testing.assert_allclose(left, [0.1 * np.exp(-30.0), 0.0], rtol=1e-12)
