"""Melt water: the film's balance, freezing and thawing on the belt, nothing lost."""

import math

import numpy as np
import pytest

from thermal import Ambient, Belt, BeltIceModel, Contact, Ice, ThermalParameters
from thermal.contact import BeltWater, MeltFilm
from thermal.materials import WATER_DENSITY, WATER_VISCOSITY

AREA, LENGTH = 5e-3, 0.07
#: What melts forms its modes anew at every step; that nothing is lost is no matter of the mesh.
COARSE_ICE = Ice(radial_elements=3, axial_elements=5)


def film(pressure=0.0):
    return MeltFilm(AREA, LENGTH, pressure)


@pytest.mark.parametrize("steps", [10, 300])
def test_steady_film_is_melt_rate_times_residence(steps):
    """h = melt rate l / v: the mean of a film that grows along the way in Couette flow."""
    water, rate, speed, duration = film(), 1e-4, 0.5, 3.0
    left = sum(
        water.advance(duration / steps, speed * duration / steps, rate * duration / steps)
        for _ in range(steps)
    )
    assert water.thickness == pytest.approx(rate / (WATER_DENSITY * AREA) * LENGTH / speed)
    assert left + water.mass == pytest.approx(rate * duration, rel=1e-13)


def test_shear_is_exact_for_any_step():
    """dm/dt = r - (v/l) m from m0."""
    rate, speed, start, duration = 2e-4, 0.2, 1e-4, 0.4
    residences = speed * duration / LENGTH
    exact = start * math.exp(-residences) - rate * LENGTH / speed * math.expm1(-residences)
    for steps in (1, 50):
        water = film()
        water.mass = start
        for _ in range(steps):
            water.advance(duration / steps, -speed * duration / steps, rate * duration / steps)
        assert water.mass == pytest.approx(exact, rel=1e-12)


@pytest.mark.parametrize("displacement", [0.0, 1e-12, 0.004, -2.0])
def test_what_is_available_can_freeze_to_the_last_drop(displacement):
    water = film()
    water.mass = 1e-4
    frozen = water.available(displacement) * (1.0 + 1e-15)
    left = water.advance(0.01, displacement, -frozen)
    assert 0.0 <= water.mass < 1e-18 and left >= 0.0
    assert left + frozen == pytest.approx(1e-4, rel=1e-12)


@pytest.mark.parametrize("movement", [0.0, 1e-13, 3e-4, -0.0123])
def test_water_is_laid_where_the_edge_passed(movement):
    belt = BeltWater(200, 1e-3, 350e3, 8.0)
    belt.lay(1e-5, 0.1505, movement)
    assert belt.water.sum() == pytest.approx(1e-5, rel=1e-12)
    x = np.arange(200) * 1e-3
    assert belt.water @ x / belt.water.sum() == pytest.approx(0.1505 + 0.5 * movement, abs=1e-9)
    assert belt.water.min() >= -1e-20


def test_picked_up_under_the_block_only():
    belt = BeltWater(200, 1e-3, 350e3, 8.0)
    belt.water[:] = 1e-6
    taken = belt.pick_up(0.01, 0.04)
    assert taken == pytest.approx((1e-6) * 39)
    assert belt.water.sum() + taken == pytest.approx(200e-6)
    assert np.flatnonzero(belt.water == 0.0).size == 39


@pytest.mark.parametrize("movement", [0.0301, -0.0301])
def test_a_wiper_takes_its_part_of_what_passes(movement):
    belt = BeltWater(200, 1e-3, 350e3, 8.0)
    belt.water[:], belt.frozen[:] = 2e-6, 4e-6
    taken = belt.wipe(0.1905, movement, 0.75)
    passed = 30  # nodes, across the seam of the loop or not
    assert taken == pytest.approx((passed * 1.5e-6, passed * 3e-6))
    assert belt.water.sum() + taken[0] == pytest.approx(200 * 2e-6)
    assert belt.frozen.sum() == pytest.approx((200 - 0.75 * passed) * 4e-6)
    assert belt.wipe(0.05, 0.0, 1.0) == (0.0, 0.0)


def test_what_froze_on_the_belt_and_was_wiped_off_is_on_the_books():
    """Melted = water anywhere + ice on the belt + ice wiped off."""
    air, wiped = Ambient(temperature_degC=-2.0), Contact(wiper=1.0)
    model = BeltIceModel(ThermalParameters(ambient=air, contact=wiped, ice=COARSE_ICE))
    for _ in range(400):
        model.step(0.01, 4.0, 0.03)
    water, found = model.meltwater, model.outputs()
    assert found["wiped_ice_mass"] > 0.01 * found["melted_mass"] > 0.0
    assert found["melted_mass"] == pytest.approx(
        water.water + found["refrozen_mass"] + found["wiped_ice_mass"], rel=1e-12
    )


def test_a_belt_that_is_wiped_brings_no_water_back():
    """Warm air and belt, so that nothing freezes: all that was wiped is on the books."""
    air, belt = Ambient(temperature_degC=-1e-3), Belt(cell_length=2e-3)
    wet, wiped = (
        BeltIceModel(
            ThermalParameters(ambient=air, contact=Contact(wiper=share), belt=belt, ice=COARSE_ICE)
        )
        for share in (0.0, 1.0)
    )
    for model in (wet, wiped):
        drive(model, 600)
        outputs = model.outputs()
        assert abs(outputs["heat_residual"]) < 1e-10 * outputs["heat_received"]
        assert mass_found(model) == pytest.approx(outputs["melted_mass"], rel=1e-12)
    assert wet.meltwater.wiped == 0.0
    # all but what one loop has left on the belt
    assert wiped.meltwater.wiped > 0.6 * wiped.outputs()["melted_mass"]
    assert wiped.outputs()["wiped_ice_mass"] == 0.0
    assert wet.outputs()["film_thickness"] > 2.0 * wiped.outputs()["film_thickness"]


