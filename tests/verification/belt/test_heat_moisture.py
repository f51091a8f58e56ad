"""Vapour over ice against tables, and the bounds of frost against a face's own heat balance."""

import pytest
from scipy.optimize import brentq

from thermal.belt.air import frost, saturation_over_ice


@pytest.mark.parametrize(
    ("temperature", "pascal"), [(0.0, 611.15), (-8.0, 309.9), (-16.0, 150.7), (-40.0, 12.84)]
)
def test_vapour_pressure_over_ice(temperature, pascal):
    """Smithsonian Meteorological Tables."""
    assert saturation_over_ice(temperature) == pytest.approx(pascal, rel=2e-3)


def balance(face, humidity, convective, radiative, air=-8.0):
    """Heat that a frosted face (degC) loses, W/m2, from the differences of vapour density.

    Lewis' relation with the diffusivity of vapour, 1.97e-5 m2/s, and air's of heat, 1.86e-5.
    """
    density, mass = 101325.0 / (287.0 * 265.15), 461.5 * 265.15
    transfer = convective / (density * 1005.0) * (1.97e-5 / 1.86e-5) ** (2.0 / 3.0)
    vapour = (saturation_over_ice(face) - humidity * saturation_over_ice(air)) / mass
    return (convective + radiative) * (face - air) + transfer * vapour * 2.834e6


def test_frost_adds_what_a_balance_of_vapour_adds():
    bound = frost(4.0, 4.0, -8.0)
    slope = (balance(-7.95, 1.0, 4.0, 4.0) - balance(-8.05, 1.0, 4.0, 4.0)) / 0.1
    assert bound.added == pytest.approx(slope - 8.0, rel=0.1)


def test_dry_air_keeps_frost_colder():
    bound = frost(4.0, 4.0, -8.0)
    face = brentq(lambda t: balance(t, 0.8, 4.0, 4.0), -15.0, -8.0)
    assert 0.2 * bound.depression == pytest.approx(-8.0 - face, rel=0.15)
