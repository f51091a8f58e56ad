"""The fit: what was put in comes out, as precisely as it says, and no worse than by brute force."""

from dataclasses import replace

import numpy as np
import pytest
from gap_campaigns import NOISE, motion, noisy, write_campaign
from linear_runs import trial_of
from scipy.optimize import least_squares
from scipy.stats import chi2
from stickslip.effects.candidate import FreeParameter

from cosim.gap import read_campaign
from cosim.gap.estimation.fit import fit, with_columns
from cosim.gap.estimation.fitted import Point, start
from cosim.gap.estimation.intervals import determined, intervals
from cosim.gap.estimation.phases import with_phases
from cosim.gap.estimation.preparation import prepare, prepared
from cosim.gap.estimation.problem import Problem
from cosim.gap.estimation.trial import Model, coarse_fit, try_model

SPEEDS = (0.06, 0.15, 0.10)
MU_S, MU_K, LINEAR = 0.3, 0.2, 0.8
FREE_PARAMETERS = (
    FreeParameter("friction.mu_s", 0.29, 0.01, 0.0, 2.0),
    FreeParameter("friction.mu_k", 0.21, 0.01, 0.0, 2.0),
    FreeParameter("velocity_weakening.linear", 0.7, 0.1, 0.0, 5.0),
)
TRUE = (MU_S, MU_K, LINEAR)


@pytest.fixture(scope="module")
def clean():
    """Exact motions with velocity weakening, one for each speed."""
    return [
        motion(
            speed=speed, mu_s=MU_S, mu_k=MU_K, duration=6.0, velocity_weakening={"linear": LINEAR}
        )
        for speed in SPEEDS
    ]


def campaign_of(folder, motions, seed, speeds=SPEEDS):
    """The motions with noise; the last one is held out."""
    runs = [
        {
            "surface_speed": speed,
            "hold_out": number == len(speeds) - 1,
            "columns": {"t": run.time, "x": noisy(run["x"], 10 * seed + number)},
        }
        for number, (speed, run) in enumerate(zip(speeds, motions, strict=True))
    ]
    return read_campaign(write_campaign(folder, runs, noise={"x": NOISE}))


@pytest.fixture(scope="module")
def problem(clean, tmp_path_factory):
    campaign = campaign_of(tmp_path_factory.mktemp("campaign"), clean, 1)
    return Problem(prepare(campaign, campaign.fit_runs, False), FREE_PARAMETERS)


@pytest.fixture(scope="module")
def fitted(problem):
    return fit(problem, start(problem.segmented_runs, FREE_PARAMETERS))


SEEDS = 12


@pytest.fixture(scope="module")
def trials(clean, tmp_path_factory):
    """The whole way, coarse fit, fit and judgement, for many draws of the noise."""
    found = []
    for seed in range(SEEDS):
        campaign = campaign_of(tmp_path_factory.mktemp("campaign"), clean, seed)
        data = prepared(campaign, campaign.fit_runs, campaign.held_out_runs, False)
        model = Model(FREE_PARAMETERS, {})
        found.append((data, try_model(data, model, coarse_fit(data, model, 2))))
    return found


@pytest.mark.parametrize("number", range(len(FREE_PARAMETERS)))
def test_errors_are_as_large_as_the_intervals_say(trials, number):
    key, true = FREE_PARAMETERS[number].key, TRUE[number]
    deviations = []
    for _, trial in trials:
        low, high = intervals(trial)[key]
        assert low < trial.fitted.values[key] < high
        deviations.append((trial.fitted.values[key] - true) / ((high - low) / (2.0 * 1.96)))
    # chi squared of so many draws: neither too wide nor too narrow, one in five hundred allowed
    least, most = chi2.interval(0.998, SEEDS)
    assert least < np.sum(np.square(deviations)) < most
    # 95 %: more than three of twelve outside happen once in four hundred times
    assert np.count_nonzero(np.abs(deviations) > 1.96) <= 3


def test_what_is_left_is_noise(trials):
    for _, trial in trials:
        rows = sum(r.size for r in trial.fitted.residuals)
        states = sum(by_state.shape[1] for c in trial.fitted.columns for _, by_state in c.states)
        # the sum of squares of noise is chi squared; one trial of all beyond: once in 500 times
        least, most = chi2.interval(1.0 - 0.002 / SEEDS, rows - len(FREE_PARAMETERS) - states)
        assert least < trial.fitted.cost < most
        assert trial.fitted.rms_residual() == pytest.approx(np.sqrt(trial.fitted.cost / rows))


