"""Leine's oscillators: every published or independently computed figure, limits, energy."""

import numpy as np
import pytest
from leine_disc import SLIP, STICK, LeineDisc
from leine_oscillator import LeineOscillator
from stickslip.reference.coulomb_oscillator import CoulombOscillator

#: m = 1 kg, k = 1 N/m, v = 0.2 m/s, F_s = 1 N, delta = 3 s/m; computed independently to 1e-13
VELOCITY_WEAKENING = {
    "period": 12.0010312948,
    "slip_time": 4.2959995255,
    "stick_time": 7.7050317694,
    "slip_starts_at": 1.0,
    "slip_ends_at": -0.5410063539,
}
#: the same run, figures known to eight decimals
EXTREMES = {"x_max": 1.13394468, "x_min": -0.55543269, "speed_min": -0.83990205}


@pytest.fixture(scope="module")
def cycle():
    return LeineOscillator().limit_cycle()


@pytest.mark.parametrize(("name", "figure"), VELOCITY_WEAKENING.items())
def test_velocity_weakening(cycle, name, figure):
    assert getattr(cycle, name) == pytest.approx(figure, abs=1e-9)


@pytest.mark.parametrize(("name", "figure"), EXTREMES.items())
def test_velocity_weakening_extremes(cycle, name, figure):
    assert getattr(cycle, name) == pytest.approx(figure, abs=5.1e-9)  # half the last digit


def test_sliding_for_good_is_refused():
    with pytest.raises(ValueError, match="static_force"):
        LeineOscillator(static_force=0.0)


def test_coulomb_closed_form():
    oscillator = CoulombOscillator(1.0, 1.0, 0.2, 1.0, 0.5)
    assert oscillator.slip_time == pytest.approx(3.902605407814523, abs=1e-14)
    assert oscillator.period == pytest.approx(8.902605407814523, abs=1e-14)
    assert oscillator.centre == oscillator.excess  # slips end where the springs are slack
    assert oscillator.amplitude == pytest.approx(np.sqrt(0.29), abs=1e-15)


def test_coulomb_closed_form_is_the_free_oscillation():
    """The slip's own motion, from its start, has the belt's speed again after slip_time."""
    o = CoulombOscillator(0.67, 80.68, 0.15, 1.85, 1.37)
    w, t = o.omega, np.linspace(0.0, o.slip_time, 2001)
    x = o.centre + o.excess * np.cos(w * t) + o.belt_speed / w * np.sin(w * t)
    speed = o.belt_speed * np.cos(w * t) - o.excess * w * np.sin(w * t)
    assert x[-1] == pytest.approx(o.centre - o.excess, abs=1e-15)
    assert speed[-1] == pytest.approx(o.belt_speed, abs=1e-15)
    assert np.all(speed[1:-1] < o.belt_speed)
    assert np.trapezoid(x, t) / o.slip_time == pytest.approx(o.mean_x, abs=1e-7)


DISC = LeineDisc(inertia=0.7, torsion_stiffness=1.3, radius=0.8, belt_speed=0.5)


def test_disc_sticks_with_its_contact():
    for segment in DISC.simulate(30.0):
        if segment.mode == STICK:
            _, speed, _, rim = segment.state
            np.testing.assert_allclose(speed + rim, DISC.belt_speed, atol=1e-10)
            force = DISC.sticking_force(segment.state)
            assert np.max(np.abs(force)) < DISC.static_force + 1e-10


def test_disc_alternates_and_continues():
    segments = DISC.simulate(40.0)
    assert {s.mode for s in segments} == {STICK, SLIP}
    for before, after in zip(segments, segments[1:], strict=False):
        assert before.time[-1] == after.time[0]
        np.testing.assert_array_equal(before.state[:, -1], after.state[:, 0])


def test_disc_energy():
    """Work of the friction on mass and rotation = what their energy gains, segment by segment."""
    for segment in DISC.simulate(20.0)[:6]:
        side = np.sign(np.median(DISC.belt_speed - segment.state[1] - segment.state[3]))
        force = np.array(
            [
                DISC.sticking_force(s) if segment.mode == STICK else DISC.sliding_force(s, side)
                for s in segment.state.T
            ]
        )
        power = force * (segment.state[1] + segment.state[3])
        gained = DISC.energy(segment.state[:, -1]) - DISC.energy(segment.state[:, 0])
        # trapezium over steps of at most 0.05/omega: its error is h^2/12 of the power's curvature
        assert np.trapezoid(power, segment.time) == pytest.approx(gained, abs=3e-4)


def test_disc_that_cannot_turn_is_the_one_mass_model():
    heavy = LeineDisc(inertia=1e9, torsion_stiffness=1e9, belt_speed=0.2)
    first = [s for s in heavy.simulate(10.0) if s.mode == SLIP][0]
    cycle = LeineOscillator().limit_cycle()
    assert first.time[-1] - first.time[0] == pytest.approx(cycle.slip_time, abs=1e-7)
    assert first.state[0, -1] == pytest.approx(cycle.slip_ends_at, abs=1e-7)
