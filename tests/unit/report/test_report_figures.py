"""Figures: every axis labelled with its unit, nothing hidden, whatever there is to draw."""

import io

import matplotlib
import numpy as np
import pytest
import xarray as xr
from matplotlib.text import Text
from test_report_dataset import coupled_dataset, mechanics_dataset, scenario

from cosim.report.figures import PLATES, plates_of
from cosim.report.figures.over_time import zoom_of
from cosim.report.figures.top_view import Pose, anchors, attachments, box_of, extreme_poses
from cosim.report.palette import readable

SMALLEST_TYPE = 9.0
THERMAL = {"temperatures", "melting", "belt_temperature"}


def cut_short(make):
    dataset = make().isel(
        {"time": slice(0, 1), "snapshot_time": slice(0, 1)}, missing_dims="ignore"
    )
    dataset.attrs.update(status="failed", reason="the integrator gave up")
    return dataset


def with_gaps(make):
    dataset = make().copy(deep=True)
    for name in dataset.data_vars:
        if dataset[name].dims == ("time",) and dataset[name].dtype.kind == "f":
            dataset[name][100:110] = np.nan
            dataset[name][-1] = np.nan
    return dataset


def wet(dataset):
    """As if it had melted: a film and a mass that grow."""
    grown = dataset["time"].values
    return dataset.copy(deep=True).assign(
        film_thickness=("time", 1e-7 * grown), melted_mass=("time", 1e-4 * grown)
    )


DATASETS = {
    "coupled": coupled_dataset,
    "mechanics": mechanics_dataset,
    "slab": lambda: coupled_dataset("slab"),
    "melting": lambda: wet(coupled_dataset()),
    "one row": lambda: cut_short(coupled_dataset),
    "one row of mechanics": lambda: cut_short(mechanics_dataset),
    "gaps": lambda: with_gaps(coupled_dataset),
}
#: Figures in which these differ from the coupled run on a belt.
DIFFERENT = {"slab": {"top_view", "belt_temperature"}, "melting": {"temperatures", "melting"}}
CASES = [
    pytest.param(make, plate, id=f"{name}-{plate.name}")
    for name, make in DATASETS.items()
    for plate in PLATES
    if not (plate.name in THERMAL and "mechanics" in name)
    and plate.name in DIFFERENT.get(name, {plate.name})
]


def shown_label(axes, axis: str) -> str:
    """The label of an axis, or that of the one it shares its ticks with."""
    siblings = getattr(axes, f"get_shared_{axis}_axes")().get_siblings(axes)
    labels = [getattr(other, f"get_{axis}label")() for other in siblings]
    return next((label for label in labels if label), "")


@pytest.mark.parametrize(("make", "plate"), CASES)
def test_axes_are_labelled_with_units_and_drawn_in_full(make, plate):
    figure = plate.drawn(make())
    figure.savefig(io.BytesIO(), format="png", dpi=40)
    for axes in figure.axes:
        for axis in ("x", "y"):
            if axes.get_label() == "<colorbar>" and axis == "x":
                continue  # as narrow as its colours
            label = shown_label(axes, axis) or row_label(figure, axes)
            assert label.rstrip().endswith("]"), (axis, label)
            assert getattr(axes, f"{axis}axis").get_offset_text().get_text() == ""
        assert np.all(np.isfinite([*axes.get_xlim(), *axes.get_ylim()]))
    for text in figure.findobj(Text):
        if text.get_text() and text.get_visible():
            assert text.get_fontsize() >= SMALLEST_TYPE, text.get_text()
    for legend in figure.legends:
        box = legend.get_window_extent()
        assert figure.bbox.x0 <= box.x0 and box.x1 <= figure.bbox.x1, plate.name


def row_label(figure, axes) -> str:
    """The label of the panel at the left of the same row, where panels have their own scales."""
    spec = axes.get_subplotspec()
    places = ((other, other.get_subplotspec()) for other in figure.axes)
    same_row = (other for other, its in places if its and its.rowspan == spec.rowspan)
    return next(same_row).get_ylabel()


