"""Ramp, run and pause in long steps, against small steps of the model and closed forms."""

import numpy as np
import pytest

from thermal import Belt, BeltIceModel, Contact, SteadySliding, ThermalParameters

FORCE = 0.3 * 1.371 * 9.81
RAMP, RUN, STEP = 10.0, 20.0, 0.02


def parameters(length=1.0, h=15.0, **contact):
    return ThermalParameters(
        belt=Belt(length=length, air_heat_transfer=h, cell_length=2e-3), contact=Contact(**contact)
    )


def small_steps(given, speed, pause=0.0):
    """Ramp, run and pause of the model that a coupled run steps."""
    model = BeltIceModel(given)
    for i in range(round(RAMP / STEP)):
        travel = speed * STEP * (i + 0.5) * STEP / RAMP
        model.step(STEP, FORCE * travel, travel)
    for _ in range(round(RUN / STEP)):
        model.step(STEP, FORCE * speed * STEP, speed * STEP)
    for _ in range(round(pause / STEP)):
        model.step(STEP, 0.0, 0.0)
    return model.outputs()


def rises(outputs):
    return [
        outputs[f"{name}_temperature"] + 8.0 for name in ("belt_entry", "interface", "ice_face")
    ]


def long_steps(given, speed, coarseness=1.0):
    sliding = SteadySliding(given, speed, FORCE, waves=round(250 * given.belt.length))
    sliding.ramp(RAMP, coarseness)
    return sliding, sliding.run(RUN, coarseness)


@pytest.mark.parametrize(
    ("length", "speed", "h", "published"),
    [(1.0, 0.15, 15.0, 0.082), (1.0, 0.15, 7.0, 0.107), (1.0, 0.82, 15.0, None)],
)
def test_ramp_and_run_against_small_steps(length, speed, h, published):
    """Published: computed once by others, to three digits."""
    given = parameters(length, h)
    _, state = long_steps(given, speed)
    assert (state.entry, state.mean_interface, state.ice_face) == pytest.approx(
        rises(small_steps(given, speed)), rel=4e-3
    )
    if published:
        assert state.entry == pytest.approx(published, rel=0.01)


def test_a_pause_with_the_ice_resting_against_small_steps():
    given, speed, pause = parameters(), 0.5, 30.0
    sliding, _ = long_steps(given, speed)
    sliding.pause(pause)
    expected = rises(small_steps(given, speed, pause))
    state = sliding.state()
    assert (state.mean_interface, state.ice_face) == pytest.approx(expected[1:], rel=5e-3)


def test_a_lifted_belt_cools_like_a_thin_plate():
    """exp(-2 h t / (c rho d)), the plate's Biot number being 0.03."""
    given = parameters(h=10.0)
    sliding, state = long_steps(given, 0.5)
    after = sliding.pause(40.0, lifted=True)
    assert after.belt_mean == pytest.approx(
        state.belt_mean * np.exp(-2.0 * 10.0 * 40.0 / (700.0 * 840.0 * 1e-3)), rel=5e-3
    )
    assert 0.0 < after.ice_face < 0.5 * state.ice_face


def test_another_film_leaves_the_temperatures_and_then_matters():
    sliding, _ = long_steps(parameters(), 0.5)
    places = np.linspace(-0.5, 0.5, 50)
    before = sliding.face(places)
    kept = sliding.snapshot()
    sliding.belt.set_film(5.0)
    assert sliding.face(places) == pytest.approx(before, rel=1e-9)
    slow = sliding.pause(60.0, film=5.0).belt_mean
    sliding.restore(kept)
    assert sliding.face(places) == pytest.approx(before, rel=1e-9)
    assert sliding.pause(60.0).belt_mean < 0.7 * slow


def test_rises_are_the_sum_of_what_each_heat_makes():
    """Contact, railing and warm rollers; the doubt of the belt's length rests on it."""
    belt = Belt(
        cell_length=4e-3, railing_length=0.08, railing_friction=0.1, railing_load=13.0, rollers=2,
        roller_rise=0.4,
    )  # fmt: skip
    sliding = SteadySliding(ThermalParameters(belt=belt), 0.5, FORCE)
    entries = []
    for force, railing, rollers in ((FORCE, 1, 1), (FORCE, 0, 0), (0.0, 1, 0), (0.0, 0, 1)):
        sliding.force = force
        sliding.belt.railing_heat_factor, sliding.belt.roller_rise_factor = railing, rollers
        sliding.reset()
        sliding.ramp(RAMP)
        entries.append(sliding.run(RUN).entry)
    assert entries[0] == pytest.approx(sum(entries[1:]), rel=1e-9)
