"""The FMU beside data of a camera with a fault: its motion, and the camera's picture of it."""

from dataclasses import replace

import faulty_cameras
import gap_answers
import numpy as np
import pytest
from gap_campaigns import NOISE, motion, noisy, write_campaign
from stickslip.effects.candidate import FreeParameter

from cosim.fmu.build import own_fmu
from cosim.gap import read_campaign
from cosim.gap.show.reproduction import reproduce

CAMERAS = {
    "clock": (faulty_cameras.clock, 0.01, 0.002),
    "latency": (faulty_cameras.rolling_shutter, 0.01, 0.001),
    "smoothing": (faulty_cameras.gaussian, 0.02, 0.002),
}


@pytest.mark.parametrize("fault", CAMERAS)
def test_fmu_is_seen_through_the_camera(tmp_path, fault):
    camera, start, step = CAMERAS[fault]
    runs = []
    for number, speed in enumerate(gap_answers.SPEEDS[1:]):
        run = motion(speed=speed, duration=6.0, interval=1e-3)
        t, path = camera(run.time, np.stack([run["x"], run["y"]], axis=1))
        columns = {"t": t, "x": noisy(path[:, 0], number)}
        runs.append({"surface_speed": speed, "hold_out": number == 1, "columns": columns})
    campaign = read_campaign(write_campaign(tmp_path, runs, noise={"x": NOISE}))
    other = tmp_path / "other"
    other.mkdir()
    free = FreeParameter(f"measurement.{fault}", start, step, -0.2, 0.2)
    gap = replace(
        gap_answers.answer(other),
        campaign=campaign,
        plain=gap_answers.fitted(campaign, gap_answers.PLAIN),
        extended=gap_answers.fitted(campaign, (*gap_answers.PLAIN, free)),
    )
    for run in gap.model.runs:
        reproduced = reproduce(gap, run, own_fmu())
        assert reproduced.gap < 1.15  # of 160 samples or more: one in a hundred of noise is beyond
        assert reproduced.apart < 0.01
