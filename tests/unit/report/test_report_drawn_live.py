"""What a drawn figure over time gives to a page: its curves, levels, names and units."""

import numpy as np
from matplotlib.figure import Figure
from test_report_live import unpacked

from cosim.report.live import Curve, Panel, Series, panels_on_one_axis
from cosim.report.live_of_figure import live_of


def test_curves_of_other_times_share_an_axis():
    line = Curve("line", np.array([0.0, 4.0]), "#000000")
    dots = Curve("dots", np.array([5.0]), "#ff0000", dots=True)
    series = [Series(np.array([0.0, 2.0]), line), Series(np.array([1.0]), dots)]
    times, (panel,) = panels_on_one_axis([(Panel("", []), series)])
    joined, single = panel.curves
    np.testing.assert_array_equal(times, [0.0, 1.0, 2.0])
    np.testing.assert_array_equal(joined.values, [0.0, 2.0, 4.0])
    np.testing.assert_array_equal(single.values, [np.nan, 5.0, np.nan])


def drawn():
    figure = Figure(layout="constrained")
    axes = figure.subplots(2, 2, sharey="row")
    time = np.linspace(0.0, 2.0, 21)
    for column, name in enumerate(("printed", "mended")):
        axes[0, column].plot(time, time**2, color="#0072B2", label="a model")
        axes[0, column].axhline(1.5, linestyle="--", label="the study's")
        axes[1, column].plot(time[::2], -time[::2], color="#0072B2")
        axes[0, column].set_title(f"as {name}", loc="left")
        axes[0, column].set_xlim(0.0, 1.0)
        axes[1, column].set_xlim(0.0, 1.0)
    axes[0, 0].set_ylabel("x [cm]")
    axes[1, 0].set_ylabel("φ [mrad]")
    figure.draw_without_rendering()
    return figure


def test_columns_are_figures_and_rows_their_panels():
    live = live_of(drawn())
    assert [one["heading"] for one in live["figures"]] == ["as printed", "as mended"]
    for one in live["figures"]:
        upper, lower = one["panels"]
        assert [upper["label"], lower["label"]] == ["x [cm]", "φ [mrad]"]
        assert upper["levels"] == [(1.5, "the study's")] and lower["levels"] == []
        assert upper["curves"][0]["label"] == lower["curves"][0]["label"] == "a model"
        time = unpacked(one["time"])
        assert time[-1] == 1.0, "what is seen, and not more"
        np.testing.assert_allclose(unpacked(upper["curves"][0]["values"]), time**2, rtol=1e-6)
        np.testing.assert_allclose(unpacked(lower["curves"][0]["values"]), -time, rtol=1e-6)
