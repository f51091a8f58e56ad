"""Segments thrown off course: they neither lead a fit nor stay where the model sticks at once."""

import numpy as np
import pytest
from gap_campaigns import motion, noisy, write_campaign
from stickslip.effects.candidate import FreeParameter

from cosim.gap import read_campaign
from cosim.gap.estimation.columns import Columns
from cosim.gap.estimation.fit import fit
from cosim.gap.estimation.fitted import Point, start
from cosim.gap.estimation.initial_states import with_lost_segments_found, with_velocities
from cosim.gap.estimation.phases import with_phases, with_phases_followed
from cosim.gap.estimation.preparation import SHORT_CYCLES, prepare, prepared
from cosim.gap.estimation.problem import Problem
from cosim.gap.estimation.segmented_run import LOST

SPEED, PHASE = 0.1, 130.0
FREE_PARAMETERS = (
    FreeParameter("friction.mu_s", 0.3, 0.01, 0.0, 2.0),
    FreeParameter("friction.mu_k", 0.2, 0.01, 0.0, 2.0),
    FreeParameter("surface_pattern.phase_deg", 0.0, 30.0, per_run=True),
)
PATTERN = {"surface_pattern.amplitude": 0.1, "surface_pattern.wavelength": 0.05}


@pytest.fixture(scope="module")
def patterned(tmp_path_factory):
    """One run over a surface that is not the same everywhere."""
    run = motion(
        speed=SPEED,
        mu_s=0.3,
        mu_k=0.2,
        duration=5.0,
        surface_pattern={"amplitude": 0.1, "wavelength": 0.05, "phase_deg": PHASE},
    )
    runs = [{"columns": {"t": run.time, "x": noisy(run["x"], 1)}, "surface_speed": SPEED}]
    campaign = read_campaign(write_campaign(tmp_path_factory.mktemp("p"), runs, noise={"x": 2e-4}))
    return Problem(prepare(campaign, campaign.runs, False, SHORT_CYCLES), FREE_PARAMETERS, PATTERN)


@pytest.fixture(scope="module")
def fitted(patterned):
    return fit(patterned, with_phases(patterned, start(patterned.segmented_runs, FREE_PARAMETERS)))


def moving(problem):
    return np.array([3 in segment.free for segment in problem.segmented_runs[0].segments])


def by_segment(problem, point):
    residuals = problem.residuals(0, point.shared, point.own[0], point.states[0])
    return problem.by_segment(0, residuals)


def test_squares_by_segment_are_all_there_are(patterned, fitted):
    (residuals,) = fitted.residuals
    squares = patterned.by_segment(0, residuals)
    assert squares.shape == (len(patterned.segmented_runs[0].segments),)
    assert squares.sum() == pytest.approx(residuals @ residuals, rel=1e-12)


def test_a_lost_segment_counts_little_more_than_one_that_fits_badly(patterned, fitted):
    (residuals,) = fitted.residuals
    owner = patterned.segmented_runs[0].segment_of_rows()
    lost, poor = (np.where(owner == 0, worst, residuals) for worst in (LOST, 0.1 * LOST))
    one = patterned.misfit(0, residuals)
    # a hundred times the squares is log(100) = 4.6 more per row
    rows = np.sum(owner == 0)
    more = patterned.misfit(0, lost) - patterned.misfit(0, poor)
    assert more == pytest.approx(rows * np.log(100.0), rel=1e-3)
    assert one < patterned.misfit(0, poor)


def test_a_segment_that_sticks_at_once_is_set_moving(patterned, fitted):
    here = moving(patterned)
    assert here.any()
    states = fitted.point.states[0].copy()
    states[here, 3] = SPEED  # as fast as the surface: it sticks
    stuck = Point(fitted.point.shared, fitted.point.own, (states,))
    freed = with_velocities(patterned, stuck)
    before, after = by_segment(patterned, stuck), by_segment(patterned, freed)
    assert np.all(after <= before) and after.sum() < 0.5 * before.sum()
    moved = after < before
    read_off = patterned.segmented_runs[0].starts
    assert freed.shared is stuck.shared and moved.any() and here[moved].all()
    assert np.array_equal(freed.states[0][moved, 0], read_off[moved, 0])
    assert np.array_equal(freed.states[0][~moved], states[~moved], equal_nan=True)


