"""Numbers fitted in windows: known truth comes back, and no other optimiser finds a smaller gap."""

import importlib
import math
from dataclasses import replace
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
from gap_campaigns import KNOWN, NOISE, campaign_with, motion, noisy, seen
from scipy.optimize import differential_evolution
from stickslip.packing import GRAVITY

from cosim.gap.windows import (
    Number,
    fit,
    judge,
    run_model,
    sticks_of,
    user_model,
    windows_of,
    windows_of_campaign,
)
from cosim.gap.windows import windows as made_windows
from cosim.gap.windows.fit import _of_held_out
from cosim.gap.windows.fitted import Leeway
from cosim.gap.windows.problem import Point, Problem
from cosim.gap.windows.run_model import UNSEEN, RunModel
from cosim.gap.windows.start_states import FURTHEST, StartStates
from cosim.gap.windows.windows import cycle

MU_S, MU_K = 0.3, 0.2
LINEAR = 1.0
SPEEDS, HELD_OUT = (0.02, 0.06, 0.1, 0.04), (0.04,)


def measured(
    folder, speeds=SPEEDS, seed=0, zeros=(0.0,) * 4, planar=False, tables=None, factor=1.0,
    duration=15.0, **blocks,
):  # fmt: skip
    """A campaign of runs at some speeds, along x or planar.

    zeros : of the tracker, m; tables : of campaign.toml; factor : of springs stiffer than KNOWN
    """
    runs, more = [], {"stiffness": factor * KNOWN["stiffness"], "duration": duration, **blocks}
    for number, speed in enumerate(speeds):
        moved = motion(speed, free=("x", "y", "phi") if planar else ("x",), **more)
        runs.append(seen(moved, 100 * seed + number, surface_speed=speed))
        runs[-1] |= {"hold_out": speed in HELD_OUT}
        runs[-1]["columns"]["x"] += zeros[number]
        if planar:
            runs[-1]["columns"]["y"] = noisy(moved["y"], 100 * seed + number + 50)
    noise = dict.fromkeys(("x", "y")[: 1 + planar], NOISE)
    return campaign_with(folder, runs, noise=noise, **(tables or {}))


def fitted(campaign):
    numbers, settings = user_model(campaign)
    return fit(campaign, windows_of_campaign(campaign), numbers, settings)


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    """A campaign without a missing effect."""
    return measured(tmp_path_factory.mktemp("plain"))


@pytest.fixture(scope="module")
def found(plain):
    return fitted(plain)


@pytest.fixture(scope="module")
def weakened(tmp_path_factory):
    """A campaign with an effect that the user's model lacks."""
    effect = {"velocity_weakening": {"linear": LINEAR}}
    return measured(tmp_path_factory.mktemp("weakened"), (0.03, 0.08, 0.15), **effect)


def test_windows_fill_a_run_and_start_in_sticks(plain):
    for run in plain.runs:
        windows = windows_of(run)
        period = cycle(run)
        starts = run.motion.time[windows.first[1:]]
        assert windows.first[0] == 0 and windows.channels == ("x",)
        assert all(2.0 * period < b - a < 4.5 * period for a, b in pairwise(starts))
        assert 1.0 * period < run.motion.time[-1] - starts[-1] < 5.0 * period
        in_stick = np.isfinite(windows.hold_since)
        onsets = {stick.first for stick in sticks_of(run)}
        assert in_stick[2:].all() and set(windows.first[2:].tolist()) <= onsets
        assert not windows.free[in_stick, 3].any() and windows.free[1:][~in_stick[1:], 3].all()
        assert windows.free[1:, 0].all() and not windows.free[:, [1, 2, 4, 5]].any()


def test_what_had_been_before_the_record_is_not_compared(found, plain):
    """Nobody knows how long the block had rested: a run counts from its first fast sliding."""
    for run, fitted in zip(plain.runs, found.runs, strict=True):
        windows, first = windows_of(run), sticks_of(run)[0]
        assert windows.led_in and not windows.free[0].any()
        assert first.last < windows.begin == fitted.begin < first.last + 100
        assert fitted.residuals.size == run.motion.time.size - windows.begin
        assert fitted.window.min() == 1


def test_windows_without_sticks_start_in_fast_sliding(tmp_path):
    speed = 0.6
    (run,) = measured(tmp_path, (speed,), film_drag={"coefficient": 0.2}).runs
    windows = windows_of(run)
    assert cycle(run) == pytest.approx(2.0 * math.pi / run.natural_frequency, rel=0.02)
    assert np.isnan(windows.hold_since).all() and windows.free[1:, 3].all()
    assert len(windows.first) > 3 and not windows.grazes


