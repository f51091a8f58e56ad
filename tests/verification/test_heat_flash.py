"""Flash temperatures against integrals over the square, and the hottest strip of the contact."""

import numpy as np
import pytest
from scipy.integrate import dblquad

from thermal import Belt, BeltIceModel, Layer, ThermalParameters
from thermal.flash import STANDING_SQUARE, asperity_flash, moving_response, standing_response

#: Greenwood's interpolation between standing and fast.
INTERPOLATED = 0.06
K, CAPACITY, HALF = 2.2, 917.0 * 2050.0, 1e-4


def mean_over_square(peclet):
    """T k/(q b): a point source's rise exp(-P (r - x))/(2 pi k r), P = v b/(2 alpha), b = 1.

    Mean over the square of the integral over the square: weighted by how often a distance occurs.
    """
    def weighted(y, x):
        r = np.hypot(x, y)
        both_ways = np.exp(-peclet * (r - x)) + np.exp(-peclet * (r + x))
        return (2.0 - x) * (2.0 - y) * both_ways / r

    total = dblquad(weighted, 0.0, 2.0, 0.0, lambda x: x, epsabs=1e-9)[0]
    total += dblquad(weighted, 0.0, 2.0, lambda x: x, 2.0, epsabs=1e-9)[0]
    return 2.0 * total / (4.0 * 2.0 * np.pi)


def test_standing_square():
    assert mean_over_square(0.0) == pytest.approx(STANDING_SQUARE, rel=1e-4)
    assert standing_response(HALF, K) == pytest.approx(STANDING_SQUARE * HALF / K)


@pytest.mark.parametrize("peclet", [0.03, 0.3, 1.0, 3.0, 10.0, 30.0])
def test_moving_square(peclet):
    speed = 2.0 * peclet * K / CAPACITY / HALF
    found = moving_response(HALF, speed, K, CAPACITY) * K / HALF
    assert found == pytest.approx(mean_over_square(peclet), rel=INTERPOLATED)


def test_both_sides_of_an_asperity_are_as_warm():
    parameters = ThermalParameters()
    flash = asperity_flash(parameters, 1e-4, 1e7, 0.05, 0.5)
    flux = 0.05 * 1e7 * 0.5
    of_belt = flux * flash.belt_share * standing_response(1e-4, 0.5)
    of_ice = flux * (1.0 - flash.belt_share) * moving_response(1e-4, 0.5, 2.2, CAPACITY)
    assert of_belt == pytest.approx(of_ice) == pytest.approx(flash.excess)
    assert asperity_flash(parameters, 1e-4, 1e7, 0.05, 0.0).excess == 0.0


def test_the_first_layer_holds_the_grain():
    grit = Layer(thickness=3e-4, density=2600.0, heat_capacity=780.0, conductivity=5.0)
    cloth = Layer(thickness=7e-4, density=500.0, heat_capacity=1300.0, conductivity=0.12)
    better = asperity_flash(
        ThermalParameters(belt=Belt(layers=(grit, cloth))), 1e-4, 1e7, 0.05, 0.5)
    assert better.excess < asperity_flash(ThermalParameters(), 1e-4, 1e7, 0.05, 0.5).excess


@pytest.mark.parametrize(("arguments", "says"), [
    ((0.0, 1e7, 0.1, 0.1), "half_side = 0"), ((1e-4, -1.0, 0.1, 0.1), "pressure = -1"),
    ((1e-4, 1e7, -0.1, 0.1), "friction = -0.1"), ((1e-4, 1e7, 0.1, np.inf), "speed = inf")])
def test_what_cannot_be_is_refused(arguments, says):
    with pytest.raises(ValueError, match=says):
        asperity_flash(ThermalParameters(), *arguments)


def test_hottest_strip_lies_above_the_mean_and_behind():
    """The belt warms on its way under the ice: by 2 q sqrt(t/pi)/e while it is deep enough."""
    model = BeltIceModel(ThermalParameters(belt=Belt(length=2.0)))
    for _ in range(40):
        model.step(0.01, 4.0 * 0.5 * 0.01, 0.005)
    outputs = model.outputs()
    mean, flash = outputs["interface_temperature"], outputs["flash_temperature"]
    assert mean < flash < mean + 0.5 * (outputs["belt_exit_temperature"] + 8.0)