def test_velocities_that_fit_stay(patterned, fitted):
    again = with_velocities(patterned, fitted.point)
    assert np.array_equal(again.states[0], fitted.point.states[0], equal_nan=True)


def test_at_another_phase_segments_keep_the_states_that_fit_better(patterned, fitted):
    turned = Point(fitted.point.shared, (fitted.point.own[0] + 6.0,), fitted.point.states)
    found = with_phases(patterned, turned)
    read_off = Point(found.shared, found.own, (patterned.segmented_runs[0].starts,))
    kept = Point(found.shared, found.own, turned.states)
    best = np.minimum(by_segment(patterned, read_off), by_segment(patterned, kept))
    # a segment starts its integration with the step that the one before it ended with
    assert by_segment(patterned, found) == pytest.approx(best, rel=1e-4)
    off = found.own[0][0] * 30.0 - PHASE
    assert abs((off + 180.0) % 360.0 - 180.0) <= 15.0  # steps of 60 and 20 degrees


def test_a_lost_segment_is_found_again(patterned, fitted):
    """A state that the fit has ruined comes back, and what fits stays the very same."""
    assert with_lost_segments_found(patterned, fitted.point) is fitted.point
    here = np.flatnonzero(moving(patterned))[:1]
    states = fitted.point.states[0].copy()
    states[here, 3] = -5.0 * SPEED
    ruined = Point(fitted.point.shared, fitted.point.own, (states,))
    found = with_lost_segments_found(patterned, ruined)
    good, bad, again = (by_segment(patterned, p)[here] for p in (fitted.point, ruined, found))
    assert np.all(bad > 10.0 * good) and again == pytest.approx(good, rel=0.05)
    others = np.delete(np.arange(len(states)), here)
    assert np.array_equal(found.states[0][others], states[others], equal_nan=True)


def test_a_phase_is_found_by_following_it(patterned, fitted):
    """States fitted for half a turn off do not hide the true phase, and a good one stays."""
    free_parameters = len(patterned.shared)
    turned = Point(fitted.point.shared, (fitted.point.own[0] + 6.0,), fitted.point.states)
    settled = fit(patterned, turned, 6, fixed=True).point
    found = with_phases_followed(patterned, settled)
    off = found.own[0][0] * 30.0 - PHASE
    assert abs((off + 180.0) % 360.0 - 180.0) <= 5.0 and len(found.shared) == free_parameters
    assert with_phases_followed(patterned, fitted.point) is fitted.point


def test_long_segments_start_where_short_ones_do(tmp_path):
    run = motion(speed=SPEED, mu_s=0.3, mu_k=0.2, duration=8.0)
    runs = [
        {
            "columns": {"t": run.time, "x": noisy(run["x"], seed)},
            "surface_speed": SPEED,
            "hold_out": bool(seed),
        }
        for seed in range(2)
    ]
    campaign = read_campaign(write_campaign(tmp_path, runs, noise={"x": 2e-4}))
    data = prepared(campaign, campaign.fit_runs, campaign.held_out_runs, False)
    for (long,), (short,) in ((data.fit, data.short), (data.held_out, data.held_out_short)):
        assert 2 <= len(long.segments) < len(short.segments)
        by_first = {segment.first: segment for segment in short.segments}
        for segment, following in zip(long.segments, [*long.segments[1:], None], strict=True):
            begun = by_first[segment.first]
            assert np.array_equal(segment.state, begun.state, equal_nan=True)
            assert (segment.free, segment.last) == (
                begun.free,
                following.first if following else len(long.time),
            )


def test_what_belongs_to_a_run_takes_no_long_step_by_what_is_hardly_felt():
    random = np.random.default_rng(1)
    felt, state = random.standard_normal((2, 30))
    columns = Columns(
        1e3 * felt,
        np.zeros((30, 0)),
        np.column_stack([1e-3 * felt]),
        ((np.arange(30), state[:, None]),),
    )
    own, steps = columns.local_step(np.zeros(0))
    assert own.tolist() == [-1.0] and len(steps) == 1
