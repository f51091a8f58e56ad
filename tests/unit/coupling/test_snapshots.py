import io

import numpy as np
import pytest
from PIL import Image

from cosim.coupling.case.snapshots import MOST_VIEWS, Snapshots
from cosim.report.figures.animation import LASTS, animation
from thermal import Belt, BeltIceModel, ThermalParameters


def coarse():
    return BeltIceModel(ThermalParameters(belt=Belt(cell_length=0.02, elements=2)))


@pytest.fixture
def model():
    return coarse()


def run(model, snapshots, steps, power=1.0):
    for n in steps:
        snapshots(0.1 * n)
        model.step(0.1, 0.1 * power, 0.03)


def test_views_are_kept_when_asked_for(model):
    without, with_views = Snapshots(model, 0.5), Snapshots(model, 0.5, views=True)
    run(model, without, range(10))
    assert without.views == []
    run(model, with_views, range(11))
    assert [time for time, _ in with_views.views] == pytest.approx([0.0, 0.5, 1.0])
    _, last = with_views.views[-1]
    assert last.belt.shape == (last.offset.size, last.depth.size) == (51, 5)
    assert last.ice.shape == (last.x.size, last.height.size)
    assert last.offset[[0, -1]] == pytest.approx([-0.5, 0.5])
    assert abs(last.offset[np.argmax(last.belt[:, 0])]) < 0.06, "warmest at the contact"
    assert last.contact == pytest.approx(model.footprint.length)


def test_a_long_run_keeps_views_evenly_spread(model):
    snapshots = Snapshots(model, 0.1, views=True)
    for n in range(3 * MOST_VIEWS):
        snapshots(0.1 * n)
    times = np.array([time for time, _ in snapshots.views])
    assert MOST_VIEWS // 3 < times.size <= MOST_VIEWS
    assert np.ptp(np.diff(times)) < 1e-9
    assert times[-1] > 0.99 * 0.1 * (3 * MOST_VIEWS - 8)


def same(found, expected):
    for name in ("time", "temperature", "contact", "position"):
        np.testing.assert_array_equal(getattr(found, name), getattr(expected, name))
    assert found.contact_length == expected.contact_length
    assert [time for time, _ in found.views] == [time for time, _ in expected.views]
    for (_, one), (_, other) in zip(found.views, expected.views, strict=True):
        for part, its in zip(one, other, strict=True):
            np.testing.assert_array_equal(part, its)


@pytest.mark.parametrize("cut", [0, 17])
def test_pictures_go_on_where_they_were_saved(tmp_path, monkeypatch, cut):
    """Saved after `cut` states, cut off at 30 and resumed from there, as if nothing was."""
    monkeypatch.setattr("cosim.coupling.case.snapshots.MOST_VIEWS", 8)

    def pictures(name, model):
        (tmp_path / name / "fields").mkdir(parents=True, exist_ok=True)
        fields = tmp_path / name / "fields"
        return Snapshots(model, 0.2, fields, views=True, store=tmp_path / name)

    through, model = coarse(), coarse()
    whole, cut_off = pictures("whole", through), pictures("cut off", model)
    run(through, whole, range(40))
    run(model, cut_off, range(cut))
    saved, state = cut_off.save_state(), model.state()
    run(model, cut_off, range(cut, 30))
    model = coarse()
    again = pictures("cut off", model)
    model.restore(state)
    again.load_state(saved)
    run(model, again, range(cut, 40))
    same(again, whole)
    found, expected = (
        {file.name: file.read_bytes() for file in (tmp_path / name / "fields").iterdir()}
        for name in ("cut off", "whole")
    )
    assert found == expected


def frames(data):
    image = Image.open(io.BytesIO(data))
    assert image.format == "GIF"
    shown = []
    for number in range(image.n_frames):
        image.seek(number)
        shown.append(np.asarray(image.convert("RGB"), dtype=float))
    return shown, image.info["duration"]


def test_an_animation_shows_how_it_gets_warmer(model):
    snapshots = Snapshots(model, 1.0, views=True)
    run(model, snapshots, range(31), power=5.0)
    shown, duration = frames(animation(snapshots.views, -8.0, "case"))
    assert len(shown) == 4
    assert duration <= 1000.0 * LASTS / 3
    size = shown[0].shape
    assert all(frame.shape == size for frame in shown)
    # the middle of the belt's picture: from black towards the bright end of the map
    row, columns = int(0.8 * size[0]), slice(int(0.40 * size[1]), int(0.50 * size[1]))
    brightness = [frame[row, columns].mean() for frame in shown]
    assert np.all(np.diff(brightness) > 1.0)
    assert shown[0][-3:, -3:].mean() > 250.0, "white paper"
