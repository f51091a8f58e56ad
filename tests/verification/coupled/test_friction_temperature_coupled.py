"""Slopes of friction against speed in coupled runs: belt and ice warm, the FMU feels it.

Steady sliding by `steady_sliding`, 2 s each. In air of -8 degC and under the block's own weight
friction warms the interface by 1 to 2 mK of the 8 K that melting takes, so the slope of the
friction itself is that of the law, -1/2. Under 400 times the load the interface warms by
tenths of a kelvin, more the faster the block slides: friction then falls faster than -1/2, and what
has the slope -1/2 is friction over T_m - T. What both bodies conduct at any speed, and what melt
does not carry, are left out for these slopes, and have one of their own. The film's +1/2 does not
feel the temperature; it is taken at -1 degC, where the film governs from a tenth of a metre per
second on.
"""

import numpy as np
import pytest

from cosim import read_scenario
from cosim.studies.friction_map.map import lowest_friction, steady_sliding

COARSE = {"ice.radial_elements": 3, "ice.axial_elements": 6}
WHOLE = read_scenario("melting_friction").changed(COARSE)
LIGHT = WHOLE.changed({"asperity_melting.conductivity": 0.0, "asperity_melting.roughness": 0.0})
HEAVY = LIGHT.changed({"rig.mass": 268.0, "springs.stiffness": 8068.0})


def slide(scenario, low, high, ambient):
    points = [steady_sliding(scenario, v, ambient, 2.0) for v in np.geomspace(low, high, 4)]
    for point in points:
        assert abs(point.energy_residual) < 1e-9
    return points


def slope(points, value):
    speeds = [point.speed for point in points]
    return np.polyfit(np.log(speeds), np.log([value(point) for point in points]), 1)[0]


def friction(point):
    return point.friction


def over_warming(point):
    return point.friction / -point.interface_degC


def test_boundary_friction_falls_with_the_root_of_the_speed():
    points = slide(LIGHT, 0.016, 0.16, -8.0)
    assert slope(points, friction) == pytest.approx(-0.5, abs=0.01)
    assert max(point.interface_degC for point in points) < -7.99


def test_boundary_friction_falls_faster_where_both_bodies_conduct():
    """1/v on top of 1/sqrt(v): 8 k sqrt(l / v) / (pi C e l) of it, 0.24 to 0.07 here."""
    points = slide(WHOLE, 0.016, 0.16, -8.0)
    more = 1.0 + 8.0 * 2.7 / (np.pi * 1.128 * 2034.0) / np.sqrt(1e-2 * np.array([0.016, 0.16]))
    expected = -0.5 + np.log10(more[1] / more[0])
    assert slope(points, friction) == pytest.approx(expected, abs=0.015)


def test_hydrodynamic_friction_grows_with_the_root_of_the_speed():
    points = slide(LIGHT, 2.0, 8.0, -1.0)
    assert slope(points, friction) == pytest.approx(0.5, abs=0.01)


def test_a_heavy_block_warms_the_interface_and_falls_faster():
    points = slide(HEAVY, 0.016, 0.16, -8.0)
    assert slope(points, friction) < -0.51
    assert slope(points, over_warming) == pytest.approx(-0.5, abs=0.01)
    warming = [point.interface_degC + 8.0 for point in points]
    assert np.all(np.diff(warming) > 0.0)


def test_the_minimum_lies_where_both_regimes_meet():
    points = [steady_sliding(LIGHT, v, -8.0, 2.0) for v in (1.0, 1.6, 2.6)]
    lowest = lowest_friction([p.speed for p in points], [p.friction for p in points])
    load = 0.67 * 9.81 / (np.pi * 0.04**2 * 7e-4)
    falling = 1.128 * 2034.0 * 8.0 / (2e7 * np.sqrt(1e-2))
    rising = np.sqrt(2.0 * 1.79e-3 * 3.06e8 / 1e-2) / load
    # the interface is 10 mK warmer than the air, and the parabola's own error is 1 %
    assert lowest[0] == pytest.approx(falling / rising, rel=0.02)
    assert lowest[1] == pytest.approx(np.sqrt(2.0 * falling * rising), rel=2e-3)
