"""The ice alone against closed forms of the cylinder."""

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import j0, j1

from thermal import Ice
from thermal.ice.cylinder import Cylinder

A, HEIGHT = 0.04, 0.10
K, RHO, C = 2.2, 917.0, 2050.0
ALPHA, EFFUSIVITY = K / (RHO * C), np.sqrt(K * RHO * C)


def cylinder(radial=6, axial=10, h=0.0, **other):
    """Of the default's ice."""
    elements = {"radial_elements": radial, "axial_elements": axial}
    return Cylinder(Ice(air_heat_transfer=h, **elements), A, **other)


@pytest.mark.parametrize(("t", "error"), [(1e-3, 6e-3), (1e-2, 2e-3), (1.0, 5e-4), (30.0, 5e-4)])
def test_semi_infinite_body_under_constant_flux(t, error):
    """T = 2 q sqrt(t / pi) / e with the default mesh; at 1 ms heat is 0.03 mm deep."""
    ice = cylinder()
    ice.advance(t, 1e3 * np.pi * A**2)
    assert ice.face() == pytest.approx(2e3 * np.sqrt(t / np.pi) / EFFUSIVITY, rel=error)


def test_slowest_rate_of_the_cooled_cylinder():
    """Side: x J1(x) = Bi J0(x); height, insulated below: y tan y = h H/k."""
    h = 50.0
    x = brentq(lambda s: s * j1(s) - h * A / K * j0(s), 1e-6, 2.4)
    y = brentq(lambda s: s * np.tan(s) - h * HEIGHT / K, 1e-6, 1.57)
    exact = ALPHA * ((x / A) ** 2 + (y / HEIGHT) ** 2)
    assert cylinder(h=h).rates[0] == pytest.approx(exact, rel=1e-4)


def test_constant_flux_is_exact_in_time():
    results = []
    for steps in (1, 7, 1000):
        ice = cylinder(h=10.0)
        air = sum(ice.advance(30.0 / steps, 5.0) for _ in range(steps))
        results.append(np.append(ice.field().ravel(), [air, ice.heat()]))
    assert results[1] == pytest.approx(results[0], rel=1e-10, abs=1e-12)
    assert results[2] == pytest.approx(results[0], rel=1e-10, abs=1e-12)


def test_flux_enters_only_where_the_belt_is():
    """Half the face covered, as seen around the axis: the rim stays colder than the centre."""
    ice = cylinder(radial=24, arc_share=lambda r: np.where(r < 0.02, 1.0, 0.0), touching=0.02)
    ice.advance(1.0, 5.0)
    bottom = ice.field()[:, 0]
    exact = 2 * 5.0 / (np.pi * 0.02**2) * np.sqrt(1.0 / np.pi) / EFFUSIVITY
    assert bottom[0] == pytest.approx(exact, rel=0.01)
    assert abs(bottom[-1]) < 0.01 * exact
