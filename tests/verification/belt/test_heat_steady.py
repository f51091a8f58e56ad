"""The steady state of sliding, found directly: against many passes, and the two ways to it."""

import numpy as np
import pytest

from thermal import Belt, BeltIceModel, Contact, Ice, ThermalParameters
from thermal.steady_sliding import SteadySliding
from thermal.steady_state import NoSteadyState, settle

PASSES = 10_000
LIKE_MANY_PASSES = 1e-6
#: Belt and ice that forget the start within the passes, and few unknowns.
SMALL = ThermalParameters(
    belt=Belt(
        length=0.045,
        width=0.05,
        cell_length=1.5e-3,
        elements=1,
        railing_length=0.02,
        railing_conductance=40.0,
    ),
    ice=Ice(height=0.01, air_heat_transfer=60.0, radial_elements=2, axial_elements=2),
    contact=Contact(radius=0.02, strips=4),
)
STEP = (0.02, 0.01, 1.5e-3)  # s, J, m
STEPS_IN_A_PASS = 30
SENSES = (
    "belt_entry_temperature",
    "belt_exit_temperature",
    "ice_face_temperature",
    "interface_temperature",
)


def rises(model):
    outputs = model.outputs()
    return np.array([outputs[name] + 8.0 for name in SENSES])


def temperatures(model):
    """All amplitudes of belt and ice as real numbers."""
    return np.concatenate((model.ice.amplitudes, model.belt.amplitudes.view(np.float64).ravel()))


def set_temperatures(model, values):
    ice = model.ice.amplitudes.size
    model.ice.amplitudes[:] = values[:ice]
    model.belt.amplitudes.view(np.float64)[:] = values[ice:].reshape(
        model.belt.amplitudes.shape[0], -1
    )


def one_pass(start, heat):
    """Temperatures after the steps of one loop, from given ones, by stepping the model."""
    model = BeltIceModel(SMALL)
    set_temperatures(model, start)
    for _ in range(STEPS_IN_A_PASS):
        model.step(STEP[0], heat, STEP[2])
    return temperatures(model)


def test_ten_thousand_passes_lead_to_the_settled_state():
    """A pass is linear in the temperatures: its columns are stepped, then it is done over and over.

    The fluxes of a pass are affine in the temperatures too, so no step is left out or lengthened.
    """
    settled = BeltIceModel(SMALL)
    settle(settled, *STEP)
    for _ in range(STEPS_IN_A_PASS - 1):
        settled.step(*STEP)
    size = temperatures(settled).size
    columns = np.stack([one_pass(unit, 0.0) for unit in 1e-3 * np.eye(size)], axis=1) / 1e-3
    added = one_pass(np.zeros(size), STEP[1])
    state = np.zeros(size)
    for _ in range(PASSES):
        state = columns @ state + added
    stepped = BeltIceModel(SMALL)
    set_temperatures(stepped, state)
    assert rises(stepped) == pytest.approx(rises(settled), rel=LIKE_MANY_PASSES)
    early = BeltIceModel(SMALL)
    set_temperatures(early, added)
    assert rises(early) != pytest.approx(rises(settled), rel=0.1), "the start must differ"


@pytest.mark.parametrize("displacement", [2e-3, -4e-3, 0.0])
def test_the_settled_state_stays(displacement):
    model = BeltIceModel(ThermalParameters(belt=Belt(length=0.5, cell_length=2e-3)))
    settle(model, 0.01, 0.005, displacement)
    before = rises(model)
    for _ in range(200):
        model.step(0.01, 0.005, displacement)
    assert rises(model) == pytest.approx(before, rel=1e-9)
    outputs = model.outputs()
    assert abs(outputs["heat_residual"]) < 1e-10 * outputs["heat_received"]
    given = outputs["air_heat"] / (201 * 0.005)
    assert given == pytest.approx(1.0, rel=1e-9), "all friction heat goes to the air"


def test_two_ways_to_the_steady_state_meet():
    """Steps of whole cells against the fixed point in the contact's frame, as the cells shrink.

    Their loads differ by how far a cell spreads them: first order at the edges of the contact.
    """
    speed, force = 0.2, 4.0
    errors = []
    for cell in (4e-3, 2e-3, 1e-3):
        parameters = ThermalParameters(belt=Belt(length=0.4, cell_length=cell))
        model = BeltIceModel(parameters)
        settle(model, cell / speed, force * cell, cell)
        direct = SteadySliding(parameters, speed, force, waves=800).settle()
        expected = (direct.entry, direct.ice_face, direct.mean_interface)
        errors.append(np.abs(rises(model)[[0, 2, 3]] / expected - 1.0))
    errors = np.array(errors)
    assert np.all(errors[-1] < 1e-3)
    assert np.all(errors[1:] < 0.6 * errors[:-1])


@pytest.mark.parametrize("railing", [0.0, 0.2])
def test_a_belt_that_keeps_its_heat_has_no_steady_state(railing):
    belt = Belt(air_heat_transfer=0.0, railing_length=railing)
    parameters = ThermalParameters(belt=belt)
    with pytest.raises(NoSteadyState, match=r"belt\.air_heat_transfer = 0: .* warms for ever"):
        SteadySliding(parameters, 0.15, 4.0).settle()
    with pytest.raises(NoSteadyState, match="warms for ever"):
        settle(BeltIceModel(parameters), 0.01, 0.01, 1e-3)


def test_ice_that_melts_for_ever_is_told():
    with pytest.raises(NoSteadyState, match="melts for ever"):
        settle(BeltIceModel(), 0.01, 10.0, 1e-3)


@pytest.mark.parametrize(
    ("speed", "force", "says"),
    [
        (0.0, 4.0, "speed = 0 m/s must be above 0"),
        (0.1, -1.0, "force = -1 N"),
        (np.nan, 1.0, "speed = nan"),
    ],
)
def test_steady_sliding_refuses_what_cannot_be(speed, force, says):
    with pytest.raises(ValueError, match=says):
        SteadySliding(ThermalParameters(), speed, force)


def test_friction_that_feels_the_temperature_settles_where_it_must():
    """theta = theta_0 (1 - s theta), theta_0 the rise under friction that does not feel it."""
    parameters, s = ThermalParameters(belt=Belt(cell_length=4e-3)), 0.1
    cold = SteadySliding(parameters, 0.5, 4.0).settle().mean_interface
    sliding = SteadySliding(parameters, 0.5, 4.0, sensitivity=s)
    sliding.run(20.0)
    warm = sliding.settle().mean_interface
    assert warm == pytest.approx(cold / (1.0 + s * cold), rel=1e-9)
    for _ in range(3):
        sliding.step(1e3)
    assert sliding.state().mean_interface == pytest.approx(warm, rel=1e-6)
