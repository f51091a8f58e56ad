"""Water that shares the load with a dry contact: the law, its limits, and the film that closes it.

The formulas are worked out here once more, from the volume of the water and Couette's flow.
"""

from math import pi, sqrt

import numpy as np
import pytest
from scipy.optimize import brentq
from stickslip import Parameters, friction_coefficient, simulate

from thermal import Ambient, Belt, BeltIceModel, Contact, Ice, ThermalParameters
from thermal.materials import WATER_DENSITY, WATER_VISCOSITY

MASS, RADIUS, MU_S, MU_K = 40.0, 0.04, 0.3, 0.2
PRESSURE = MASS * 9.81 / (pi * RADIUS**2)
ROUGHNESS, ETA = 3e-6, 1.79e-3
SPEEDS = np.geomspace(1e-3, 30.0, 9)


def parameters(share=1.0, roughness=ROUGHNESS, **blocks) -> Parameters:
    return Parameters(
        rig={"mass": MASS, "degrees_of_freedom": ("x",)}, springs={"stiffness": 1500.0},
        friction={"mu_s": MU_S, "mu_k": MU_K},
        mixed_lubrication={"share": share, "roughness": roughness}, **blocks,
    )  # fmt: skip


@pytest.mark.parametrize("share", [0.3, 1.0])
@pytest.mark.parametrize("film", [1e-9, 1e-6, 3e-6, 1e-4])
def test_dry_and_wet_contact_share_the_load(share, film):
    """Water of the volume h A on w A is h / w thick; the rest of the load is on dry contact."""
    found = friction_coefficient(parameters(share), SPEEDS, film_thickness=film)
    w = share * film / (film + ROUGHNESS)
    depth = film / w
    expected = (1.0 - w) * MU_K + w * ETA * SPEEDS / depth / PRESSURE
    np.testing.assert_allclose(found, expected, rtol=1e-12)


def test_limits():
    """No water: dry. Much of it, or a smooth surface: afloat, the film's own shear."""
    dry = friction_coefficient(parameters(), SPEEDS)
    np.testing.assert_array_equal(dry, friction_coefficient(parameters(0.0), SPEEDS, None, 1e-6))
    smooth = friction_coefficient(parameters(roughness=1e-9), SPEEDS, film_thickness=1e-4)
    np.testing.assert_allclose(smooth, ETA * SPEEDS / 1e-4 / PRESSURE + 1e-5 * MU_K, rtol=2e-5)
    # however thin, water in a rough contact shears with no more than eta v / s
    thin = friction_coefficient(parameters(), [1.0], film_thickness=1e-12)
    assert 0.0 < MU_K - thin[0] < 1e-6


def test_water_holds_nothing_at_rest():
    """The block breaks away where the dry part of the contact gives way."""
    film = 2e-6
    run = simulate(parameters(surface={"speed": 0.01}), 6.0, film_thickness=film)
    first = run.events[run.events[:, 1] == 1][0]
    w = film / (film + ROUGHNESS)
    assert first[2] == pytest.approx((1.0 - w) * MU_S * MASS * 9.81 / 6000.0, rel=1e-12)
    assert np.max(np.abs(run["energy_residual"])) < 1e-9 * run["heat"][-1]


def test_age_belongs_to_the_dry_part():
    """rate_and_state adds a ln(v/v*) + b ln(v* theta/D) to it, here with an age that is D / v*."""
    law = {"direct": 0.03, "reference_speed": 1e-3, "distance": 1e-3, "initial_age": 1.0}
    found = friction_coefficient(parameters(rate_and_state=law), [0.1], film_thickness=3e-6)
    water = 0.25 * ETA * 0.1 / 3e-6 / PRESSURE
    assert found[0] == pytest.approx(0.5 * (MU_K + 0.03 * np.log(100.0)) + water, rel=1e-8)


@pytest.mark.parametrize("film", [-1e-9, np.inf, np.nan])
def test_a_thickness_must_be_one(film):
    with pytest.raises(ValueError, match="film_thickness = .* at least 0 m"):
        simulate(parameters(), 1.0, film_thickness=film)


@pytest.mark.parametrize(("mass", "speed"), [(40.0, 3.0), (40.0, 0.5), (5.0, 1.0)])
def test_heat_film_and_friction_close_on_themselves(mass, speed):
    """Law and heat model hand each other joules and film, nothing conducts: the film's own limit.

    Belt and ice conduct next to nothing and start 1 mK below melting; the surface is smooth to
    1 nm. Melt rate from the heat, film from the melt rate, shear from the film, heat from the
    shear.
    """
    water = {"share": 1.0, "roughness": 1e-9}
    rig = Parameters(rig={"mass": mass}, friction=dict(mu_s=0.2, mu_k=0.2), mixed_lubrication=water)
    alone = {"conductivity": 1e-7, "air_heat_transfer": 0.0}
    contact = Contact(conductance=1e12, load=mass * 9.81, wiper=1.0)
    belt, ice = Belt(width=0.08, length=1.0, cell_length=2e-3, **alone), Ice(**alone)
    ambient = Ambient(temperature_degC=-1e-3)
    model = BeltIceModel(ThermalParameters(ambient=ambient, belt=belt, ice=ice, contact=contact))
    melting = WATER_DENSITY * Ice().latent_heat
    step = 0.02 * model.footprint.length / speed
    film = 0.0
    for _ in range(600):
        (mu,) = friction_coefficient(rig, [speed], 0.0, film)
        model.step(step, mu * mass * 9.81 * speed * step, speed * step)
        film = model.outputs()["film_thickness"]
    length, pressure = model.footprint.length, mass * 9.81 / model.footprint.area

    def excess(h):
        """Heat of friction less that of melting, W/m2 over the speed, roughness and all."""
        w = h / (h + 1e-9)
        shear = (1.0 - w) * 0.2 * pressure + w**2 * WATER_VISCOSITY * speed / h
        return shear - melting * h / length

    # 0.2 %: water laid down within a cell of the exit edge is picked up again
    assert film == pytest.approx(brentq(excess, 1e-8, 1e-4), rel=3e-3)
    # 0.7 %: the 1 nm of roughness, 0.2 % of the film
    assert film == pytest.approx(sqrt(WATER_VISCOSITY * speed * length / melting), rel=1e-2)
    stress = sqrt(WATER_VISCOSITY * speed * melting / length)
    assert mu == pytest.approx(stress / pressure, rel=1e-2)
