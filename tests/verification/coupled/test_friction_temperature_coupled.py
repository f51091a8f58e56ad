"""Friction against speed in coupled runs: belt and ice warm, the FMU feels it.

Steady sliding by `steady_sliding`, 2 s each. Under 400 times the block's own weight the interface
warms by tenths of a kelvin, more the faster the block slides: friction then falls faster than the
law's slope of -1/2, and what has the slope -1/2 is friction over T_m - T. What both bodies conduct
at any speed, and what melt does not carry, are left out for these slopes.
"""

import numpy as np
import pytest

from cosim import read_scenario
from cosim.studies.friction_map.map import lowest_friction, steady_sliding

COARSE = {"ice.radial_elements": 3, "ice.axial_elements": 6}
WHOLE = read_scenario("melting_friction").changed(COARSE)
LIGHT = WHOLE.changed({"asperity_melting.conductivity": 0.0, "asperity_melting.roughness": 0.0})
HEAVY = LIGHT.changed({"rig.mass": 268.0, "springs.stiffness": 8068.0})


def slope(points, value):
    speeds = [point.speed for point in points]
    return np.polyfit(np.log(speeds), np.log([value(point) for point in points]), 1)[0]


def test_a_heavy_block_warms_the_interface_and_falls_faster():
    points = [steady_sliding(HEAVY, v, -8.0, 2.0) for v in np.geomspace(0.016, 0.16, 4)]
    assert all(abs(point.energy_residual) < 1e-9 for point in points)
    assert slope(points, lambda p: p.friction) < -0.51
    assert slope(points, lambda p: p.friction / -p.interface_degC) == pytest.approx(-0.5, abs=0.01)
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
