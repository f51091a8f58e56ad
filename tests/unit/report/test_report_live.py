"""What goes into a page: events to the last digit, few rows, nothing that ends a script early."""

import base64
import json

import numpy as np
import pytest
from stickslip.kernel.layout import P_MU_S, P_NORMAL_FORCE
from test_report_dataset import coupled_dataset, mechanics_dataset

from cosim.report.contents import mechanics_of, mode_changes
from cosim.report.figures import PLATES
from cosim.report.figures.belt_map import belt_map
from cosim.report.figures.events import through_events
from cosim.report.figures.phase_portrait import phase_portrait
from cosim.report.heat_numbers import ambient_degC
from cosim.report.live import MOST_ROWS, Curve, Panel, TimeFigure, packed, thinned
from cosim.report.page import Picture, texts

SHOWN = {plate.name: plate.show for plate in PLATES if plate.show}


def unpacked(values):
    return np.frombuffer(base64.b64decode(values["data"]), dtype=f"<{values['type']}")


@pytest.mark.parametrize("kind", ["f4", "f8", "u1"])
def test_numbers_come_back(kind):
    values = np.array([[0.0, 1.5, 2.0], [200.0, 3.0, 4.0]]).astype(kind)
    np.testing.assert_array_equal(unpacked(packed(values, kind)), values.ravel())


def test_a_long_run_keeps_its_peaks_and_events():
    time = np.linspace(0.0, 100.0, 200_001)
    curve = np.sin(time)
    curve[123_457] = 40.0
    curve[5_000:5_003] = np.nan
    keep = np.zeros(time.size, bool)
    keep[77_777::10_000] = True
    rows = thinned(time, [curve, -curve], keep)
    assert rows.size < 1.2 * MOST_ROWS
    assert np.all(np.diff(rows) > 0) and rows[0] == 0 and rows[-1] == time.size - 1
    assert 123_457 in rows and set(np.flatnonzero(keep)) <= set(rows)
    assert np.isnan(curve[rows]).any(), "the gap is still one"
    # what is left lies on the curve: half a wave has hundreds of rows
    assert np.abs(np.diff(time[rows])).max() < 0.2


def test_a_page_has_the_events_to_the_last_digit():
    dataset = mechanics_dataset()
    sent = SHOWN["motion"](dataset).live()
    time = unpacked(sent["time"])
    events = dataset["event_time"].values
    inside = events[(events > 0.0) & (events < time[-1])]
    assert set(inside) <= set(time)
    x = unpacked(sent["panels"][0]["curves"][0]["values"])[np.searchsorted(time, inside)]
    # mm, with the seven digits of a page
    np.testing.assert_allclose(x, 1e3 * dataset["event_x"].values[: inside.size], rtol=1e-6)
    assert np.all(np.diff(time) > 0.0)


def test_a_phase_plane_has_the_points_that_are_drawn():
    dataset = mechanics_dataset()
    (plane, *_), sent = phase_portrait(dataset), SHOWN["phase_portrait"](dataset)
    assert sent["planes"][0]["across"] == "x [mm]"
    for way, told in zip(plane.ways, sent["planes"][0]["ways"], strict=True):
        np.testing.assert_allclose(unpacked(told["y"]), way.y, rtol=1e-6)
        assert (told["x"] is None) == (way.x is None) == (way.label == "speed of the surface")
    joined = np.concatenate([way.x for way in plane.ways if way.x is not None])
    assert 1e-3 * joined.max() == pytest.approx(float(dataset["x"].max()), rel=0.02)


def test_a_coupled_run_locates_its_events_as_the_mechanics_alone():
    """Rows 10 ms apart; the time spent in slip tells the rest."""
    times, modes = mode_changes(coupled_dataset())
    exact, exact_modes = mode_changes(mechanics_dataset())
    np.testing.assert_array_equal(modes, exact_modes)
    np.testing.assert_allclose(times, exact, atol=1e-12)


def test_friction_reaches_its_limit_at_every_break_away():
    """Without the rows at events peaks are cut by up to a tenth, each by another part."""
    dataset = mechanics_dataset()
    rows, added = through_events(dataset)
    p = mechanics_of(dataset).pack()
    limit = p[P_MU_S] * p[P_NORMAL_FORCE]
    times, modes = mode_changes(dataset)
    at = np.searchsorted(rows["time"].values, times[1:][modes[1:] == 1.0])
    force = np.hypot(rows["friction_force_x"].values, rows["friction_force_y"].values)[at]
    # a parabola over one row of 10 ms, of a sine with a period of 0.6 s: 1e-4 of its size
    np.testing.assert_allclose(force, limit, rtol=3e-4)
    assert added.sum() == 2 * (times.size - 1)
    recorded = np.isin(rows["time"].values, dataset["time"].values)
    np.testing.assert_array_equal(rows["x"].values[recorded], dataset["x"].values)


def test_the_map_has_no_spikes_and_is_warm_behind_the_block_only():
    found = belt_map(coupled_dataset())
    last = found.rise[-1]
    ahead = (found.place - found.contact[-1]) % found.length
    below = np.minimum(ahead, found.length - ahead) < 0.5 * found.contact_length
    assert np.ptp(last[below]) == 0.0 and last[below][0] > 0.0, "the mean of the contact"
    pictures = coupled_dataset()["belt_temperature"].values - ambient_degC(coupled_dataset())
    assert last.max() < pictures[-1].max(), "whose highest is a cell half in contact"
    comes = (ahead > 0.5 * found.length) & ~below
    first = found.rise[found.rise.shape[0] // 3]
    assert np.all(np.isfinite(found.rise))
    assert last[comes].min() <= 1e-6 * last.max(), "places that the block has not been to"
    assert first.max() < last.max()


def test_a_picture_cannot_end_its_script():
    panel = Panel("</script><b> [m]", [Curve("a", np.arange(3.0), "#000")])
    sent = TimeFigure(np.arange(3.0), [panel]).live()
    parts = texts("parts.html.j2", "cosim.report", {})
    html = str(parts.figure(Picture("p", "c", bytes, live=sent), "c"))
    script = html.split('<script type="application/json">')[1].split("</script>")[0]
    assert json.loads(script)["panels"][0]["label"] == "</script><b> [m]"
