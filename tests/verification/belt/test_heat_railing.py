"""Friction heat of the belt on its railing, warm rollers, and where the contact's heat arises."""

import numpy as np
import pytest

from thermal import Belt, BeltIceModel, Contact, Ice, SteadySliding, ThermalParameters

LOAD, FRICTION, SHARE = 13.45, 0.1, 0.5  # N, 1, 1
RAILING = {
    "railing_length": 0.08, "railing_friction": FRICTION, "railing_load": LOAD,
    "railing_share": SHARE, "railing_conductance": 15.0,
}  # fmt: skip
ROLLERS = {"rollers": 2, "roller_arc": 0.1, "roller_conductance": 1000.0}
#: Next to nothing crosses the contact.
APART = Contact(conductance=1e-9)


def test_an_insulated_belt_keeps_all_of_its_share():
    """Mean rise = share mu N s / (c rho A L), s the travel of the belt and not of the contact."""
    insulated = RAILING | {"railing_conductance": 0.0}
    belt = Belt(length=0.5, width=0.06, cell_length=4e-3, air_heat_transfer=0.0, **insulated)
    model = BeltIceModel(ThermalParameters(belt=belt, contact=APART))
    for _ in range(50):
        model.step(0.1, 0.0, 0.03, 0.05)
    expected = SHARE * FRICTION * LOAD * 50 * 0.05
    outputs = model.outputs()
    assert outputs["railing_heat"] == pytest.approx(expected, rel=1e-12)
    assert outputs["belt_heat"] == pytest.approx(expected, rel=1e-9)
    capacity = 700.0 * 840.0 * 1e-3 * 0.06 * 0.5
    assert model.belt.field().mean() == pytest.approx(expected / capacity, rel=0.05)
    assert outputs["heat_received"] == 0.0
    assert abs(outputs["heat_residual"]) < 1e-10 * expected


def test_warm_rollers_warm_a_belt_that_conducts_well():
    """h_r A_r (T_r - T) = h A_open T for a belt of one temperature, no friction anywhere."""
    h, warm = 15.0, 2.0
    belt = Belt(
        cell_length=4e-3, conductivity=2e3, air_heat_transfer=h, roller_rise=warm, rollers=2,
        roller_arc=0.1, roller_conductance=50.0,
    )  # fmt: skip
    sliding = SteadySliding(ThermalParameters(belt=belt, contact=APART), 5.0, 0.0)
    state = sliding.settle()
    lane = sliding.footprint.lane
    touched = 2 * 0.1 * lane
    free = 2.0 * lane * 1.0 - touched - sliding.footprint.area
    expected = warm * 50.0 * touched / (50.0 * touched + h * free)
    assert state.belt_mean == pytest.approx(expected, rel=5e-3)


@pytest.mark.parametrize("speed", [0.15, 0.82])
def test_long_steps_and_small_steps_agree_on_railing_and_rollers(speed):
    belt = Belt(
        cell_length=2e-3, roller_rise=0.3, **(ROLLERS | {"roller_conductance": 100.0}), **RAILING
    )
    model = BeltIceModel(ThermalParameters(belt=belt))
    for _ in range(1000):
        model.step(0.02, 4.03 * speed * 0.02, speed * 0.02)
    outputs = model.outputs()
    state = SteadySliding(ThermalParameters(belt=belt), speed, 4.03).run(20.0)
    assert (state.entry, state.ice_face) == pytest.approx(
        (outputs["belt_entry_temperature"] + 8.0, outputs["ice_face_temperature"] + 8.0), rel=5e-3
    )


@pytest.mark.parametrize("side", [0.0, 0.3, 1.0])
def test_faces_apart_keep_what_arises_on_them(side):
    contact = Contact(conductance=1e-9, belt_side=side)
    model = BeltIceModel(ThermalParameters(belt=Belt(cell_length=4e-3), contact=contact))
    for _ in range(10):
        model.step(0.1, 0.05, 0.02)
    assert model.outputs()["belt_share"] == pytest.approx(side, abs=1e-6)


def test_a_sample_of_one_temperature_holds_its_heat():
    model = BeltIceModel(ThermalParameters(ice=Ice(height=0.05)))
    model.ice.fill(-2.0)
    volume = np.pi * 0.04**2 * 0.05
    assert model.ice.heat() == pytest.approx(-2.0 * 917.0 * 2050.0 * volume, rel=1e-9)
    assert model.ice.face() == pytest.approx(-2.0, rel=1e-9)