def test_a_run_that_was_held_out_is_foretold(trials):
    """Its squares are its noise and what the errors of the fitted numbers make of it."""
    squares = expected = variance = 0.0
    for data, trial in trials:
        held_out = with_columns(Problem(data.held_out, FREE_PARAMETERS), trial.held_out).columns[0]
        left = [columns.left(columns.shared) for columns in trial.fitted.columns]
        scatter = np.linalg.inv(sum(a.T @ a for a in left))
        wrong = held_out.left(held_out.shared)
        errors = np.linalg.eigvals(scatter @ wrong.T @ wrong).real
        rows = trial.rows[-1] - sum(by_state.shape[1] for _, by_state in held_out.states)
        squares += trial.squares[-1]
        expected += rows + errors.sum()
        variance += 2.0 * (rows + np.sum(errors**2))
        assert trial.held_out_rms**2 == pytest.approx(trial.squares[-1] / trial.rows[-1])
    assert abs(squares - expected) < 3.3 * np.sqrt(variance)  # one in a thousand


def test_a_trial_counts_every_run_once(trials):
    _, trial = trials[0]
    assert trial.rows.tolist() == [
        run.size for run in (*trial.fitted.residuals, *trial.held_out.residuals)
    ]
    assert trial.rms_residuals[-1] == pytest.approx(trial.held_out_rms)
    assert trial.rms_residual**2 == pytest.approx(
        np.average(trial.rms_residuals**2, weights=trial.rows)
    )


def test_only_what_the_data_determine_is_stated(trials, problem):
    _, trial = trials[0]
    assert set(determined(trial)) == {free_parameter.key for free_parameter in FREE_PARAMETERS}
    # a law that hardly differs from the one that is there: neither is known to half its value
    both = (*FREE_PARAMETERS, FreeParameter("velocity_weakening.hyperbolic", 0.2, 0.1, 0.0, 50.0))
    fitted = fit(Problem(problem.segmented_runs, both), start(problem.segmented_runs, both))
    columns = with_columns(Problem(problem.segmented_runs, both), fitted)
    vague = replace(trial, model=Model(both, {}), fitted=columns)
    assert "velocity_weakening.hyperbolic" not in determined(vague)
    assert set(intervals(vague)) == {free_parameter.key for free_parameter in both}


def test_derivatives_are_those_of_a_finer_difference(problem, fitted):
    for run in range(len(problem.segmented_runs)):
        point = fitted.point
        at = point.shared, point.own[run], point.states[run]
        columns = problem.columns(run, point, fitted.residuals[run], range(len(FREE_PARAMETERS)))
        for j in range(len(FREE_PARAMETERS)):
            fine = central(
                lambda s, at=at, j=j, run=run: problem.residuals(
                    run, moved(at[0], j, s), at[1], at[2]
                ),
                2e-3,
            )
            # of first order in a step of a hundredth: that part of them, and a corner's jump
            error = np.linalg.norm(columns.shared[:, j] - fine) / np.linalg.norm(fine)
            assert error < 0.03
        for number, (rows, by_state) in enumerate(columns.states):
            for j, axis in enumerate(problem.segmented_runs[run].segments[number].free):
                step = {0: 1e-4, 3: 1e-3}[axis]
                fine = central(
                    lambda s, at=at, n=number, a=axis, step=step, run=run: problem.residuals(
                        run, at[0], at[1], moved(at[2], (n, a), s * step)
                    ),
                    2e-3,
                )
                elsewhere = np.delete(fine, rows)
                # nothing here outlives a segment, but for the size of the integrator's next step
                assert np.abs(elsewhere).max(initial=0.0) < 1e-6 * np.abs(fine).max()
                error = np.linalg.norm(by_state[:, j] - fine[rows]) / np.linalg.norm(fine[rows])
                assert error < 0.03


def moved(values, place, step):
    values = values.copy()
    values[place] += step
    return values


def central(function, step):
    return (function(step) - function(-step)) / (2.0 * step)


def test_brute_force_finds_nothing_better(problem, fitted):
    """All at once, by scipy: free parameters and the states of all segments as they come."""
    free = [
        (i, n, axis)
        for i, segmented in enumerate(problem.segmented_runs)
        for n, segment in enumerate(segmented.segments)
        for axis in segment.free
    ]
    first = start(problem.segmented_runs, FREE_PARAMETERS)
    scale = np.array([1e-4, 0, 0, 1e-3, 0, 0])

    def residuals(steps):  # one more than they are: scipy's differences are parts of them
        unknown = steps - 1.0
        states = [s.copy() for s in first.states]
        for (i, n, axis), step in zip(free, unknown[len(FREE_PARAMETERS) :], strict=True):
            states[i][n, axis] += step * scale[axis]
        point = Point(first.shared + unknown[: len(FREE_PARAMETERS)], first.own, tuple(states))
        return np.concatenate(problem.all_residuals(point))

    # differences as long as the fit's own: shorter ones see the integrator's error
    brute = least_squares(
        residuals, np.ones(len(FREE_PARAMETERS) + len(free)), diff_step=1e-2, xtol=1e-10
    )
    assert brute.success
    # a fit stops where a step gains less than 0.02, of a sum of squares of about 1200
    assert fitted.cost == pytest.approx(2.0 * brute.cost, abs=0.05)
    values = [
        free_parameter.value(s)
        for free_parameter, s in zip(FREE_PARAMETERS, first.shared + brute.x[:3] - 1.0, strict=True)
    ]
    reach = [high - low for low, high in intervals(trial_of(problem, fitted)).values()]
    # the root of 0.02 is a seventh of a standard deviation, a 28th of an interval
    assert np.abs((np.array(values) - list(fitted.values.values())) / reach).max() < 0.04


