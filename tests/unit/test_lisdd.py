"""The F-test that the gap workflow is compared with: its level, its choice, its regression form."""

import numpy as np
import pytest
from lisdd.method import Regression, discover, f_test, flagged_regimes
from lisdd.problem import (
    GRAVITY,
    TERMS,
    campaign,
    measured,
    of_size,
    regression,
    size,
    weights,
    write,
)
from scipy.stats import kstest, ttest_ind

from cosim.gap import read_campaign


def linear(random, strength=0.0, local=True, n=200):
    """One known column, two terms, four regimes; the first term acts in the last regime only."""
    x = random.uniform(0.0, 1.0, n)
    regime = np.minimum((4 * x).astype(int), 3)
    library = {"square": x**2, "root": np.sqrt(x)}
    acts = (regime == 3) if local else np.ones(n, bool)
    y = 2.0 + strength * library["square"] * acts + random.normal(size=n)
    return Regression(y, np.ones((n, 1)), library, regime)


def test_p_is_uniform_where_nothing_is_missing():
    random = np.random.default_rng(1)
    p = [discover(linear(random), random).p for _ in range(400)]
    assert kstest(p, "uniform").pvalue > 0.01
    # the same that knows its choice from the very samples it tests is not
    greedy = []
    for _ in range(400):
        data = linear(random)
        everywhere = np.ones(len(data.y), bool)
        greedy.append(min(f_test(data, everywhere, term) for term in data.library))
    assert np.mean(np.array(greedy) < 0.05) > np.mean(np.array(p) < 0.05)


def test_a_term_is_found_where_it_acts():
    random = np.random.default_rng(2)
    answers = [discover(linear(random, 6.0), random) for _ in range(40)]
    assert np.mean([each.p < 0.05 for each in answers]) > 0.95
    assert np.mean([each.flagged == (3,) for each in answers]) > 0.8
    assert flagged_regimes(linear(random, 20.0, local=True)) == (3,)


def test_f_test_of_a_step_is_the_t_test():
    random = np.random.default_rng(3)
    group = np.arange(30) < 12
    y = random.normal(size=30)
    data = Regression(y, np.ones((30, 1)), {"step": np.ones(30)}, np.zeros(30, int))
    t_test = ttest_ind(y[group], y[~group])
    assert f_test(data, group, "step") == pytest.approx(t_test.pvalue)


def test_averages_of_an_oscillation_are_exact():
    t, omega = np.arange(60) / 100.0, 10.0
    x = np.cos(omega * t + 0.3)
    weight, slope, bend = weights(60)
    assert bend @ x == pytest.approx(-(omega**2) * (weight @ x), rel=1e-5)
    assert -slope @ x == pytest.approx(weight @ (-omega * np.sin(omega * t + 0.3)), rel=1e-5)


def test_noise_of_the_regression_has_one_standard_deviation():
    random = np.random.default_rng(4)
    clean = campaign(random)
    left = []
    for _ in range(30):
        data = regression(measured(clean, random))
        mu = np.linalg.lstsq(data.physics, data.y, rcond=None)[0]
        left.append(np.sum((data.y - data.physics @ mu) ** 2) / (len(data.y) - 1))
    assert np.mean(left) == pytest.approx(1.0, abs=0.08)
    assert mu == pytest.approx(0.12, rel=0.05)
    data = regression(clean)
    assert np.abs(data.y - 0.12 * data.physics[:, 0]).max() < 0.1  # bias, in standard deviations


@pytest.mark.parametrize("term", TERMS)
def test_the_true_term_makes_up_for_what_is_missing(term):
    runs = of_size(np.random.default_rng(5), term, 5.0)
    assert size(runs) == pytest.approx(5.0, rel=0.02)
    data = regression(runs)
    left = {}
    for name, column in data.library.items():
        columns = np.column_stack([data.physics, column])
        residual = data.y - columns @ np.linalg.lstsq(columns, data.y, rcond=None)[0]
        left[name] = residual @ residual
    assert min(left, key=left.__getitem__) == term
    plain = data.y - data.physics @ np.linalg.lstsq(data.physics, data.y, rcond=None)[0]
    assert left[term] < 0.05 * (plain @ plain)


def test_the_product_reads_the_campaign(tmp_path):
    runs = measured(campaign(np.random.default_rng(6)), np.random.default_rng(7))
    write(runs, tmp_path)
    read = read_campaign(tmp_path)
    assert [run.mass for run in read.runs] == [run.mass for run in runs]
    assert len(read.held_out_runs) == 2
    rest = 0.12 * runs[0].mass * GRAVITY / (4 * read.runs[0].stiffness)
    assert np.mean(runs[0].x) == pytest.approx(rest, rel=0.05)
