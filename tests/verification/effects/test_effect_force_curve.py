"""A tabulated force-length curve: a linear table is the spring, energy is force integrated."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import fixed_quad
from scipy.interpolate import PchipInterpolator
from stickslip import Parameters, simulate
from stickslip.kernel.rig.springs import curve_energy, curve_force

CURVED = (
    (-0.06, -0.03, -0.01, 0.0, 0.02, 0.03, 0.07, 0.10),
    (-1.5, -0.5, -0.25, 0.0, 0.35, 0.35, 1.6, 4.0),
)


def packed(extension, force) -> list[float]:
    return Parameters(
        springs={"force_curve_extension": extension, "force_curve_force": force}
    ).pack()


@pytest.mark.parametrize("count", [2, 5, 16])
def test_a_linear_table_is_the_linear_spring(count):
    table = np.linspace(-0.08, 0.09, count)
    p = packed(tuple(table), tuple(20.17 * table))
    for extension in np.linspace(-0.3, 0.3, 61):
        assert curve_force(p, extension) == pytest.approx(20.17 * extension, abs=1e-14)
    curve = {"force_curve_extension": tuple(table), "force_curve_force": tuple(20.17 * table)}
    planar = {
        "lateral_friction": {"ratio": 1.0},
        "rig": {"spring_natural_length": 0.17},
        "initial": {"x": 0.01, "y": 0.005, "phi": 0.2, "vx": 0.05},
    }
    planar["solver"] = {"tolerance": 1e-13}
    linear = simulate(Parameters(**planar), 0.4)
    tabulated = simulate(Parameters(springs=curve, **planar), 0.4)
    for name in ("x", "y", "phi", "vx", "heat"):
        np.testing.assert_allclose(tabulated[name], linear[name], rtol=0, atol=1e-12)


grids = st.lists(st.floats(0.002, 0.05), min_size=1, max_size=15)


def drawn(spans, draw):
    """A curve that does not fall: extensions, forces, and the kernel's parameters."""
    extension = np.cumsum([-0.1, *spans])
    force = np.cumsum([-1.0, *(draw.choice([0.0, draw.uniform(0.0, 3.0)]) for _ in spans)])
    return extension, force, packed(tuple(extension), tuple(force))


@given(grids, st.randoms(use_true_random=False))
def test_energy_is_the_integral_of_the_force(spans, draw):
    extension, _, p = drawn(spans, draw)
    for end in (-0.2, draw.uniform(-0.1, extension[-1]), 0.25):
        between = [value for value in extension if min(end, -0.1) < value < max(end, -0.1)]
        edges = [-0.1, *between, end]
        # piece by piece a cubic, which Gauss's rule with five points integrates exactly
        integral = sum(
            fixed_quad(lambda es: [curve_force(p, e) for e in es], a, b, n=5)[0]
            for a, b in pairwise(edges)
        )
        assert curve_energy(p, end) - curve_energy(p, -0.1) == pytest.approx(integral, abs=1e-11)


@given(grids, st.randoms(use_true_random=False))
def test_it_passes_its_points_and_never_falls(spans, draw):
    extension, force, p = drawn(spans, draw)
    at_points = [curve_force(p, e) for e in extension]
    np.testing.assert_allclose(at_points, force, rtol=0, atol=1e-12)
    along = [curve_force(p, e) for e in np.linspace(-0.15, extension[-1] + 0.05, 400)]
    assert np.all(np.diff(along) >= -1e-12)


def test_inner_pieces_are_scipys_monotone_cubic():
    """The slopes at inner points are Fritsch and Butland's there as well; the ends differ."""
    p, peer = packed(*CURVED), PchipInterpolator(*CURVED)
    for extension in np.linspace(CURVED[0][1], CURVED[0][-2], 200):
        assert curve_force(p, extension) == pytest.approx(float(peer(extension)), abs=1e-13)


def test_it_goes_on_straight_beyond_its_ends():
    p = packed(*CURVED)
    for end, outward in ((CURVED[0][0], -0.01), (CURVED[0][-1], 0.01)):
        steps = [curve_force(p, end + i * outward) for i in range(4)]
        np.testing.assert_allclose(np.diff(steps, n=2), 0.0, atol=1e-13)
        just_inside = (curve_force(p, end) - curve_force(p, end - 1e-7 * outward)) / 1e-7
        assert just_inside == pytest.approx(steps[1] - steps[0], rel=1e-4)
