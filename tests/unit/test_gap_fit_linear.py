"""The fit of linear models: one right answer, known from one joint least squares.

Elimination of what belongs to runs and segments, bounds, and what is known beforehand.
"""

from dataclasses import replace

import numpy as np
import pytest
from linear_runs import FREE, joint, linear_run, trial_of
from scipy.optimize import lsq_linear
from stickslip.effects.candidate import FreeParameter

from cosim.gap.estimation.fit import fit
from cosim.gap.estimation.fitted import start
from cosim.gap.estimation.intervals import intervals
from cosim.gap.estimation.problem import Problem

SHARED = (FreeParameter("a.a", 0.0, 0.1), FreeParameter("a.b", 0.0, 3.0))
OWN = FreeParameter("a.own", 0.0, 0.2, per_run=True)


def linear(free_parameters, runs=3, rows=60, seed=3):
    random = np.random.default_rng(seed)
    return Problem(
        [linear_run(random, free_parameters, rows) for _ in range(runs)], free_parameters
    )


def check_joint(problem):
    """The fit of a linear problem beside all unknowns at once, within the same bounds."""
    found = fit(problem, start(problem.segmented_runs, problem.free_parameters))
    matrix, right = joint(problem)
    count = len(problem.shared)
    low, high = np.full(matrix.shape[1], -np.inf), np.full(matrix.shape[1], np.inf)
    low[:count] = [free_parameter.low for free_parameter in problem.shared]
    high[:count] = [free_parameter.high for free_parameter in problem.shared]
    best = lsq_linear(matrix, right, (low, high), tol=1e-12, lsq_solver="exact", method="bvls").x
    # a round leaves of a distance what its damping is, 1e-3 at first, and less in the next ones
    assert list(found.values.values()) == pytest.approx(best[:count], abs=1e-4)
    rest = best[count:]
    width = len(problem.own) + len(FREE) * 3
    for run in range(len(problem.segmented_runs)):
        part = rest[run * width : (run + 1) * width]
        assert list(found.own_values(run).values()) == pytest.approx(
            part[: len(problem.own)], abs=1e-4
        )
        states = found.point.states[run][:, FREE].ravel()
        assert states == pytest.approx(part[len(problem.own) :], abs=1e-4)
    return found


def test_elimination_is_the_joint_least_squares():
    check_joint(linear(SHARED))


def test_elimination_with_free_parameters_of_the_runs_is_the_joint_least_squares():
    check_joint(linear((*SHARED, OWN)))
    check_joint(linear((*SHARED, OWN, replace(OWN, key="a.second"))))


@pytest.mark.parametrize("prior", [1e-3, 0.1, 10.0])
def test_what_is_known_beforehand_weighs_as_one_more_measurement(prior):
    known = replace(SHARED[0], start=2.0, prior=prior)
    own = replace(OWN, start=-1.0, prior=prior)
    check_joint(linear((known, SHARED[1])))
    check_joint(linear((*SHARED, own)))
    check_joint(linear((known, SHARED[1], own)))


@pytest.mark.parametrize("high", [-0.05, 0.0, 0.02])
def test_bounds_are_kept_as_a_bounded_least_squares_keeps_them(high):
    least = replace(SHARED[0], start=high - 0.1, high=high)
    found = check_joint(linear((least, SHARED[1], OWN), seed=4))
    assert found.values["a.a"] == pytest.approx(high, abs=1e-12)


def test_two_bounds_at_once():
    low = replace(SHARED[0], start=-0.2, high=-0.1)
    high = replace(SHARED[1], start=0.2, low=0.1)
    check_joint(linear((low, high, replace(SHARED[0], key="a.c"))))


def test_a_free_parameter_that_nothing_feels_stays_where_it_is():
    problem = linear((*SHARED, FreeParameter("a.silent", 7.0, 1.0)))
    for segmented in problem.segmented_runs:
        segmented.by_key["a.silent"][:] = 0.0
    found = fit(problem, start(problem.segmented_runs, problem.free_parameters))
    without = Problem(problem.segmented_runs, SHARED)
    assert found.values["a.silent"] == pytest.approx(7.0, abs=1e-6)
    assert found.cost == pytest.approx(fit(without, start(without.segmented_runs, SHARED)).cost)


