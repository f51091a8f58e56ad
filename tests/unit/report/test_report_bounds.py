"""A block beyond its belt or its springs, told of against answers known by hand."""

import numpy as np
import pytest
from stickslip import Parameters, Rig, Springs
from test_report_dataset import coupled_dataset, mechanics_dataset

from cosim.report import summary, write_results
from cosim.report.bounds import allowed_aside, contact_share, spring_lengths
from cosim.report.run_text import bounds_sentences

# of the scenario that the datasets are of
RADIUS, WIDE = 0.04, 0.075


def aside(dataset, farthest):
    """The run, but pushed aside evenly from 0 to `farthest` (m)."""
    moved = dataset.copy()
    moved["y"] = ("time", np.linspace(0.0, farthest, dataset.sizes["time"]), dataset["y"].attrs)
    return moved


def monte_carlo_share(y):
    """Of a disc's area on the belt, that in the middle being 1, by a fine grid of points."""
    at = (np.arange(2000) + 0.5) / 1000.0 - 1.0
    a, b = RADIUS * at[:, None], RADIUS * at[None, :]
    disc = a**2 + b**2 <= RADIUS**2
    on = [np.count_nonzero(disc & (np.abs(b + at_y) <= 0.5 * WIDE)) for at_y in (y, 0.0)]
    return on[0] / on[1]


@pytest.mark.parametrize("y", [0.0, 0.0025, 0.02, 0.0375, 0.07, 0.1])
def test_the_contact_left_is_what_counting_points_gives(y):
    # 2000 points across the disc: an edge is off by half a point's width
    assert contact_share(y, RADIUS, WIDE) == pytest.approx(monte_carlo_share(y), abs=1e-3)


@pytest.mark.parametrize(
    ("radius", "width", "allowed"),
    [(0.02, 0.075, 0.0175), (0.04, 0.075, 0.0025), (0.04, 0.08, 0.002), (0.2, 0.075, 0.0375)],
)
def test_allowed_is_where_the_rim_passes_an_edge_and_never_beyond_half_the_width(
    radius, width, allowed
):
    assert allowed_aside(radius, width) == pytest.approx(allowed)
    if allowed < 0.5 * width:  # what is not told of is next to nothing
        assert contact_share(allowed, radius, width) > 0.99


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("make", [coupled_dataset, mechanics_dataset])
def test_a_block_that_leaves_the_belt_is_told_of_with_time_and_place(make, side, tmp_path):
    dataset = aside(make(), 0.06 * side)
    found = summary(dataset)
    left, end = found["left_belt"], float(dataset["time"][-1])
    interval = float(dataset["time"][1] - dataset["time"][0])
    assert left["allowed"] == pytest.approx(0.0025)
    assert left["time"] == pytest.approx(end * 0.0025 / 0.06, abs=1.01 * interval)
    assert left["y"] * side > left["allowed"]
    assert left["farthest_y"] == pytest.approx(0.06 * side)
    assert left["centre_off_since"] == pytest.approx(end * 0.0375 / 0.06, abs=1.01 * interval)
    heated = "heat_received" in dataset
    assert left.get("heat_as_in_the_middle_since") == (left["time"] if heated else None)
    assert found["units"]["left_belt.time"] == "s"
    (said,) = bounds_sentences(found)
    assert f"t = {left['time']:.4g} s" in said and "2.5 mm" in said and "tip" in said
    assert ("heat is that of a block in the middle" in said) == heated
    write_results(dataset, tmp_path)
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "beyond the belt&#39;s edge" in page


def test_a_slab_has_a_centre_and_its_heat_a_track():
    mechanics = summary(aside(mechanics_dataset("slab"), 0.48))
    assert "left_belt" not in mechanics
    centre = mechanics["slab_centre"]
    assert centre["allowed"] == RADIUS and centre["y"] > 0.5 - 2 * RADIUS
    assert any("slab's centre" in said for said in bounds_sentences(mechanics))
    heated = summary(aside(coupled_dataset("slab"), 0.06))
    assert heated["left_belt"]["centre_off_since"] is None
    (said,) = bounds_sentences(heated)
    assert "track" in said and "block in the middle" in said


def test_springs_are_as_long_as_pythagoras_has_them():
    lengths = spring_lengths(
        Parameters(), np.array([0.0, 0.1]), np.array([0.0, 0.15]), np.array([0.0, 0.0])
    )
    # attached at 160, 20, 200, 340 degrees, anchored 0.2 m outward: those at the left are drawn out
    assert lengths[:, 0] == pytest.approx(0.2)
    assert lengths[:, 1] == pytest.approx(np.hypot([0.3, 0.1, 0.3, 0.1], 0.15))


def test_a_spring_beyond_its_length_is_told_of():
    dataset = mechanics_dataset().copy()
    dataset["x"] = dataset["x"] + 0.25
    found = summary(dataset)["overstretched"]
    assert found["allowed"] == pytest.approx(0.4) and found["longest"] > 0.44
    assert found["time"] == float(dataset["time"][0])
    assert any("spring" in said for said in bounds_sentences(summary(dataset)))


def test_a_force_curve_ends_where_it_was_measured():
    from stickslip import simulate

    from cosim.report import trajectory_columns

    parameters = Parameters(
        rig=Rig(spring_natural_length=0.19),
        springs=Springs(force_curve_extension=(0.0, 0.02), force_curve_force=(0.0, 0.4)),
    )
    dataset = trajectory_columns(simulate(parameters, 2.0, 0.01), parameters, "").to_xarray()
    found = summary(dataset)["overstretched"]
    assert found["allowed"] == pytest.approx(0.21)
    assert found["longest"] == pytest.approx(0.2 + float(dataset["x"].max()), abs=1e-4)
    assert (found["time"] is not None) == (found["longest"] > 0.21)
    assert found["time"] is not None


def test_a_ledger_that_does_not_close_is_told_of():
    """As of a block that begins at 1e30 m/s, whose energy drowns the work in its rounding."""
    dataset = mechanics_dataset()
    work = float(dataset["surface_work"][-1])
    dataset["energy_residual"] = dataset["energy_residual"] + 0.5 * work
    (said,) = bounds_sentences(summary(dataset))
    assert "ledger of the mechanics is off by 5.0e-01 of the work" in said
    dataset["energy_residual"] = 1e-4 * work + 0.0 * dataset["energy_residual"]
    assert bounds_sentences(summary(dataset)) == []