@pytest.mark.parametrize(
    ("depth", "flat", "sticks", "slow"),
    [
        (0.0, 0.0, False, 1.287),  # it slides by less than a fifth for 2 arccos(0.8) / omega
        (0.0, 0.0, True, None),
        # in the mean over a half of 1 / omega by a tenth of the surface's speed
        (0.07, 0.0, False, 1.07),
        (0.11, 0.0, False, None),
        (0.085, 0.0, False, 1.01),
        (0.092, 0.0, False, None),
        # with a stick in it that is too short to be seen
        (0.0, 1.0, False, 2.287),
        (0.0, 1.5, False, None),
    ],
)
def test_a_crest_grazes_the_surface_s_speed(monkeypatch, depth, flat, sticks, slow):
    """depth : least sliding speed in the surface's; flat, slow : how long it stays, 1 / omega."""
    omega, turn = 10.0, 2.0 * math.pi
    time = np.arange(0.0, 8.0, 2e-4)
    phase = (omega * time) % (turn + flat) - 0.5 * (turn + flat)
    speed = 1.0 - (1.0 - depth) * np.cos(np.sign(phase) * np.maximum(np.abs(phase) - flat / 2, 0))
    track = SimpleNamespace(time=time, sliding=0.1 * speed)
    seen = [SimpleNamespace(start=0.0, end=8.0)] * sticks
    monkeypatch.setattr(made_windows, "smoothed", lambda run: track)
    monkeypatch.setattr(made_windows, "sticks_of", lambda run: seen)
    run = SimpleNamespace(natural_frequency=omega, surface_speed=0.1)
    found = made_windows._crests(run, (turn + flat) / omega)
    if slow is None:
        assert not len(found)
    else:
        assert len(found) >= 8 and np.diff(found)[1:-1] * omega == pytest.approx(slow, abs=0.03)


@pytest.mark.parametrize(("part", "grazes"), [(1.02, True), (1.25, False)])
def test_a_block_that_just_reaches_the_surface_is_followed_from_crest_to_crest(
    tmp_path, part, grazes
):
    """Whether it sticks there hangs on micrometres of the contact, and ideal ones hold for long.

    part : the surface's speed in that which an undamped block from rest just reaches
    """
    omega = math.sqrt(4.0 * KNOWN["stiffness"] / KNOWN["mass"])
    campaign = measured(tmp_path, (part * MU_K * GRAVITY / omega,))
    (run,), windows = campaign.runs, windows_of_campaign(campaign)
    its = windows[run.name]
    assert its.grazes == grazes and not sticks_of(run)
    model, moved = RunModel(campaign, run, its), motion(run.surface_speed, duration=15.0)
    sliding = 1.0 - np.gradient(moved["x"], run.motion.time) / run.surface_speed
    compared = np.isin(np.arange(run.motion.time.size), model.rows)[its.begin :]
    swings = (run.motion.time[-1] - run.motion.time[its.begin]) / cycle(run)
    if grazes:
        assert len(its.first) - 1 == pytest.approx(swings, abs=1.5)
        assert compared.mean() == pytest.approx(0.795, abs=0.05)
        assert np.mean(sliding < 0.1) > 0.05
        assert np.mean(sliding[its.begin :][compared] < 0.1) < 0.02
    else:
        assert compared.all() and len(its.first) - 1 == pytest.approx(swings / 3.0, abs=1.5)


def test_known_truth_comes_back(found):
    """Residuals are the noise less what the fitted numbers take up of it."""
    for run in found.runs:
        size, states = run.residuals.size, np.count_nonzero(~np.isnan(run.states[:, [0, 3]]))
        assert run.gap == pytest.approx(1.0, abs=3.0 / math.sqrt(2.0 * size) + 0.5 * states / size)
    assert all(gap == pytest.approx(1.0, abs=0.05) for gap in found.gap)  # of 1400 samples
    for key, truth in (("friction.mu_s", MU_S), ("friction.mu_k", MU_K)):
        assert abs(found.values[key] - truth) < 3.0 * found.sd[key] < 0.03
    assert not found.at_bound
    assert [run.name for run in found.runs] == ["run01", "run02", "run03", "run04"]


