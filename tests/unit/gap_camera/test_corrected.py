"""What is written where a fault of the camera was named: corrected data, and no model of it."""

import tomllib
from dataclasses import replace

import faulty_cameras
import numpy as np
import pytest
from gap_answers import answer
from gap_campaigns import NOISE, motion, noisy, write_campaign

from cosim.gap import read_campaign
from cosim.gap.camera.corrected import write_corrected
from cosim.gap.show.model_file import model_text
from cosim.gap.show.words import described, fitted_quantities

NOUGHT = {"measurement.scale": 0.0, "offset.x": 1e-4, "friction.mu_k": 0.2}


@pytest.fixture(scope="module")
def motions():
    return {speed: motion(speed=speed, duration=5.0, interval=1e-3) for speed in (0.06, 0.1)}


def campaign_of(folder, motions, camera):
    runs = []
    for number, (speed, run) in enumerate(motions.items()):
        t, path = camera(run.time, np.stack([run["x"], run["y"]], axis=1))
        columns = {"t": t, "x": noisy(path[:, 0], number), "y": noisy(path[:, 1], 10 + number)}
        columns["x"][7] = np.nan
        runs.append({"surface_speed": speed, "hold_out": number == 1, "columns": columns})
    noise = {"x": NOISE}
    figures = {"surface_speed": 0.2, "summary": {"frequency": [1.7, 0.05]}}
    friction = {"mu_k": [0.2, 0.01]}
    return read_campaign(write_campaign(folder, [*runs, figures], noise=noise, friction=friction))


@pytest.mark.parametrize(
    ("camera", "numbers"),
    [
        (faulty_cameras.scale, {"scale": 0.03}),
        (faulty_cameras.clock, {"clock": 0.03}),
        (faulty_cameras.rotation, {"rotation": 0.05}),
        (faulty_cameras.steady_drift, {"drift_rate_x": 3e-4, "drift_rate_y": 3e-4}),
        (faulty_cameras.rolling_shutter, {"latency": 0.02}),
    ],
)
def test_corrected_data_are_those_of_a_good_camera(tmp_path, motions, camera, numbers):
    campaign = campaign_of(tmp_path, motions, camera)
    values = {f"measurement.{key}": value for key, value in numbers.items()}
    files = write_corrected(campaign, values, {}, tmp_path)
    assert [file.name for file in files] == ["campaign.toml", "run01.csv", "run02.csv"]
    again = read_campaign(tmp_path / "corrected")
    for before, after, run in zip(campaign.runs, again.runs, motions.values(), strict=False):
        assert (after.mass, after.hold_out) == (before.mass, before.hold_out)
        track = after.motion
        for channel in ("x", "y"):
            left = track[channel] - np.interp(
                track.time + track.time_offset, run.time, run[channel]
            )
            left = left[(track.time < 4.9) & np.isfinite(left)]
            assert left.size > 460
            # standard error of a deviation of so many samples: 3.2 %; four of them
            noise = NOISE / (1.0 + numbers.get("scale", 0.0))
            assert np.std(left) == pytest.approx(noise, rel=0.13)
            assert abs(left.mean()) < 4.0 * NOISE / np.sqrt(left.size)
    assert again.runs[2].summary == campaign.runs[2].summary
    assert again.friction == campaign.friction
    assert again.noise["x"] == pytest.approx(NOISE / (1.0 + numbers.get("scale", 0.0)))


def test_what_belongs_to_a_run_is_undone_in_it(tmp_path, motions):
    campaign = campaign_of(tmp_path, motions, faulty_cameras.perfect)
    write_corrected(campaign, {}, {"run02": {"measurement.scale": 1.0}}, tmp_path)
    again = read_campaign(tmp_path / "corrected")
    np.testing.assert_allclose(again.runs[0].motion.x, campaign.runs[0].motion.x, rtol=1e-11)
    np.testing.assert_allclose(again.runs[1].motion.x, 0.5 * campaign.runs[1].motion.x, rtol=1e-11)


def test_what_cannot_be_undone_is_left_and_said(tmp_path, motions):
    campaign = campaign_of(tmp_path, motions, faulty_cameras.gaussian)
    smoothing = {"measurement.smoothing": 0.03}
    assert write_corrected(campaign, smoothing | NOUGHT, {}, tmp_path) == []
    assert not (tmp_path / "corrected").exists()
    files = write_corrected(campaign, smoothing | {"measurement.scale": 0.03}, {}, tmp_path)
    for file in files:
        text = file.read_text(encoding="utf-8")
        assert "measurement.smoothing = 0.03 s" in text and "still in the data" in text
        assert "measurement.scale = 0.03 " in text and "undone" in text


def test_no_fault_reaches_the_model(tmp_path):
    gap = answer(tmp_path)
    faulty = {"measurement.drift_x": 1e-3, "measurement.drift_time": 2.0}
    values = {**gap.extended.values, **faulty}
    named = replace(
        gap, effects=("measurement.drift",), extended=replace(gap.extended, values=values)
    )
    text = model_text(named)
    tables = tomllib.loads(text)
    assert "measurement" not in tables and tables["friction"]["mu_k"] > 0.1
    assert "zero creeps" in described("measurement.drift") and "zero creeps" in text
    assert {one.key: one.unit for one in fitted_quantities(named)}["measurement.drift_x"] == "m"
