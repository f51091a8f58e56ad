"""The boundary layer of a moving belt, integrated here, against the constants in use."""

import numpy as np
import pytest
from scipy.integrate import solve_bvp

from thermal import Ice
from thermal.belt.air import SAKIADIS_AIR, NotLaminar, moving_belt


def nusselt(prandtl):
    """-theta'(0) of the similarity equations, and -f''(0)."""

    def slopes(eta, y):
        f, df, ddf, theta, dtheta = y
        return np.stack((df, ddf, -0.5 * f * ddf, dtheta, -0.5 * prandtl * f * dtheta))

    def ends(a, b):
        return np.array([a[0], a[1] - 1.0, a[3] - 1.0, b[1], b[3]])

    eta = np.linspace(0.0, 40.0, 400)
    decaying = np.exp(-0.7 * eta)
    guess = np.stack(
        (1.6 * (1.0 - decaying), decaying, -0.44 * decaying, decaying, -0.4 * decaying)
    )
    found = solve_bvp(slopes, ends, eta, guess, tol=1e-8, max_nodes=20000)
    assert found.success
    return -found.y[4, 0], -found.y[2, 0]


def test_constant_of_sakiadis_flow():
    air, friction = nusselt(0.7)
    assert air == pytest.approx(SAKIADIS_AIR, abs=2e-4)
    assert friction == pytest.approx(0.44375, abs=1e-4)
    assert nusselt(1.0)[0] == pytest.approx(friction, abs=1e-6), "Reynolds' analogy"


def test_without_buoyancy_and_radiation_it_is_sakiadis():
    speed, span = 5.0, 0.5
    still = moving_belt(0.0, span, rise=0.0)
    forced = moving_belt(speed, span, rise=0.0) - still
    viscosity, conductivity = 1.26e-5, 0.0235  # of air at -8 degC
    expected = 2.0 * 0.3492 * np.sqrt(speed * span / viscosity) * conductivity / span
    assert forced == pytest.approx(expected, rel=0.01)


def test_turbulent_belts_are_refused():
    """Flow along a moving surface was found laminar up to Re_x = 5e5 (Tsou et al. 1967)."""
    viscosity = 1.26e-5  # of air at -8 degC, m2/s
    moving_belt(0.98 * 5e5 * viscosity, 1.0)
    with pytest.raises(NotLaminar, match="laminar, up to 500000"):
        moving_belt(1.02 * 5e5 * viscosity, 1.0)


def fukusako(t):
    """Properties of ice Ih at t (degC), -180 to 0: fits to many measurements.

    Fukusako 1990, International Journal of Thermophysics 11, 353-372.
    """
    return {
        "density": 917.0 * (1.0 - 1.17e-4 * t),
        "heat_capacity": 185.0 + 6.89 * (t + 273.15),
        "conductivity": 1.16 * (1.91 - 8.66e-3 * t + 2.97e-5 * t**2),
    }


@pytest.mark.parametrize("temperature", [-16.0, -8.0, -1.0])
def test_the_ice_of_a_temperature_is_that_of_another_review(temperature):
    """Yen's fits (CRREL 81-10, 1981) beside Fukusako's: conductivities at most 6.5 % apart."""
    ice, other, kelvin = Ice.at(temperature), fukusako(temperature), temperature + 273.15
    assert ice.conductivity == pytest.approx(9.828 * np.exp(-0.0057 * kelvin))
    assert ice.heat_capacity == pytest.approx(152.5 + 7.122 * kelvin)
    assert ice.heat_capacity == pytest.approx(other["heat_capacity"], rel=0.02)
    assert ice.conductivity == pytest.approx(other["conductivity"], rel=0.07)
    assert ice.density == pytest.approx(other["density"], rel=3e-3)
