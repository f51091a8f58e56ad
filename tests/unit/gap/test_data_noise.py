"""Noise from the data alone, and outliers without harm to corners."""

import math

import numpy as np
import pytest
from gap_campaigns import NOISE, motion, noisy, write_campaign
from hypothesis import given, settings
from hypothesis import strategies as st

from cosim.gap import CampaignError, read_campaign
from cosim.gap.data.noise import difference_noise, without_outliers

# relative standard deviation of an estimate from n third differences: sqrt(2.3 / (2 n)), 2.3 the
# sum of the squares of their autocorrelations
DEVIATIONS = 4.5


def tolerance(samples):
    return DEVIATIONS * math.sqrt(2.3 / (2.0 * samples))


@pytest.fixture(scope="module")
def slow():
    return motion(speed=0.02)


@pytest.mark.parametrize("speed", [0.008, 0.06, 0.2])
@pytest.mark.parametrize("seed", [1, 2])
def test_noise_is_found_again(speed, seed):
    run = motion(speed=speed)
    found = difference_noise(run.time, noisy(run["x"], seed))
    assert found == pytest.approx(NOISE, rel=tolerance(2001))


@settings(max_examples=25)
@given(
    seed=st.integers(0, 2**32 - 1), jitter=st.floats(0.0, 0.004), lost=st.floats(0.0, 0.3),
    size=st.floats(1e-5, 1e-3),
)  # fmt: skip
def test_noise_with_jitter_and_lost_rows(slow, seed, jitter, lost, size):
    random = np.random.default_rng(seed)
    time = slow.time + random.uniform(-jitter, jitter, len(slow.time))
    keep = random.random(len(time)) > lost
    x = np.interp(time, slow.time, slow["x"]) + size * random.standard_normal(len(time))
    found = difference_noise(time[keep], x[keep])
    # a stretch with a lost row counts only where it is short: at the worst every third one
    assert found == pytest.approx(size, rel=tolerance(600))


@pytest.mark.parametrize("steps", [6, 14, 20])
def test_coarsely_rounded_samples_have_a_noise(steps):
    """Where most samples repeat, uneven times leave 1e-18 of their differences, and no more."""
    random = np.random.default_rng(1)
    time = 0.01 * np.arange(2400) + 0.002 * random.random(2400)
    place = 4e-3 * np.round(steps * np.sin(0.9 * time))
    assert 3e-4 < difference_noise(time, place) < 4e-3


@pytest.mark.parametrize("speed", [0.008, 0.06, 0.2])
def test_outliers_are_found_and_the_noise_is_the_same(speed):
    random = np.random.default_rng(3)
    run = motion(speed=speed)
    x = noisy(run["x"], 4)
    bad = random.random(len(x)) < 0.05
    x[bad] += random.choice([-1.0, 1.0], bad.sum()) * random.uniform(10, 100, bad.sum()) * NOISE
    kept = without_outliers(run.time, x)
    found = np.isnan(kept)
    assert np.count_nonzero(found & bad) >= 0.95 * bad.sum()
    assert np.count_nonzero(found & ~bad) <= 2
    assert difference_noise(run.time, kept) == pytest.approx(NOISE, rel=tolerance(1500))


@settings(max_examples=20)
@given(seed=st.integers(0, 2**32 - 1), size=st.sampled_from([1e-6, 1e-5, NOISE]))
def test_corners_are_no_outliers(slow, seed, size):
    """With little noise the corners are the sharpest thing in the data."""
    x = slow["x"] + size * np.random.default_rng(seed).standard_normal(len(slow.time))
    kept = without_outliers(slow.time, x)
    # of 2000 samples, each an outlier by chance once in a million
    assert np.count_nonzero(np.isnan(kept)) <= 1


def test_rows_of_outliers():
    run = motion(speed=0.06)
    x = noisy(run["x"], 5)
    x[200:202] += 0.01
    x[400:403] -= 0.02
    x[600:603] += [0.015, 0.0, -0.015]  # what lies between them is good
    kept = without_outliers(run.time, x)
    assert np.flatnonzero(np.isnan(kept)).tolist() == [200, 201, 400, 401, 402, 600, 602]


def test_runs_of_one_tracker_share_their_noise(tmp_path):
    run = motion()
    sizes = (NOISE, NOISE, 3 * NOISE)
    runs = [
        {"columns": {"t": run.time, "x": noisy(run["x"], seed, size)}}
        for seed, size in enumerate(sizes)
    ]
    together = read_campaign(write_campaign(tmp_path, runs[:2]))
    assert len({measured.noise["x"] for measured in together.runs}) == 1
    apart = read_campaign(write_campaign(tmp_path, runs))
    found = [measured.noise["x"] for measured in apart.runs]
    assert found == pytest.approx(sizes, rel=tolerance(2001))
    assert any("noise of x differs from run to run" in remark for remark in apart.remarks)


def test_noise_that_cannot_be_estimated_must_be_given(tmp_path):
    run = motion()
    stairs = {"t": run.time, "x": run["x"], "y": np.zeros(len(run.time))}
    with pytest.raises(CampaignError, match=r"column y: no noise can be estimated.*noise\.y"):
        read_campaign(write_campaign(tmp_path, [{"columns": stairs}]))
    read = read_campaign(write_campaign(tmp_path, [{"columns": stairs}], noise={"y": 1e-4}))
    assert read.runs[0].noise["y"] == 1e-4
