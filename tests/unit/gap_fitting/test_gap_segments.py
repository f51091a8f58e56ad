"""Segments of a run: how long a cycle is, and what of a state is free at their beginning."""

from dataclasses import replace

import numpy as np
import pytest
from gap_campaigns import NOISE, motion, noisy, write_campaign

from cosim.gap import read_campaign
from cosim.gap.candidates.plain import moves_across, plain_free_parameters
from cosim.gap.estimation.preparation import period, prepare, prepared
from cosim.gap.estimation.trial import Model, coarse_fit, try_model


@pytest.fixture(scope="module")
def aside():
    """A block pulled aside, with friction along x only: it swings across while it sticks."""
    return motion(speed=0.03, duration=20.0, initial={"y": 3e-3})


def campaign_of(folder, track, seed=1):
    columns = {"t": track.time, "x": noisy(track["x"], seed), "y": noisy(track["y"], seed + 1)}
    runs = [{"surface_speed": 0.03, "columns": columns}]
    return read_campaign(write_campaign(folder, runs, noise={"x": NOISE, "y": NOISE}))


def test_a_block_that_sticks_along_x_may_swing_across(aside, tmp_path):
    campaign = campaign_of(tmp_path, aside)
    assert moves_across(campaign)
    (segmented,) = prepare(campaign, campaign.fit_runs, True)
    held = [w for w in segmented.segments if np.isfinite(w.hold_since)]
    assert held
    for segment in held:
        # how the block was put down turned, nobody has seen
        assert set(segment.free) == ({0, 1, 4} if segment.first else {0, 1, 2, 4})
        true = np.interp(segmented.time[segment.first], aside.time, aside["vy"])
        assert segment.state[4] == pytest.approx(true, abs=5e-3)  # a parabola through 13 samples


def test_where_turning_is_measured_every_segment_sets_out_from_what_was_seen(aside, tmp_path):
    columns = {"t": aside.time} | {name: aside[name] for name in ("x", "y", "phi")}
    noise = {"x": NOISE, "y": NOISE, "phi": 1e-3}
    folder = write_campaign(tmp_path, [{"surface_speed": 0.03, "columns": columns}], noise=noise)
    campaign = read_campaign(folder)
    (segmented,) = prepare(campaign, campaign.fit_runs, True)
    assert len(segmented.segments) > 3 and np.ptp(aside["phi"]) > 0.015
    for segment in segmented.segments:
        assert {1, 2, 4, 5} <= set(segment.free)
        true = aside["phi"][np.searchsorted(aside.time, segmented.time[segment.first])]
        assert segment.state[2] == pytest.approx(true, abs=2e-3)


@pytest.mark.parametrize(("zero", "moves"), [(6.0, False), (12.0, True)])
def test_a_zero_of_the_tracker_is_no_motion_across(tmp_path, zero, moves):
    track = motion(speed=0.03, duration=10.0)
    y = noisy(zero * NOISE + np.zeros_like(track.time), 2)
    columns = {"t": track.time, "x": noisy(track["x"], 1), "y": y}
    runs = [{"surface_speed": 0.03, "columns": columns}]
    campaign = read_campaign(write_campaign(tmp_path, runs, noise={"x": NOISE, "y": NOISE}))
    # a zero has a standard deviation of 3 of the noise, unless said otherwise
    assert moves_across(campaign) is moves


def test_the_plain_model_fits_a_plain_block_that_swings_across(aside, tmp_path):
    campaign = campaign_of(tmp_path, aside)
    data = prepared(campaign, campaign.fit_runs, (), True)
    model = Model(plain_free_parameters(campaign, True), {})
    trial = try_model(data, model, coarse_fit(data, model, 4))
    # 4000 rows: their noise alone has a root mean square of 1 +- 0.011
    assert trial.rms_residual == pytest.approx(1.0, abs=0.05)


@pytest.mark.parametrize("kept", [slice(None), slice(None, None, 3), slice(0, 5)])
def test_a_period_is_the_motion_s_own_whichever_sticks_were_recognised(tmp_path, kept):
    track = motion(speed=0.06, duration=20.0)
    campaign = campaign_of(tmp_path, track)
    (run,) = campaign.fit_runs
    held = np.diff(track["mode"]) < 0  # from slip to stick
    true = float(np.median(np.diff(track.time[1:][held])))
    # a line of a spectrum of 20 s is so wide
    assert period(replace(run, sticks=run.sticks[kept])) == pytest.approx(true, rel=true / 20.0)
