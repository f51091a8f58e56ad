import numpy as np
import pytest

from thermal.contact import Footprint, disc_on_strip

CELL = 1e-3


def loads_by_quadrature(footprint, centre, movement, node, strip):
    """The same load by brute force: midpoints over the hat function and over the movement."""
    x = (np.arange(4000) + 0.5) / 4000 * 2 * CELL + (node - 1) * CELL
    moved = centre + movement * (np.arange(400) + 0.5) / 400
    relative = x - moved[:, None]
    low, high = footprint.edges[strip : strip + 2]
    inside = (relative >= low) & (relative < high)
    hat = 1.0 - np.abs(x / CELL - node)
    return footprint.lane * 2 * CELL * np.mean(hat * inside)


@pytest.mark.parametrize("movement", [0.0, 1e-7, 1e-5, 3.3e-3, -0.02, 0.3])
def test_closed_form_is_the_integral(movement):
    footprint = Footprint(0.04, 0.075, 4)
    centre = 0.2345678
    first, loads = footprint.loads(centre, movement, CELL)
    for strip in range(4):
        for column in range(0, loads.shape[1], 7):
            expected = loads_by_quadrature(footprint, centre, movement, first + column, strip)
            assert loads[strip, column] == pytest.approx(expected, abs=2e-3 * CELL * 0.075)


@pytest.mark.parametrize("movement", [0.0, 1e-12, 3e-7, -3.1e-7, 5e-4, -0.37])
def test_every_strip_carries_its_area(movement):
    footprint = Footprint(0.04, 0.075, 8)
    _, loads = footprint.loads(-3.21, movement, CELL)
    assert loads.sum(axis=1) == pytest.approx(footprint.area / 8, rel=1e-13)
    assert loads.min() > -1e-8 * loads.max(), "below zero by no more than rounding"


def test_a_tiny_movement_is_a_standstill_half_way():
    footprint = Footprint(0.04, 0.075, 8)
    for movement in (1e-12, 1e-9, 1e-7):
        _, still = footprint.loads(0.50031 + 0.5 * movement, 0.0, CELL)
        _, moving = footprint.loads(0.50031, movement, CELL)
        assert np.abs(moving - still).max() < footprint.lane * (movement**2 / CELL + 1e-11 * CELL)


def test_area_of_the_disc_on_the_belt():
    assert disc_on_strip(0.04, 1.0) == pytest.approx(np.pi * 0.04**2)
    x = (np.arange(200_000) + 0.5) / 200_000 * 0.08 - 0.04
    chord = np.minimum(0.075, 2 * np.sqrt(0.04**2 - x**2))
    assert disc_on_strip(0.04, 0.075) == pytest.approx(0.08 * chord.mean(), rel=1e-7)


def test_wide_belt_is_modelled_as_the_lane_under_the_disc():
    footprint = Footprint(0.04, 0.3, 1)
    assert footprint.lane == 0.08
    assert footprint.length == pytest.approx(np.pi * 0.02)
    assert footprint.arc_share(np.array([0.0, 0.02, 0.04])) == pytest.approx(1.0)