def test_standard_deviations_are_those_of_the_errors(tmp_path):
    """Of springs and zeros that differ from what is stated as their errors say."""
    off = []
    for seed in range(12):
        rng = np.random.default_rng(seed)
        factor, zeros = math.exp(0.01 * rng.standard_normal()), 6e-4 * rng.standard_normal(3)
        folder = tmp_path / str(seed)
        folder.mkdir()
        campaign = measured(
            folder, SPEEDS[:3], seed, zeros, factor=factor, duration=8.0,
            tables={"errors": {"stiffness": 0.01, "zero": 3.0}},
        )  # fmt: skip
        result = fitted(campaign)
        truth = {"friction.mu_s": MU_S, "friction.mu_k": MU_K, "offset.x@run01": zeros[0]}
        truth["offset.stiffness@setup 0"] = math.log(factor)
        off.append([(result.values[key] - truth[key]) / result.sd[key] for key in truth])
    # 48 deviates, of which those of a campaign hang together somewhat
    assert 0.7 < np.sqrt(np.mean(np.square(off))) < 1.3
    assert np.max(np.abs(off)) < 3.5


def test_an_effect_that_is_known_leaves_no_gap(weakened):
    """And its strength comes back; what the user states leaves a gap."""
    numbers, settings = user_model(weakened)
    windows = windows_of_campaign(weakened)
    strength = Number("velocity_weakening.linear", 0.8 * LINEAR, None, 0.0, 5.0)
    with_it = fit(weakened, windows, [*numbers, strength], settings)
    assert fit(weakened, windows, numbers, settings).gap[0] > 1.5
    assert with_it.gap[0] == pytest.approx(1.0, abs=0.05)
    assert abs(with_it.values[strength.key] - LINEAR) < 3.0 * with_it.sd[strength.key] < 0.5


def test_no_other_optimiser_finds_a_smaller_gap(weakened):
    """Over mu_s and mu_k; stiffness and zeros are as the fit has them."""
    result = fitted(weakened)
    numbers, settings = user_model(weakened)
    settings |= {k: v for k, v in result.values.items() if k.startswith("offset")}
    numbers = [number for number in numbers if number.key.startswith("friction")]
    windows = windows_of_campaign(weakened)
    problem = Problem(weakened, weakened.fit_runs, windows, numbers, settings)

    def gap(scaled):
        rows = []
        for part in problem.parts:
            part.forget()  # states are found anew, from the data
            rows.append(part.followed(scaled).residuals)
        return float(np.sqrt(np.mean(np.concatenate(rows) ** 2)))

    bounds = [(n.scaled(0.5 * n.start), n.scaled(2.0 * n.start)) for n in numbers]
    best = differential_evolution(gap, bounds, maxiter=8, popsize=8, seed=1, polish=False)
    assert result.gap[0] < 1.03 * best.fun


def test_judged_runs_are_those_of_the_fit(plain, found):
    numbers, settings = user_model(plain)
    windows = windows_of_campaign(plain)
    judged = judge(plain, windows, numbers, {**settings, **found.values})
    assert judged.gap[1] == pytest.approx(found.gap[1], rel=1e-3) and math.isnan(judged.gap[0])
    off = {**settings, **found.values, "friction.mu_s": 1.05 * MU_S, "friction.mu_k": 1.05 * MU_K}
    strict, lenient = (judge(plain, windows, numbers, off, scatter) for scatter in (0.0, 0.05))
    assert strict.gap[1] > 2.0 > lenient.gap[1] == pytest.approx(1.0, abs=0.05)
    assert lenient.values["offset.friction@run04"] == pytest.approx(-math.log(1.05), abs=0.01)
    assert "offset.friction@run04" not in strict.values


def test_set_points_of_judged_runs_follow_the_wave_length(plain, found):
    (judged,) = (run.name for run in plain.held_out_runs)
    own = {f"offset.speed@{judged}": 0.004, f"offset.x@{judged}": 1e-4}
    starts = [{**own, "offset.speed@run01": 0.001, "friction.mu_k": 0.2}]
    wave = Number("surface_pattern.wavelength", 0.1)
    shorter = replace(found, values={wave.key: 0.098})
    moved_by = _of_held_out(plain.held_out_runs, [wave], starts, shorter)
    assert moved_by == {**own, f"offset.speed@{judged}": pytest.approx(0.004 - 0.02)}
    assert _of_held_out(plain.held_out_runs, [], starts, found) == own


def test_the_track_is_what_the_residuals_are_of(plain, found):
    for run in plain.runs:
        model = found.run(run.name)
        assert model.track.shape == (run.motion.time.size, 3)
        off = (model.track[:, 0] - run.motion.x) / NOISE
        assert np.allclose(off[model.begin :], model.residuals, atol=1e-6)
        # held-out runs may have shared numbers within the errors of the fit
        off = abs(model.values["friction.mu_s"] - found.values["friction.mu_s"])
        assert off <= 4.0 * found.sd["friction.mu_s"] * model.hold_out