def test_a_state_that_hardly_any_row_feels_moves_little():
    problem = linear(SHARED)
    for segmented in problem.segmented_runs:
        segmented.by_state[:, 1] *= 1e-6
    found = fit(problem, start(problem.segmented_runs, SHARED))
    free = joint(problem)
    wild = np.linalg.lstsq(*free, rcond=None)[0][len(SHARED) :].reshape(-1, len(FREE))
    moved = np.abs(np.concatenate([states[:, FREE[1]] for states in found.point.states]))
    assert np.abs(wild[:, 1]).max() > 1.0 > 0.1 > moved.max()  # m/s


def half_widths(problem, found):
    """Of the intervals, in standard deviations of a normal distribution."""
    return [
        (high - low) / (2.0 * 1.96) for low, high in intervals(trial_of(problem, found)).values()
    ]


def test_intervals_of_a_linear_model_are_those_of_its_joint_least_squares():
    known = replace(SHARED[0], start=0.3, prior=0.2)
    problem = linear((known, SHARED[1], OWN))
    found = fit(problem, start(problem.segmented_runs, problem.free_parameters))
    white, segments = deviations(problem, found)
    assert half_widths(problem, found) == pytest.approx(np.maximum(white, segments), rel=1e-4)


def deviations(problem, found):
    """Standard deviations of the shared free parameters, from the matrix of all unknowns at once.

    With white noise of the residual's size, and with noise independent between segments only.
    """
    matrix, right = joint(problem)
    count, known = len(problem.shared), len(problem.shared)
    # neighbouring rows of a model that does not fit tell less, what is known beforehand does not
    scarce = matrix.copy()
    scarce[:-known] /= max(found.rms_residual(), 1.0)
    white = np.sqrt(np.diag(np.linalg.inv(scarce.T @ scarce)))[:count]
    left = right - matrix @ np.linalg.lstsq(matrix, right, rcond=None)[0]
    nobody = np.full(len(problem.own), -1)  # nothing is known beforehand of a run's own
    owner = np.concatenate(
        [
            [*(run * 3 + segmented.segment_of_rows()), *nobody]
            for run, segmented in enumerate(problem.segmented_runs)
        ]
    )
    rows = [np.flatnonzero(owner == segment) for segment in range(owner.max() + 1)]
    scores = np.array([matrix[r].T @ left[r] for r in rows])
    scatter = scores.T @ scores * len(scores) / (len(scores) - count)
    scatter += matrix[-known:].T @ matrix[-known:]
    inverse = np.linalg.inv(matrix.T @ matrix)
    return white, np.sqrt(np.diag(inverse @ scatter @ inverse))[:count]


def test_intervals_cover_what_noise_that_lingers_does_to_a_fit():
    """Noise that is one number for many rows on end: white noise would be far too sure."""
    random, inside, draws = np.random.default_rng(7), 0, 40
    for _ in range(draws):
        noise = [np.repeat(random.standard_normal(30), 20) for _ in range(3)]
        segmented_runs = [linear_run(random, SHARED, each, segments=10) for each in noise]
        for segmented in segmented_runs:
            for key in segmented.by_key:  # felt as slowly as the noise changes
                segmented.by_key[key][:] = np.repeat(random.standard_normal(30), 20)
        problem = Problem(segmented_runs, SHARED)
        found = fit(problem, start(segmented_runs, SHARED))
        inside += sum(
            low <= 0.0 <= high for low, high in intervals(trial_of(problem, found)).values()
        )
    # a share of 0.95 of 80 scatters by 0.024, and 30 segments know their own scatter to a tenth
    assert 0.86 <= inside / (2 * draws) <= 1.0


@pytest.mark.parametrize(
    "free_parameter",
    [
        FreeParameter("a.a", 0.3, 0.02, 0.1, 2.0),
        FreeParameter("a.a", 0.3, 0.5, 1e-3, 10.0, log=True),
        FreeParameter("a.a", 0.3, 0.5),
    ],
)
def test_scale_of_a_free_parameter(free_parameter):
    assert free_parameter.value(free_parameter.scaled(0.3)) == pytest.approx(0.3, rel=1e-14)
    assert free_parameter.inside(free_parameter.scaled(0.3)) == free_parameter.scaled(0.3)
    for end in (free_parameter.low, free_parameter.high):
        if np.isfinite(end):
            beyond = free_parameter.scaled(end) + (100.0 if end == free_parameter.high else -100.0)
            assert free_parameter.value(free_parameter.inside(beyond)) == pytest.approx(
                end, rel=1e-12
            )
