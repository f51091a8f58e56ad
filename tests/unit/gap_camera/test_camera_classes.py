"""What a fault of the camera cannot be told from, derived in `measurement`: the same picture."""

import numpy as np
import pytest
from gap_campaigns import NOISE, motion, noisy, write_campaign

from cosim.gap import read_campaign
from cosim.gap.estimation.drive import SPEED_OFFSET
from cosim.gap.estimation.preparation import prepare

MU_S, MU_K = 0.3, 0.2
SPEED, STIFFNESS = 0.1, 38.5
PART = 0.03


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    dense = motion(speed=SPEED, duration=8.0)
    entry = {"surface_speed": SPEED, "columns": {"t": dense.time, "x": noisy(dense["x"], 1)}}
    folder = tmp_path_factory.mktemp("campaign")
    campaign = read_campaign(write_campaign(folder, [entry], noise={"x": NOISE}))
    return prepare(campaign, campaign.runs, False)[0]


def x_of(run, mu_part=1.0, **more):
    values = {"friction.mu_s": mu_part * MU_S, "friction.mu_k": mu_part * MU_K}
    values |= {key.replace("__", "."): value for key, value in more.items()}
    return run.places(values, run.starts)[:, 0]


def apart(a, b):
    """Largest difference in units of the noise; both are integrated to a thousandth of it."""
    return np.abs(a - b).max() / NOISE


def test_scale_is_a_faster_surface_with_more_friction(run):
    scaled = x_of(run, measurement__scale=PART)
    faster = x_of(run, 1.0 + PART, **{SPEED_OFFSET: PART})
    assert apart(scaled, faster) < 0.05
    assert apart(scaled, x_of(run, 1.0 + PART)) > 2.0  # a surface that keeps its set-point tells


def test_clock_is_a_slower_surface_on_softer_springs(run):
    longer = x_of(run, measurement__clock=PART)
    slow = {SPEED_OFFSET: 1.0 / (1.0 + PART) - 1.0}
    soft = {"springs.stiffness": STIFFNESS / (1.0 + PART) ** 2}
    other = x_of(run, (1.0 + PART) ** -2, **slow, **soft)
    assert apart(longer, other) < 0.05
    for alone in (slow, soft):
        mu_part = (1.0 + PART) ** -2 if alone is soft else 1.0
        assert apart(longer, x_of(run, mu_part, **alone)) > 2.0


def test_scale_is_no_wrong_spring(run):
    scaled = x_of(run, measurement__scale=PART)
    softer = {"springs.stiffness": STIFFNESS / (1.0 + PART)}
    assert apart(scaled, x_of(run, **softer)) > 2.0


def test_a_slow_drift_is_friction_that_grows_by_an_amount(run):
    """Of mu_s and mu_k alike: the same motion about a place that moves by m g / (4 k) as much."""
    rate = 1e-4
    drifting = x_of(run, measurement__drift_rate_x=rate)
    ends = [segment.last - 1 for segment in run.segments]
    per_mu = 0.87 * 9.81 / (4.0 * STIFFNESS)
    for segment, end in zip(run.segments, ends, strict=True):
        middle = 0.5 * (run.time[segment.first] + run.time[end])
        more = rate * middle / per_mu
        values = {"friction.mu_s": MU_S + more, "friction.mu_k": MU_K + more}
        rougher = run.places(values, run.starts)[:, 0]
        rows = slice(segment.first, segment.last)
        # within a segment the drift goes on by half its length times the rate
        reach = rate * 0.5 * (run.time[end] - run.time[segment.first])
        assert np.abs(drifting - rougher)[rows].max() < 4.0 * reach
        if middle > 0.5 * run.time[-1]:
            assert np.abs(drifting - x_of(run))[rows].max() > 4.0 * reach