def test_a_planar_motion_is_fitted_in_both_directions(tmp_path):
    turned = {"spring_misalignment": {"angle_deg": 2.0}}
    campaign = measured(tmp_path, SPEEDS[:2], planar=True, **turned)
    windows = windows_of_campaign(campaign)
    assert all(each.is_planar and each.channels == ("x", "y") for each in windows.values())
    numbers, settings = user_model(campaign)
    settings |= {"spring_misalignment.angle_deg": 2.0}
    result = fit(campaign, windows, numbers, settings)
    assert result.gap[0] == pytest.approx(1.0, abs=0.03)
    assert abs(result.values["friction.mu_k"] - MU_K) < 3.0 * result.sd["friction.mu_k"]


def test_what_the_tracker_does_not_have_has_a_prior(tmp_path):
    """Of y and phi at a window's start only what is not seen; a state that is 0 costs nothing."""
    campaign = measured(tmp_path, SPEEDS[:2], planar=True, spring_misalignment={"angle_deg": 2.0})
    run = campaign.runs[0]
    model = RunModel(campaign, run, windows_of(run, planar=True))
    states = np.zeros((len(model.windows.first), 6 + model.sticks[1].max() - 5))
    assert not model.residuals({}, states)[model.size :].any()
    states[1:, :6] = [1e-3, 1e-3, UNSEEN["phi"], 0.0, 1e-3, 2.0 * UNSEEN["phi"]]
    priors = model.residuals({}, states)[-2 * (len(states) - 1) :].reshape(-1, 2)
    assert priors == pytest.approx(np.tile([1.0, 2.0 / run.natural_frequency], (len(priors), 1)))
    assert (model.owner[-priors.size :].reshape(-1, 2).T == np.arange(1, len(states))).all()


def test_a_lost_model_does_not_turn_a_block_round_that_is_not_seen_to_turn(tmp_path):
    """Else its windows stay where no step leads back from, and spoil a model that is none."""
    campaign = measured(tmp_path, SPEEDS[:2], planar=True, spring_misalignment={"angle_deg": 2.0})
    model = RunModel(campaign, campaign.runs[0], windows_of(campaign.runs[0], planar=True))
    starts, values = StartStates(model), {"friction.mu_s": 2.0 * MU_S, "friction.mu_k": 0.5 * MU_K}
    at = starts.started(values, starts.read_off(values), model.packed(values))
    at.states[1:, 2] = 0.9 * FURTHEST * UNSEEN["phi"]
    found = starts.settled(values, at, model.packed(values))
    assert starts.gain(at, found) > 0.0
    assert (abs(found.states[model.unseen]) <= FURTHEST * model.unseen_sd).all()


def test_where_friction_holds_a_block_across_only_its_place_is_free_in_a_stick(tmp_path):
    campaign = measured(tmp_path, SPEEDS[:2], planar=True, spring_misalignment={"angle_deg": 2.0})
    run = campaign.runs[0]
    starts = StartStates(RunModel(campaign, run, windows_of(run, planar=True)))
    along, across = starts.free({}), starts.free({"lateral_friction.ratio": 1.0})
    in_stick = np.isfinite(starts.model.windows.hold_since) & along[:, 0]
    assert in_stick.any() and not in_stick.all()
    assert along[in_stick, 4:6].all() and not across[in_stick, 3:6].any()
    assert (along[~in_stick] == across[~in_stick]).all()


def test_a_number_that_a_bound_holds_is_named(plain):
    numbers, _ = user_model(plain)
    numbers = [number for number in numbers if number.key.startswith("friction")]
    held = [replace(n, high=0.99 * MU_K) if n.key == "friction.mu_k" else n for n in numbers]
    result = fit(plain, windows_of_campaign(plain), held)
    assert result.at_bound == {"friction.mu_k": 0.99 * MU_K}


def test_the_user_s_model_is_what_the_campaign_states(plain, tmp_path):
    numbers, settings = user_model(plain)
    assert [n.key for n in numbers] == [
        "friction.mu_s", "friction.mu_k", "offset.stiffness", "offset.x"
    ]  # fmt: skip
    mu_s, mu_k, stiffness, zero = numbers
    assert mu_s.start == pytest.approx(MU_S, rel=0.05) and mu_k.start == pytest.approx(
        MU_K, rel=0.1
    )
    assert mu_s.prior is None and mu_k.prior is None and not settings
    assert stiffness.prior == 0.01 and stiffness.scope == "setup"
    assert zero.prior == 5e-4 and zero.scope == "run"
    tables = {"friction": {"mu_k": [0.21, 0.01]}, "errors": {"zero": 2.0}}
    mu_s, mu_k, _, zero = user_model(measured(tmp_path, tables=tables))[0]
    assert mu_s.prior is None and (mu_k.start, mu_k.prior) == (0.21, 0.01)
    assert zero.prior == pytest.approx(2.0 * NOISE)
    assert user_model(replace(plain, scheme="study"))[1] == {"stick_stiffness.ratio": 0.25}


