"""Sticks of a fifth of a period: their slope is found whatever is stated, or nothing is said."""

from dataclasses import replace

import numpy as np
import pytest
from gap_campaigns import NOISE, motion, noisy, write_campaign

from cosim.gap import read_campaign
from cosim.gap.doubts import doubts_of
from cosim.gap.doubts.short_sticks import short_slope
from cosim.gap.doubts.stick_speed import stick_slope

#: Sticks last 2 (mu_s - mu_k) g / (omega^2 V), 0.23 and 0.19 of a period; the third never sticks.
SPEEDS = (0.10, 0.12, 0.3)


@pytest.fixture(scope="module")
def campaign(tmp_path_factory):
    runs = []
    for number, speed in enumerate(SPEEDS):
        more = {"initial": {"x": 0.03}} if speed == SPEEDS[-1] else {}
        done = motion(speed=speed, duration=12.0, **more)
        columns = {"t": done.time, "x": noisy(done["x"], number)}
        runs.append({"surface_speed": speed, "columns": columns})
    folder = tmp_path_factory.mktemp("fast")
    return read_campaign(write_campaign(folder, runs, noise={"x": NOISE}))


@pytest.mark.parametrize("stated", [1.0, 1.25, 0.8])
def test_the_surface_s_speed_is_read_off_short_sticks(stated, campaign):
    for run, speed in zip(campaign.runs[:2], SPEEDS, strict=False):
        assert stick_slope(run) is None
        found = short_slope(replace(run, surface_speed=stated * speed))
        # standard errors; and a part of the curved ends that a cut may take for stick
        assert abs(found.value - speed) < 5.0 * found.error + 0.01 * speed
        assert found.error < 0.0224 * speed  # what a set-point and a sheared contact may be off


def test_where_nothing_sticks_nothing_is_said(campaign):
    assert short_slope(campaign.runs[2]) is None


def test_the_run_with_a_wrong_set_point_is_named_and_no_other(campaign):
    assert doubts_of(campaign) == ()
    for place, stated in ((0, 1.25), (1, 0.8)):
        runs = list(campaign.runs)
        runs[place] = replace(runs[place], surface_speed=stated * SPEEDS[place])
        (doubt,) = doubts_of(replace(campaign, runs=tuple(runs)))
        assert (doubt.check, doubt.run) == ("stick_speed", runs[place].name)
        assert doubt.figure == pytest.approx(SPEEDS[place], rel=0.05) and doubt.decisive


def test_a_belt_that_runs_the_other_way_is_no_slower(campaign):
    run = campaign.runs[0]
    turned = replace(run.track, x=-run.track.x)
    back = short_slope(replace(run, track=turned, surface_speed=-run.surface_speed))
    assert back.value == pytest.approx(short_slope(run).value, rel=1e-6)
    assert np.isfinite(back.error)
