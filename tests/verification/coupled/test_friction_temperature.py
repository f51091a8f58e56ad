"""Friction from temperature against closed forms: linear, asperities that melt, a film of melt.

The formulas are worked out here once more, from conduction and shear.
"""

from math import pi, sqrt

import numpy as np
import pytest
from scipy.integrate import dblquad, solve_ivp
from stickslip import Parameters, friction_coefficient, simulate
from stickslip.kernel.friction.coefficient import holding_coefficient, local_coefficient
from stickslip.kernel.layout import U_SIZE, U_TEMPERATURE, W_SIZE

MASS, RADIUS, DRY, COLD = 0.67, 0.04, 0.5, -8.0
ASPERITY = {"length": 4e-3, "hardness": 1.6e7, "effusivity": 2034.0}
ASPERITY |= {"conductivity": 0.0, "roughness": 0.0}  # what passes, alone
FILM = {"wetted_share": 2e-3, "length": 6e-3, "viscosity": 1.79e-3, "latent_heat": 3.06e8}
PRESSURE = MASS * 9.81 / (FILM["wetted_share"] * pi * RADIUS**2)
SPEEDS = np.geomspace(1e-7, 1e3, 41)


def parameters(**effects) -> Parameters:
    return Parameters(friction={"mu_s": DRY, "mu_k": DRY}, **effects)


def law(temperature=COLD, speeds=SPEEDS, **effects):
    return friction_coefficient(parameters(**effects), speeds, temperature)


def film(speed):
    """Mean shear stress of a film that the shear thickens while it is slid over, by pressure.

    A place sheared for the time t has melted by eta v^2 / h = rho L dh/dt; from a film too thin
    to matter, over the time that the patch takes to pass.
    """
    eta, melting, length = FILM["viscosity"], FILM["latent_heat"], FILM["length"]
    thickness = sqrt(2.0 * eta * speed * length / melting)  # scale of the numbers
    start, atol = [1e-8 * thickness, 0.0], [1e-12 * thickness, 1e-12 * PRESSURE * length / speed]
    grown = solve_ivp(
        lambda t, y: [eta * speed**2 / (melting * y[0]), eta * speed / y[0]],
        (0.0, length / speed), start, "DOP853", rtol=1e-11, atol=atol,
    )  # fmt: skip
    assert grown.success
    return grown.y[1, -1] / (length / speed) / PRESSURE


def test_ice_on_rock_is_linear_up_to_the_melting_point():
    """0.52 at -20 degC and 0.02 at melting, as measured at 100 kPa (McCarthy et al., 2017)."""
    rock = Parameters(
        friction={"mu_s": 0.6, "mu_k": 0.52},
        temperature_dependence={"sensitivity": (1.0 - 0.02 / 0.52) / 20.0, "reference_degC": -20.0},
    )
    for temperature, expected in ((-20.0, 0.52), (-10.0, 0.27), (-4.0, 0.12), (0.0, 0.02)):
        assert friction_coefficient(rock, [0.1], temperature) == pytest.approx(expected, rel=1e-13)
    assert friction_coefficient(rock, [0.1], 3.0) == pytest.approx(0.02, rel=1e-13)


@pytest.mark.parametrize("temperature", [-14.0, -8.0, -2.0, 0.0, 4.0])
def test_static_friction_is_linear_as_well(temperature):
    """Seen in where the belt has carried a block when it breaks away."""
    sticky = Parameters(
        rig={"degrees_of_freedom": ("x",)}, friction={"mu_s": 0.3, "mu_k": 0.05},
        temperature_dependence={"static_sensitivity": 0.06}, initial={"vx": 0.15},
    )  # fmt: skip
    run = simulate(sticky, 3.0, interface_temperature=temperature)
    expected = 0.3 * (1.0 - 0.06 * (min(temperature, 0.0) + 8.0))
    first_slip = run.events[run.events[:, 1] == 1][0]
    assert first_slip[2] == pytest.approx(expected * MASS * 9.81 / (4.0 * 20.17), rel=1e-12)


def mean_over_square(peclet):
    """Flash temperature of a square of side 2 b that moves over a half-space, as T k / (q b).

    A point source's rise exp(-P (r - x)) / (2 pi k r), P = v b / (2 alpha), b = 1 (Jaeger 1942),
    integrated over the square and averaged over it: weighted by how often a distance occurs.
    """

    def weighted(y, x):
        r = np.hypot(x, y)
        both_ways = np.exp(-peclet * (r - x)) + np.exp(-peclet * (r + x))
        return (2.0 - x) * (2.0 - y) * both_ways / r

    total = dblquad(weighted, 0.0, 2.0, 0.0, lambda x: x, epsabs=1e-9)[0]
    total += dblquad(weighted, 0.0, 2.0, lambda x: x, 2.0, epsabs=1e-9)[0]
    return 2.0 * total / (8.0 * np.pi)


@pytest.mark.parametrize("peclet, within", [(100.0, 0.025), (1000.0, 0.01)])
def test_the_flash_temperature_of_an_asperity_is_the_melting_point(peclet, within):
    """With the friction of the law, uniform flux: T + flash = 0 degC, less what leaves sideways."""
    conductivity, diffusivity, half = 2.2, (2.2 / 2034.0) ** 2, 0.5 * ASPERITY["length"]
    speed = 2.0 * diffusivity * peclet / half
    (mu,) = law(speeds=[speed], asperity_melting=ASPERITY | {"constant": 1.329})
    boundary = 1.0 / sqrt(mu**-2 - DRY**-2)
    flux = boundary * ASPERITY["hardness"] * speed
    flash = mean_over_square(peclet) * flux * half / conductivity
    assert COLD + flash == pytest.approx(0.0, abs=within * -COLD)


def test_a_film_of_melt_is_sheared():
    """At the melting point nothing else is left of friction."""
    found = law(0.0, melt_film=FILM, asperity_melting=ASPERITY)
    for at in range(0, len(SPEEDS), 8):
        # the film begins at 1e-8 of its thickness
        assert found[at] == pytest.approx(film(SPEEDS[at]), rel=1e-6)


@pytest.mark.parametrize("temperature", [-20.0, -1.0, -1e-3, -1e-11, -1e-160, 0.0, 2.0])
def test_the_limit_of_no_speed_is_dry_and_what_is_at_rest_holds(temperature):
    p = parameters(asperity_melting=ASPERITY, melt_film=FILM).pack()
    u, w = [0.0] * U_SIZE, [0.0] * W_SIZE
    u[U_TEMPERATURE] = temperature
    melting = temperature > -1e-12  # none is left where ice melts
    expected = 0.0 if melting else DRY
    assert local_coefficient(p, u, w, DRY, 0.0) == pytest.approx(expected, rel=1e-15)
    assert holding_coefficient(p, u, w) == pytest.approx(DRY, rel=1e-15)
    for speed in SPEEDS:
        assert np.isfinite(local_coefficient(p, u, w, DRY, speed))


@pytest.mark.parametrize("temperature", [-1e-11, 0.0, 2.0])
def test_melting_ice_keeps_dry_friction_at_rest(temperature):
    """mu_k of 0.5 at no speed, as in the cold, where mu_s is 0.5, too; the defaults are rough."""
    found = law(temperature, [1e-9], asperity_melting={"length": 1e-2})
    assert found == pytest.approx(DRY, rel=1e-4)
    assert law(temperature, [1.0], asperity_melting={"length": 1e-2}) < 1e-6


def test_a_speed_must_be_one():
    with pytest.raises(ValueError, match="speed = -1 m/s"):
        friction_coefficient(Parameters(), [0.1, -1.0])
