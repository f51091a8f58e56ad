"""The belt alone against closed forms of the slab, with the order of convergence of its elements.

Slab of thickness d, conductivity k, diffusivity alpha, effusivity e; z from the heated face.
"""

import numpy as np
import pytest
from scipy.fft import rfft

from thermal import Belt
from thermal.belt.material_frame import CONTACT, BeltField

D, K, RHO, C = 1e-3, 0.5, 700.0, 840.0
ALPHA = K / (RHO * C)
LANE = 0.075
ORDER_OF_P2_IN_L2 = 3
# The graded meshes are similar only in the limit of many elements.
ASYMPTOTIC = 0.25


def slab(elements=6, h=0.0, cells=8, length=1.0):
    """A belt of the default's material."""
    size = {"length": length, "cell_length": length / cells, "elements": elements}
    return BeltField(Belt(air_heat_transfer=h, **size), LANE)


def uniform_flux(belt, flux):
    """Load of a flux (W/m2) over the whole contact face."""
    return {CONTACT: rfft(np.full(belt.cells, flux * LANE * belt.cell))}


def orders(sizes, errors):
    return np.diff(np.log(errors)) / np.diff(np.log(sizes))


def between_nodes(belt, values, points):
    """P2 interpolation of nodal values (depths,) at points (m)."""
    nodes = belt.depth
    element = np.clip(np.searchsorted(nodes[::2], points, side="right") - 1, 0, nodes.size // 2 - 1)
    left, right = nodes[2 * element], nodes[2 * element + 2]
    s = (points - left) / (right - left)
    left, middle, right = (values[2 * element + k] for k in range(3))
    return left * (1 - s) * (1 - 2 * s) + middle * 4 * s * (1 - s) + right * s * (2 * s - 1)


def test_finite_slab_under_constant_flux_and_order_in_l2():
    """Both faces insulated: T = q t/(rho c d) + (q d/k) [(3 (1-z/d)^2 - 1)/6 - series]."""
    flux, t = 1e3, 0.2
    points = (np.arange(4000) + 0.5) / 4000 * D
    n = np.arange(1, 60)[:, None]
    wave = n * np.pi / D
    decayed = np.exp(-ALPHA * wave**2 * t) * 2 / (n * np.pi) ** 2
    series = np.sum(decayed * np.cos(wave * points), axis=0)
    exact = flux * t / (RHO * C * D) + flux * D / K * ((3 * (1 - points / D) ** 2 - 1) / 6 - series)
    sizes, errors = [], []
    for elements in (3, 6, 12, 24):
        belt = slab(elements)
        belt.advance(t, uniform_flux(belt, flux))
        error = between_nodes(belt, belt.field()[0], points) - exact
        sizes.append(1 / elements)
        errors.append(np.sqrt(np.mean(error**2)) / np.sqrt(np.mean(exact**2)))
    assert errors[1] < 1e-3
    assert orders(sizes, errors)[-1] == pytest.approx(ORDER_OF_P2_IN_L2, abs=ASYMPTOTIC)


def test_constant_flux_is_exact_in_time():
    fields = []
    for steps in (1, 7, 1000):
        belt = slab(h=15.0)
        load = uniform_flux(belt, 1e3)
        air = sum(belt.advance(2.0 / steps, load) for _ in range(steps))
        fields.append(np.append(belt.field().ravel(), air))
    assert fields[1] == pytest.approx(fields[0], rel=1e-12)
    assert fields[2] == pytest.approx(fields[0], rel=1e-11)