def test_thermal_figures_only_where_there_is_heat_to_show():
    everything = {plate.name for plate in plates_of(wet(coupled_dataset()))}
    assert everything == {plate.name for plate in PLATES}
    alone = {plate.name for plate in plates_of(mechanics_dataset())}
    assert everything - alone == THERMAL
    assert plates_of(mechanics_dataset().isel(time=slice(0, 0))) == []


def test_house_style_whatever_the_users_settings():
    with matplotlib.rc_context({"font.size": 30.0, "axes.formatter.useoffset": True}):
        figure = PLATES[0].drawn(mechanics_dataset())
        assert figure.axes[0].yaxis.label.get_fontsize() == 10.0
        assert matplotlib.rcParams["font.size"] == 30.0


def test_zoom_holds_whole_cycles_of_the_end():
    dataset = mechanics_dataset()
    zoom = zoom_of(dataset)
    starts = dataset["event_time"].values[dataset["event_mode"].values == 1]
    assert zoom.end == float(dataset["time"][-1]) and "stick-slip" in zoom.title
    assert 2 <= np.count_nonzero(starts > zoom.begin) <= 5
    assert zoom.end - zoom.begin <= 0.3 * zoom.end


def test_zoom_finds_cycles_that_ended_long_ago_and_vibrations_without_any():
    dataset = mechanics_dataset()
    rest = dataset.isel(time=[-1] * 1000).assign_coords(time=6.0 + 0.1 * np.arange(1, 1001))
    rest["time"].attrs = dataset["time"].attrs
    parts = [each.drop_dims("event_time") for each in (dataset, rest)]
    longer = xr.concat(parts, "time", combine_attrs="override")
    zoom = zoom_of(longer)
    assert zoom.end < 10.0 and "stick-slip" in zoom.title
    still = longer.assign(slip_count=0 * longer["slip_count"])
    assert zoom_of(still).end == float(longer["time"][-1])
    assert zoom_of(still.isel(time=slice(0, 1))) is None


@pytest.mark.parametrize(("largest", "unit", "expected"), [
    (0.034, "m", (1e3, "mm")),
    (3.75, "m", (1.0, "m")),
    (0.055, "K", (1e3, "mK")),
    (4e-5, "K", (1e6, "µK")),
    (1500.0, "W", (1e-3, "kW")),
    (0.0, "J", (1.0, "J")),
    (0.2, "1", (1.0, "1")),
])  # fmt: skip
def test_prefix_makes_one_to_a_thousand(largest, unit, expected):
    scaled = readable(np.array([0.0, -largest, np.nan]), unit)
    assert (pytest.approx(scaled.factor), scaled.unit) == expected


def test_geometry_of_the_top_view_is_that_of_the_rig():
    parameters = scenario().mechanics
    fixed, at_rest = anchors(parameters), attachments(parameters, Pose(0.0, 0.0, 0.0))
    np.testing.assert_allclose(np.hypot(*(fixed - at_rest).T), parameters.rig.spring_length)
    np.testing.assert_allclose(np.hypot(*at_rest.T), parameters.rig.attachment_radius)
    turned = attachments(parameters, Pose(0.01, -0.02, np.pi / 2.0))
    expected = np.column_stack([0.01 - at_rest[:, 1], -0.02 + at_rest[:, 0]])
    np.testing.assert_allclose(turned, expected, atol=1e-15)


def test_extreme_positions_are_those_of_the_run():
    dataset = coupled_dataset("slab")
    poses = [pose for _, pose in extreme_poses(dataset)]
    assert abs(poses[1].x) == pytest.approx(float(np.abs(dataset["x"]).max()))
    assert abs(poses[-1].phi) == pytest.approx(float(np.abs(dataset["phi"]).max()))


def test_the_rig_from_above_fills_its_picture():
    """There was as much blank above and below the belt as it is wide."""
    parameters = scenario().mechanics
    *_, low, high = box_of(parameters, [Pose(0.0, 0.0, 0.0)])
    assert high - low < 2.5 * parameters.rig.contact_radius
