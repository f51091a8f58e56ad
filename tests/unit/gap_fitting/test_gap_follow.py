"""What belongs to a run alone follows shared numbers that were moved."""

from dataclasses import replace

import numpy as np
import pytest
from settled_campaigns import campaign_of, prepared_of

from cosim.gap.candidates.plain import plain_free_parameters
from cosim.gap.estimation.fit import fit, fit_runs, follow, with_columns
from cosim.gap.estimation.fitted import Point, start
from cosim.gap.estimation.initial_states import with_lost_velocities
from cosim.gap.estimation.problem import Problem
from cosim.gap.evidence.alignment import LOOSELY, NEAR, loosened


@pytest.fixture(scope="module")
def problem(tmp_path_factory):
    campaign = campaign_of(tmp_path_factory.mktemp("follow"), lambda mass, speed: {}, 5)
    free = loosened(plain_free_parameters(campaign, False), NEAR)
    return Problem(prepared_of(campaign), free, {}, LOOSELY)


@pytest.fixture(scope="module")
def near(problem):
    """Laid along the data, with derivatives."""
    point = start(problem.segmented_runs, problem.free_parameters)
    return with_columns(problem, fit_runs(problem, point, 8))


def test_runs_alone_come_to_where_they_come_together(problem, near):
    point = start(problem.segmented_runs, problem.free_parameters)
    together = fit(problem, point, 8, fixed=True)
    assert near.cost == pytest.approx(together.cost, rel=5e-3)
    np.testing.assert_array_equal(near.point.shared, together.point.shared)


def test_after_a_step_the_derivatives_from_before_it_lead_on(problem, near):
    """They end where a fit with its own derivatives does, and so do the derivatives given."""
    shared = near.point.shared.copy()
    shared[1] += 1.0  # mu_k, a step of it
    moved = Point(shared, near.point.own, near.point.states)
    followed, fitted = follow(problem, moved, near.derivatives, 3), fit_runs(problem, moved, 12)
    assert followed.cost == pytest.approx(fitted.cost, rel=5e-3)
    np.testing.assert_array_equal(followed.point.shared, shared)
    fresh = with_columns(problem, followed).derivatives
    for one, other in zip(followed.derivatives, fresh, strict=True):
        scale = np.abs(other.own).max(axis=0)
        off = np.sqrt(np.mean((one.own - other.own) ** 2, axis=0)) / (scale + 1e-12)
        assert off.max() < 0.05


def test_a_segment_that_set_out_with_the_surface_is_found_again(problem, near):
    """A block that is taken to move with the surface sticks from the start, and stays so."""
    run = next(
        i
        for i, each in enumerate(problem.segmented_runs)
        if any(3 in segment.free for segment in each.segments[1:])
    )
    segmented = problem.segmented_runs[run]
    number = next(i for i, s in enumerate(segmented.segments) if i and 3 in s.free)
    states = [each.copy() for each in near.point.states]
    states[run][number, 3] = segmented.speed
    lost = replace(near.point, states=tuple(states))
    residuals = problem.all_residuals(lost)
    again = with_lost_velocities(problem, replace(near, point=lost, residuals=residuals))
    after = problem.all_residuals(again)
    before = problem.by_segment(run, residuals[run])[number]
    assert problem.by_segment(run, after[run])[number] < 0.7 * before
    assert with_lost_velocities(problem, near) is near.point