def test_a_free_parameter_that_would_leave_its_range_stays_at_its_end(problem, fitted):
    """The others then go where they are best with it there."""
    most = 0.98 * fitted.values["friction.mu_s"]
    free_parameters = (replace(FREE_PARAMETERS[0], high=most), *FREE_PARAMETERS[1:])
    held = fit(
        Problem(problem.segmented_runs, free_parameters),
        start(problem.segmented_runs, free_parameters),
    )
    given = Problem(problem.segmented_runs, FREE_PARAMETERS[1:], {"friction.mu_s": most})
    others = fit(given, start(given.segmented_runs, given.free_parameters))
    assert held.values["friction.mu_s"] == pytest.approx(most, rel=1e-12)
    assert held.cost == pytest.approx(others.cost, abs=0.05)  # each stops within 0.02
    assert held.cost > fitted.cost + 10.0  # it does matter
    for free_parameter in FREE_PARAMETERS[1:]:
        assert held.values[free_parameter.key] == pytest.approx(
            others.values[free_parameter.key], rel=2e-3
        )


@pytest.mark.parametrize(
    "mu_s, mu_k, linear",
    [(0.20, 0.19, 0.0), (0.50, 0.10, 0.0), (0.45, 0.35, 2.0), (0.30, 0.20, 0.0), (0.6, 0.3, 1.0)],
)
def test_poor_starts_end_in_the_same_place(trials, mu_s, mu_k, linear):
    data, trial = trials[0]
    starts = (mu_s, mu_k, linear)
    free_parameters = tuple(
        replace(k, start=at) for k, at in zip(FREE_PARAMETERS, starts, strict=True)
    )
    model = Model(free_parameters, {})
    again = try_model(data, model, coarse_fit(data, model, 25))
    assert again.fitted.cost == pytest.approx(trial.fitted.cost, abs=0.05)


#: Phases of a surface that is not the same everywhere, degrees, one for each run.
PHASES = (200.0, 75.0)
PATTERN = (
    FreeParameter("friction.mu_s", 0.29, 0.01, 0.0, 2.0),
    FreeParameter("friction.mu_k", 0.21, 0.01, 0.0, 2.0),
    FreeParameter("surface_pattern.amplitude", 0.15, 0.05, 0.0, 1.0),
    FreeParameter("surface_pattern.wavelength", 0.1, 0.02, 1e-3, 10.0, log=True),
    FreeParameter("surface_pattern.phase_deg", 0.0, 30.0, per_run=True),
)


@pytest.fixture(scope="module")
def patterned(tmp_path_factory):
    motions = [
        motion(
            speed=speed,
            mu_s=MU_S,
            mu_k=MU_K,
            duration=6.0,
            surface_pattern={"amplitude": 0.2, "wavelength": 0.1, "phase_deg": phase},
        )
        for speed, phase in zip(SPEEDS[:2], PHASES, strict=True)
    ]
    campaign = campaign_of(tmp_path_factory.mktemp("pattern"), motions, 5, SPEEDS[:2])
    return Problem(prepare(campaign, campaign.runs, False), PATTERN)


@pytest.mark.parametrize("degrees", range(0, 360, 60))
def test_phases_are_found_from_any_start(patterned, degrees):
    first = start(patterned.segmented_runs, PATTERN)
    wrong = tuple(np.array([degrees / 30.0]) for _ in PHASES)
    point = with_phases(patterned, Point(first.shared, wrong, first.states))
    found = fit(patterned, point)
    for run, phase in enumerate(PHASES):
        off = found.own_values(run)["surface_pattern.phase_deg"] - phase
        # of a wave of 0.2 in 600 samples whose noise is a thirtieth of it: well within 3 degrees
        assert abs((off + 180.0) % 360.0 - 180.0) < 3.0
    assert found.rms_residual() == pytest.approx(
        1.0, abs=0.1
    )  # 1200 samples: 3.3 of 0.02, and the fit's


def test_phases_that_are_best_stay_where_they_are(patterned):
    first = start(patterned.segmented_runs, PATTERN)
    point = fit(patterned, with_phases(patterned, first)).point
    assert with_phases(patterned, point) is point


def test_without_phases_nothing_is_tried(problem):
    point = start(problem.segmented_runs, FREE_PARAMETERS)
    assert with_phases(problem, point) is point


def test_only_what_belongs_to_the_runs_moves_where_the_rest_is_fixed(problem):
    first = start(problem.segmented_runs, FREE_PARAMETERS)
    found = fit(problem, first, fixed=True)
    assert found.point.shared.tolist() == first.shared.tolist()
    assert found.cost < sum(r @ r for r in problem.all_residuals(first))
