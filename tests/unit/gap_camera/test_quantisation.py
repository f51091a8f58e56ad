"""Numbers in steps: found where they are, felt where they are, and nowhere else."""

import numpy as np
import pytest
from gap_campaigns import NOISE, motion, write_campaign
from scipy.signal import fftconvolve

from cosim.gap import read_campaign
from cosim.gap.camera.filtered_noise import independent_part, seen_by_differences
from cosim.gap.camera.filters import gaussian
from cosim.gap.camera.quantisation import LEVEL, felt, find_quantisation, lattice, with_steps
from cosim.gap.data.noise import difference_noise


@pytest.fixture(scope="module")
def run():
    return motion(speed=0.1, duration=15.0)


def rounded(run, step, seed, decimals=1e-9, outliers=0):
    """Noise, then steps from a zero of the run's own, then the file's decimals."""
    draw = np.random.default_rng(seed)
    x = run["x"] + NOISE * draw.standard_normal(run.time.size)
    if step:
        x = step * np.round(x / step) + draw.normal(0.0, NOISE)
    x[draw.integers(0, x.size, outliers)] += 30.0 * NOISE * draw.standard_normal(outliers)
    return decimals * np.round(x / decimals)


def campaign_of(folder, run, step, noise=None, **more):
    tables = {"noise": {"x": noise}} if noise else {}
    runs = [
        {"surface_speed": 0.1, "columns": {"t": run.time, "x": rounded(run, step, n, **more)}}
        for n in range(2)
    ]
    return read_campaign(write_campaign(folder, runs, **tables))


@pytest.mark.parametrize("decimals", [1e-9, 1e-6])
@pytest.mark.parametrize("step", [2.37e-4, 1e-3, 3.9e-3])
def test_steps_are_found(tmp_path, run, step, decimals):
    campaign = campaign_of(tmp_path, run, step, NOISE, decimals=decimals, outliers=4)
    found = find_quantisation(campaign.runs)
    assert found.step == pytest.approx(step, rel=2e-3)
    assert found.share > 0.98 and found.p < LEVEL


@pytest.mark.parametrize("decimals", [1e-9, 1e-6, 1e-5])
def test_decimals_of_a_file_are_no_fault(tmp_path, run, decimals):
    campaign = campaign_of(tmp_path, run, 0.0, NOISE, decimals=decimals)
    assert find_quantisation(campaign.runs) is None
    for seed in range(100):
        step, _ = lattice(rounded(run, 0.0, seed, decimals=decimals))
        assert step < 1.01 * decimals


def test_a_step_is_felt_at_the_stated_level():
    """Variances of noise alone: as often beyond the smallest step that is felt as is stated."""
    samples, level = 400, 0.05
    steps = np.linspace(0.1, 3.0, 2901)
    least = next(step for step in steps if felt(step, 1.0, samples) < level)
    noise = np.random.default_rng(1).standard_normal((4000, samples))
    beyond = np.mean(np.mean(noise**2, axis=1) > 1.0 + least**2 / 12.0)
    assert beyond == pytest.approx(level, abs=0.0125)  # 3.6 standard errors


def test_noise_takes_the_rounding_in(tmp_path, run):
    stated = with_steps(campaign_of(tmp_path, run, 1e-3, NOISE), 1e-3)
    assert stated.noise["x"] == pytest.approx(np.hypot(NOISE, 1e-3 / np.sqrt(12.0)))
    assert all(each.noise["x"] == stated.noise["x"] for each in stated.runs)
    residual = rounded(run, 1e-3, 5) - run["x"]
    assert np.std(residual) == pytest.approx(stated.noise["x"], rel=0.05)
    folder = tmp_path / "estimated"
    folder.mkdir()
    estimated = campaign_of(folder, run, 1e-3)
    again = with_steps(estimated, 1e-3)
    assert again.noise["x"] == max(estimated.noise["x"], 1e-3 / np.sqrt(12.0))


def test_filtered_noise_is_underestimated_as_foretold():
    """White noise behind a Gaussian of one and of two intervals, and of none."""
    interval, width = 0.01, 0.015
    white = np.random.default_rng(2).standard_normal(200_000)
    delays, _ = gaussian(width)
    taps = np.exp(-0.5 * (np.arange(-10, 11) * interval / width) ** 2)
    assert np.abs(delays).max() < 10 * interval
    coloured = fftconvolve(white, taps, mode="valid")
    time = interval * np.arange(coloured.size)
    part = difference_noise(time, coloured) / coloured.std()
    assert part == pytest.approx(seen_by_differences(interval, width), rel=0.02)
    # variance of a mean square: 2 / degrees of freedom
    blocks = np.mean((coloured / coloured.std())[:199_000].reshape(-1, 500) ** 2, axis=1)
    free = 2.0 / np.var(blocks) / 500.0
    assert free == pytest.approx(independent_part(interval, width), rel=0.25)
    assert seen_by_differences(interval) == pytest.approx(1.0)
    assert independent_part(interval) == pytest.approx(1.0)
