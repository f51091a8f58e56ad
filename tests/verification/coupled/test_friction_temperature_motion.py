"""Friction that melts in motion: cycles against an independent model, the disc, the ledger.

A contact of the plane brakes each of its points by the law of that point's speed; the kernel's
quadrature over the contact is held against an adaptive one.
"""

import numpy as np
import pytest
from disc_integral import law_over_disc
from one_mass_model import HEAT, MASS, MU_K, NORMAL, SPEED, OneMass, X
from stickslip import Parameters, simulate
from stickslip.kernel.friction.force import friction_in_slip
from stickslip.kernel.layout import U_SIZE, U_TEMPERATURE, W_FRICTION, W_SIZE

RADIUS = 0.04
TIMES = np.linspace(0.0, 3.0, 301)
ASPERITY = {"length": 1e-3, "hardness": 2e7, "effusivity": 2034.0, "constant": 1.128}
CONDUCTIVITY, ROUGHNESS = 2.7, 1e-8
FILM = {"wetted_share": 5e-4, "length": 1e-3, "viscosity": 1.79e-3, "latent_heat": 3.06e8}


def friction(u, temperature, dry=MU_K):
    """Inverse squares of dry and boundary friction add, then squares with that of the film.

    Boundary friction: warming in passing, and conduction from discs of the diameter l; melt
    thinner than the roughness leaves dry friction.
    """
    passing = 1.128 * 2034.0 * -temperature / (2e7 * np.sqrt(1e-3))  # at 1 m/s
    conducted = 8.0 * CONDUCTIVITY * -temperature / (np.pi * 1e-3 * 2e7)  # at 1 m/s
    pressure = NORMAL / (5e-4 * np.pi * RADIUS**2)
    film = np.sqrt(2.0 * 1.79e-3 * 3.06e8 / 1e-3) / pressure  # at 1 m/s
    warmed = passing * np.sqrt(u) + conducted  # mu_a v
    melted = 1.0 / np.sqrt(dry**-2 + (u / warmed) ** 2)
    solid = np.exp(-2.0 * 1.79e-3 * 1e-3 * u / (3.06e8 * ROUGHNESS**2))
    return np.sqrt((melted + (dry - melted) * solid) ** 2 + film**2 * u)


@pytest.mark.parametrize("temperature", [-16.0, -8.0, -1.0])
def test_cycles_of_stick_and_slip(temperature):
    model = OneMass(kinetic=lambda sliding, s: NORMAL * friction(sliding, temperature))
    states, events = model.run(TIMES)
    run = simulate(
        Parameters(rig=dict(mass=MASS, degrees_of_freedom=("x",), spring_length=1.0,
                       spring_natural_length=1.0), springs=dict(stiffness=20.17),
                   solver=dict(tolerance=1e-13), initial={"vx": SPEED}, asperity_melting=ASPERITY,
                   melt_film=FILM),
        TIMES[-1], TIMES[1], interface_temperature=temperature,
    )  # fmt: skip
    assert len(events) > 4 and len(run.events) == len(events)
    np.testing.assert_allclose(run.events[:, 0], events[:, 0], rtol=0, atol=1e-8)
    np.testing.assert_allclose(run["x"], states[X], rtol=0, atol=1e-9)
    np.testing.assert_allclose(run["heat"], states[HEAT], rtol=0, atol=1e-9)


# of the quadrature, relative to dry friction; 3.2e-4 at most was found, at the rim's own speed
BOUND = 6.5e-4
MOTIONS = ((0.3, 0.0), (0.3, 0.1), (0.3, 0.25), (0.3, 0.3), (0.25, 0.3), (0.1, 0.3), (0.0, 0.3))


@pytest.mark.parametrize("temperature", [-16.0, -8.0, -2.0])
def test_every_point_of_the_contact_has_the_friction_of_its_speed(temperature):
    p = Parameters(
        lateral_friction={"ratio": 1.0}, asperity_melting=ASPERITY, melt_film=FILM
    ).pack()
    u, w = [0.0] * U_SIZE, [0.0] * W_SIZE
    u[U_TEMPERATURE] = temperature
    errors = []
    for sliding, spinning in MOTIONS:
        friction_in_slip(p, u, w, sliding, 0.0, spinning)
        found = -w[W_FRICTION] / NORMAL, -w[W_FRICTION + 2] / (NORMAL * RADIUS)
        expected = law_over_disc(
            lambda v: friction(v, temperature), sliding, spinning, 0.01 * BOUND * MU_K
        )
        errors.append(np.subtract(found, expected))
    assert np.max(np.abs(errors)) / MU_K < BOUND


@pytest.mark.parametrize("directions", [("x",), ("x", "y", "phi")], ids="+".join)
@pytest.mark.parametrize("temperature", [-8.0, -0.1, -1e-3, -1e-9, 0.0])
def test_the_ledger_closes_however_near_to_melting(temperature, directions):
    """Near melting all of dry friction goes within a hair of rest, and a block guided along x still
    lands on the belt; one that is free to turn passes rest at a distance, film or not."""
    case = Parameters(
        rig={"spring_natural_length": 0.17, "degrees_of_freedom": directions},
        lateral_friction={"ratio": 1.0}, asperity_melting=ASPERITY, melt_film=FILM,
        speed_ripple={"amplitude": 0.9, "frequency": 0.5},  # so that slips end
        initial={"vx": SPEED, "x": 0.01, "y": 0.005, "phi": 0.1},
    )  # fmt: skip
    run = simulate(case, 8.0, interface_temperature=temperature)
    assert run.complete
    assert len(run.slip_starts) > (2 if len(directions) == 1 or temperature == -8.0 else 0)
    assert np.max(np.abs(run["energy_residual"])) < 1e-9 * run["heat"][-1]