def test_what_the_block_weighs_squeezes_the_film():
    """Left at rest, h^-2 grows by 4 p t/(3 eta a^2): with the load given, or the ice's own."""
    for load in (0.0, 400.0):
        model = BeltIceModel(
            ThermalParameters(ambient=Ambient(temperature_degC=-1e-9), contact=Contact(load=load))
        )
        film, area = model.meltwater.film, model.footprint.area
        film.mass = 1e-4 * WATER_DENSITY * area
        film.advance(5.0, 0.0, 0.0)
        weight = load or 917.0 * math.pi * 0.04**2 * 0.1 * 9.81
        grown = 4.0 * weight / area * 5.0 / (3.0 * WATER_VISCOSITY * area / math.pi)
        assert film.thickness**-2 == pytest.approx(1e8 + grown, rel=1e-9)


def drive(model, steps, duration=0.01, power=100.0, speed=0.5):
    for _ in range(steps):
        model.step(duration, power * duration, speed * duration)


COLD_BELT = ThermalParameters(
    ambient=Ambient(temperature_degC=-3.0), belt=Belt(cell_length=2e-3, length=2.0), ice=COARSE_ICE
)


def mass_found(model):
    water = model.meltwater
    return water.water + water.on_belt.frozen.sum()


def test_no_mass_and_no_heat_is_lost():
    """Melting, freezing, thawing, stick, back and forth: 1e-10 of the heat, 1e-12 of the mass."""
    model = BeltIceModel(COLD_BELT)
    seen = set()
    for n in range(1200):
        speed = 0.5 if n % 400 < 250 else (-0.3 if n % 400 < 300 else 0.0)
        before = model.meltwater.on_belt.frozen.sum()
        model.step(0.01, 1.5 if speed else 0.0, 0.01 * speed)
        outputs = model.outputs()
        seen.add(np.sign(outputs["refrozen_mass"] - before))
        seen.add(("melting", np.sign(outputs["melt_rate"])))
        assert abs(outputs["heat_residual"]) < 1e-10 * outputs["heat_received"]
        assert mass_found(model) == pytest.approx(outputs["melted_mass"], rel=1e-12, abs=1e-18)
        assert outputs["film_thickness"] >= 0.0
    # all that can happen has happened: ice froze and thawed on the belt, and to the block
    assert {1.0, -1.0, ("melting", 1.0), ("melting", -1.0)} <= seen


def test_water_freezes_on_the_cold_belt_and_warms_it():
    model, dry = BeltIceModel(COLD_BELT), BeltIceModel(COLD_BELT)
    drive(model, 300)
    frozen = model.meltwater.on_belt.frozen
    place = np.argmax(frozen)
    assert frozen[place] > 0.0
    _, temperature = model.belt_profile()
    wet = model.meltwater.on_belt.water > 1e-12
    outside = np.abs((model.belt.position - model.contact_position + 1.0) % 2.0 - 1.0) > 0.05
    assert temperature[wet & outside] == pytest.approx(0.0, abs=0.02), "freezing holds 0 degC"
    # the same fluxes without freezing leave the belt colder by what freezing gave
    dry.meltwater.on_belt.freeze = lambda duration, face, response: np.zeros(face.size)
    drive(dry, 300)
    gained = model.outputs()["belt_heat"] - dry.outputs()["belt_heat"]
    given = frozen.sum() * model.meltwater.melt_heat
    assert 0.5 * given < gained < given


def test_one_film_of_water_freezes_as_in_stefans_problem():
    """Water on a uniform belt far below 0 degC, deep: frozen mass = 2 e dT sqrt(t/pi) / L'."""
    parameters = ThermalParameters(
        belt=Belt(cell_length=5e-3, thickness=0.02, air_heat_transfer=0.0, elements=14)
    )
    model = BeltIceModel(parameters)
    water = model.meltwater.on_belt
    per_node = model.footprint.lane * model.belt.cell
    water.water[:] = 1.0 * per_node
    steps, duration = 200, 0.01
    for _ in range(steps):
        first = model.belt.face_after(duration, {})
        power = water.freeze(duration, *first)
        model.belt.advance(duration, {0: np.fft.rfft(power)})
    effusivity = math.sqrt(0.5 * 700.0 * 840.0)
    taken = 2.0 * effusivity * 8.0 * math.sqrt(steps * duration / math.pi)
    assert water.frozen / per_node * water._melt_heat == pytest.approx(taken, rel=5e-3)


def test_a_melting_state_continues_bit_for_bit():
    parameters = ThermalParameters(
        ambient=Ambient(temperature_degC=-1.0), belt=Belt(cell_length=4e-3), ice=Ice(height=0.02)
    )
    model = BeltIceModel(parameters)
    drive(model, 100)
    kept = model.state()
    copied = kept.copy()
    drive(model, 100)
    end, outputs = model.state(), model.outputs()
    assert np.array_equal(kept, copied), "a state is a copy"
    assert model.ice.melted_depth > 1e-5, "the modes have been formed anew"
    for other in (BeltIceModel(parameters), model):
        other.restore(kept)
        drive(other, 100)
        assert np.array_equal(other.state(), end) and other.outputs() == outputs