def test_mu_s_is_not_fitted_where_nothing_sticks(tmp_path):
    campaign = measured(tmp_path, (0.6,), film_drag={"coefficient": 0.2})
    numbers, settings = user_model(campaign)
    assert "friction.mu_s" not in [number.key for number in numbers]
    assert settings["friction.mu_s"] == pytest.approx(MU_K, rel=0.3)


def test_a_table_of_friction_is_the_law(tmp_path):
    (tmp_path / "law.csv").write_text("v,mu\n0,0.2\n0.5,0.2\n", encoding="utf-8")
    campaign = measured(tmp_path, tables={"friction": {"table": "law.csv"}})
    numbers, settings = user_model(campaign)
    mu_k = next(number for number in numbers if number.key == "friction.mu_k")
    assert mu_k.start == pytest.approx(0.2) and mu_k.prior == pytest.approx(0.01)
    result = fit(campaign, windows_of_campaign(campaign), numbers, settings)
    assert result.gap[0] == pytest.approx(1.0, abs=0.03)


def test_shared_numbers_that_no_step_leads_back_begin_inside_what_the_fit_leaves_open(monkeypatch):
    """Before, their weight was doubled until numbers overflowed, or for ever."""
    problem, labels, far = object.__new__(Problem), ["a", "b", "own"], np.array([5.0, -8.0, 3.0])
    problem.labels, problem.leeway = labels, Leeway(("a", "b"), np.ones(2), 10.0 * np.eye(2))
    stays = {
        "_first": lambda self, starts: [Point(far, [], 0.0)],
        "_settled": lambda self, at: at,
        "_descended": lambda self, at, tries: Point(at, [], 0.0),
        "_fitted": lambda self, at: at,
    }
    for name, how in stays.items():
        monkeypatch.setattr(Problem, name, how)
    found = problem.solved()
    assert Leeway(("a", "b"), np.ones(2), 10.0 * np.eye(2)).excess(found, labels) < 1.0
    assert found[2] == far[2]
    assert (found[0] - 1.0) / (found[1] - 1.0) == pytest.approx(4.0 / -9.0)


def test_a_start_is_left_that_leads_to_twice_the_squares_of_the_model_that_it_holds(
    plain, monkeypatch
):
    near, asked = SimpleNamespace(cost=30.0, held_out_cost=10.0, runs=()), []

    class Asked(Problem):
        def __init__(self, *given, hopeless=math.inf, **further):
            asked.append(hopeless)
            super().__init__(*given, hopeless=hopeless, **further)

        def solved(self, starts=()):
            raise LookupError

    monkeypatch.setattr(importlib.import_module("cosim.gap.windows.fit"), "Problem", Asked)
    for model in (near, None):
        with pytest.raises(LookupError):
            fit(plain, windows_of_campaign(plain), *user_model(plain), near=model)
    assert asked == [40.0, math.inf]


@pytest.mark.parametrize(("cost", "settled"), [(39.9, True), (40.1, False)])
def test_windows_of_a_model_that_is_lost_are_not_tried_again(monkeypatch, cost, settled):
    tried = []
    monkeypatch.setattr(Problem, "_go_on_from", lambda self, at: None)
    monkeypatch.setattr(Problem, "_descended", lambda self, at, tries: Point(at, [], cost))
    monkeypatch.setattr(Problem, "_retried", lambda self, at: tried.append(at))
    monkeypatch.setattr(Problem, "_point", lambda self, at: Point(at, [], cost))
    problem = object.__new__(Problem)
    problem.hopeless = 40.0
    problem._settled(Point(np.zeros(1), [], cost))
    assert bool(tried) is settled


def test_what_a_fit_takes_is_counted(plain, monkeypatch):
    """Every sample of every track, held-out runs' too."""
    simulated, track = [], run_model.track_restarted

    def counted(p, speed, temperature, times, *given, **named):
        simulated.append(times.size)
        return track(p, speed, temperature, times, *given, **named)

    monkeypatch.setattr(run_model, "track_restarted", counted)
    numbers, settings = user_model(plain)
    windows = windows_of_campaign(plain)
    assert fit(plain, windows, numbers[:1], settings).simulated == sum(simulated) > 0
