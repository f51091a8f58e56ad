"""Sticks and their corners against the exact events of the model."""

import math

import numpy as np
import pytest
from gap_campaigns import KNOWN, NOISE, motion, noisy, write_campaign
from hypothesis import given, settings
from hypothesis import strategies as st

from cosim.gap import read_campaign
from cosim.gap.data import Track, cycle_features, find_sticks

OMEGA = {mass: math.sqrt(4.0 * KNOWN["stiffness"] / mass) for mass in (0.87, 1.5)}


def true_sticks(run):
    """(k, 2) start and end; a stick at the start or the end of the run reaches to its edge."""
    edges = [(run.time[0], run["mode"][0])] + [(time, mode) for time, mode, _ in run.events]
    edges.append((run.time[-1], 1.0))
    pairs = zip(edges, edges[1:], strict=False)
    found = [(a, b) for (a, mode), (b, _) in pairs if mode == 0.0 and b - a > 1e-6]
    return np.array(found).reshape(-1, 2)


def matched(sticks, truth):
    """(found, true) for each stick that overlaps a true one."""
    for stick in sticks:
        overlap = np.minimum(stick.end, truth[:, 1]) - np.maximum(stick.start, truth[:, 0])
        if overlap.max() > 0.0:
            yield stick, truth[np.argmax(overlap)]


def corner_errors(sticks, truth):
    """Errors of the corners that were seen, s, and the same in their standard deviations."""
    errors, deviations = [], []
    for stick, (start, end) in matched(sticks, truth):
        for at, true, sd in ((stick.start, start, stick.start_sd), (stick.end, end, stick.end_sd)):
            if math.isfinite(sd):
                errors.append(at - true)
                deviations.append(errors[-1] / sd)
    return np.array(errors), np.array(deviations)


CASES = [(0.87, 0.008), (1.5, 0.008), (0.87, 0.04), (1.5, 0.06), (0.87, 0.08), (1.5, 0.12)]


@pytest.mark.parametrize(("mass", "speed"), CASES)
def test_sticks_and_corners(mass, speed):
    run = motion(mass=mass, speed=speed)
    truth = true_sticks(run)
    sticks = find_sticks(Track(run.time, noisy(run["x"], 1)), speed, OMEGA[mass], NOISE)
    pairs = list(matched(sticks, truth))
    # the last stick may have begun less than its shortest visible length before the end
    assert len(truth) - 1 <= len(pairs) == len(sticks) <= len(truth)
    errors, deviations = corner_errors(sticks, truth)
    # samples are 10 ms apart; the noise of 0.2 mm leaves about 3 ms
    assert np.median(np.abs(errors)) < 4e-3
    # the standard deviations are those of the errors, but for a few corners of short sticks
    assert np.median(np.abs(deviations)) == pytest.approx(0.67, rel=0.5)
    assert np.mean(np.abs(deviations) < 4.0) > 0.9


@pytest.mark.parametrize("speed", [0.2, 0.4])
def test_no_stick_is_made_up(speed):
    """The belt is faster than the block ever gets."""
    run = motion(speed=speed)
    assert len(run.events) <= 1
    for seed in range(5):
        sticks = find_sticks(Track(run.time, noisy(run["x"], seed)), speed, OMEGA[0.87], NOISE)
        assert sticks == ()


@settings(max_examples=15, deadline=None, derandomize=True)
@given(seed=st.integers(0, 2**32 - 1), backwards=st.booleans())
def test_gaps_jitter_and_a_belt_that_runs_backwards(slow_belt, seed, backwards):
    random = np.random.default_rng(seed)
    sign = -1.0 if backwards else 1.0
    time = slow_belt.time + random.uniform(-0.003, 0.003, len(slow_belt.time))
    x = sign * (np.interp(time, slow_belt.time, slow_belt["x"]) + NOISE * random.normal(size=2001))
    x[random.random(len(x)) < 0.1] = np.nan
    keep = np.ones(len(time), dtype=bool)
    for first in random.integers(0, 1900, 3):
        keep[first : first + 30] = False  # 0.3 s
    track = Track(time[keep], x[keep])
    truth = true_sticks(slow_belt)
    sticks = find_sticks(track, sign * 0.04, OMEGA[0.87], NOISE)
    assert len(truth) - 6 <= len(sticks) <= len(truth) + 3
    for stick in sticks:
        assert track.time[stick.first] >= stick.start - 1e-9
        assert track.time[stick.last] <= stick.end + 1e-9
    errors, _ = corner_errors(sticks, truth)
    assert np.median(np.abs(errors)) < 5e-3


