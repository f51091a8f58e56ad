"""The steady state of sliding, found directly: steps leave it as it is, and two ways to it."""

import numpy as np
import pytest
from settled_belt import settle

from thermal import Belt, BeltIceModel, NoSteadyState, SteadySliding, ThermalParameters

SENSES = (
    "belt_entry_temperature", "belt_exit_temperature", "ice_face_temperature",
    "interface_temperature",
)  # fmt: skip


def rises(model):
    outputs = model.outputs()
    return np.array([outputs[name] + 8.0 for name in SENSES])


@pytest.mark.parametrize("displacement", [2e-3, -4e-3, 0.0])
@pytest.mark.parametrize("support", [{}, {"railing_length": 0.2, "railing_conductance": 40.0}])
def test_the_settled_state_stays(displacement, support):
    belt = Belt(length=0.5, cell_length=2e-3, **support)
    model = BeltIceModel(ThermalParameters(belt=belt))
    settle(model, 0.01, 0.005, displacement)
    before = rises(model)
    for _ in range(200):
        model.step(0.01, 0.005, displacement)
    assert rises(model) == pytest.approx(before, rel=1e-9)
    outputs = model.outputs()
    assert abs(outputs["heat_residual"]) < 1e-10 * outputs["heat_received"]
    given = (outputs["air_heat"] + outputs["support_heat"]) / (201 * 0.005)
    assert given == pytest.approx(1.0, rel=1e-9), "all friction heat goes to air and railing"


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


@pytest.mark.parametrize(("speed", "force", "says"), [
    (0.0, 4.0, "speed = 0 m/s must be above 0"),
    (0.1, -1.0, "force = -1 N"),
    (np.nan, 1.0, "speed = nan"),
])  # fmt: skip
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