@pytest.fixture(scope="module")
def slow_belt():
    return motion(speed=0.04)


def test_dense_samples():
    """2 kHz: averaged for the partition, but not for the corners."""
    run = motion(speed=0.02, duration=6.0, interval=5e-4)
    truth = true_sticks(run)
    sticks = find_sticks(Track(run.time, noisy(run["x"], 1)), 0.02, OMEGA[0.87], NOISE)
    assert len(list(matched(sticks, truth))) == len(sticks) == len(truth)
    errors, deviations = corner_errors(sticks, truth)
    assert np.median(np.abs(errors)) < 1e-3 and np.mean(np.abs(deviations) < 4.0) > 0.9


def test_creep_does_not_tear_a_stick():
    """A block that lags behind by a few per cent of the surface's way."""
    run = motion(speed=0.01)
    truth = true_sticks(run)
    x = run["x"].copy()
    for start, end in truth:
        inside = (run.time >= start) & (run.time <= end)
        x[inside] -= 0.1 * 0.01 * (run.time[inside] - start) ** 2 / (end - start)
    sticks = find_sticks(Track(run.time, noisy(x, 2)), 0.01, OMEGA[0.87], NOISE)
    assert abs(len(sticks) - len(truth)) <= 1


def test_features_of_cycles(tmp_path):
    run = motion(speed=0.04, mass=1.5)
    columns = {"t": run.time, "x": noisy(run["x"], 1), "y": noisy(run["y"], 2)}
    entry = {"columns": columns, "mass": 1.5, "surface_speed": 0.04}
    measured = read_campaign(write_campaign(tmp_path, [entry])).runs[0]
    found = cycle_features(measured)
    sticks = true_sticks(run)[1:-1]  # from the second on the motion repeats itself
    breaks = run.events[run.events[:, 1] == 1.0][2:]
    landings = run.events[run.events[:, 1] == 0.0][2:]
    late = (run.time >= breaks[0, 0]) & (run.time <= breaks[-1, 0])
    period = np.diff(breaks[:, 0]).mean()
    stick = np.mean(sticks[:, 1] - sticks[:, 0])
    truth = {
        "break_away_x": breaks[:, 2].mean(),
        "restick_x": landings[:, 2].mean(),
        "stick_duration": stick,
        "slip_duration": period - stick,
        "frequency": 1.0 / period,
        "slip_share": 1.0 - stick / period,
        "mean_x": np.trapezoid(run["x"][late], run.time[late]) / np.ptp(run.time[late]),
        "mean_y": 0.0,
        "stick_speed": 0.04,
    }
    for name, value in truth.items():
        figure = getattr(found, name)
        # standard errors of some twenty cycles; the first cycle is another one
        assert abs(figure.value - value) < 5.0 * figure.error + 1e-3 * abs(value), name
    # the largest and the smallest of 70 noisy samples are about two deviations outside
    half_range = 0.5 * np.ptp(run["x"][late])
    assert half_range < found.amplitude_x.value < half_range + 2.5 * NOISE


def test_features_without_sticks(tmp_path):
    run = motion(speed=0.2)
    columns = {"t": run.time, "x": noisy(run["x"], 1)}
    entry = {"columns": columns, "surface_speed": 0.2}
    found = cycle_features(read_campaign(write_campaign(tmp_path, [entry])).runs[0])
    assert math.isnan(found.break_away_x.value) and math.isnan(found.mean_y.value)
    assert found.slip_share.value == 1.0
    assert found.frequency.value == pytest.approx(OMEGA[0.87] / (2.0 * math.pi), rel=2e-3)
