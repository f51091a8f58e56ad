"""Runs of which only figures are known: figures of a motion, ranges, distances, small campaigns."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from cosim.gap.data import Campaign, MeasuredRun, read_campaign
from cosim.gap.data.campaign_file import Rig
from cosim.studies.reproduction.motion import Motion
from cosim.studies.reproduction.summary import find, find_summary_gap, models
from cosim.studies.reproduction.summary.draws import Draws, Target, observations, predict
from cosim.studies.reproduction.summary.models import extensions, figures, plain_candidate

FRICTION = {"friction.mu_s": 0.3, "friction.mu_k": 0.2}
SDS = {"mean_x": 5e-4, "frequency": 0.02, "slip_share": 0.01, "amplitude_x": 5e-4}
POINTS = [(0.10, 0.67, 20.17), (0.25, 1.2, 38.5), (0.05, 2.0, 38.5)]


def campaign(values=FRICTION, sds=SDS, points=POINTS) -> Campaign:
    """Figures without noise of the exact model with ``values``, guided along x."""
    empty = Campaign("figures", Path("."), Rig(degrees_of_freedom=("x",)), "exact", {}, (), ())
    runs = []
    for number, (speed, mass, stiffness) in enumerate(points, 1):
        run = MeasuredRun(f"run {number}", None, mass, stiffness, speed, -8.0, False)
        seen = figures(models.motion_of(empty, run, values, None))
        runs.append(replace(run, summary={name: (seen[name], sd) for name, sd in sds.items()}))
    return replace(empty, runs=tuple(runs))


@pytest.mark.parametrize(("amplitude", "frequency"), [(0.01, 1.3), (1e-4, 0.0)])
def test_figures_of_a_swing(amplitude, frequency):
    """One that nobody sees in a plot is none."""
    time = np.linspace(0.0, 20.0, 4001)
    x = 0.02 + amplitude * np.sin(2.0 * np.pi * 1.3 * time)
    phases = np.array([[0.0, 5.0, 0], [5.0, 12.0, 1], [12.0, 13.0, 0], [13.0, 20.0, 1]])
    none = np.zeros_like(time)
    turned = np.radians(-7.0) * np.ones_like(time)
    seen = figures(Motion(time, x, none - 0.003, turned, none, none, phases))
    assert seen["frequency"] == pytest.approx(frequency, rel=1e-4)
    assert seen["mean_x"] == pytest.approx(0.02, abs=1e-6)  # whole swings, though 20 s are not
    assert seen["amplitude_x"] == pytest.approx(amplitude, rel=1e-3)
    at = np.interp([5.0, 12.0], time, x)
    assert (seen["break_away_x"], seen["restick_x"]) == pytest.approx(tuple(at))


def test_a_known_number_is_spread_as_it_is_known():
    span = models.Span("a.b", 0.15, 0.45, prior=(0.3, 0.05))
    drawn = np.array([span.at(share) for share in np.linspace(0.0005, 0.9995, 1000)])
    assert drawn.std() == pytest.approx(0.05, rel=0.02)  # cut at three standard deviations
    assert models.Candidate((), "", (span,)).surprise({"a.b": 0.4}) == pytest.approx(4.0)


def test_every_effect_of_the_catalogue_is_tried_or_left_out_for_a_reason():
    study = read_campaign(Path(__file__).parents[3] / "cosim/gap/campaigns/study.toml")
    tried = {candidate.effects[-1] for candidate in extensions(study, plain_candidate(study))}
    assert len(tried | set(models.not_felt(study))) == 14
    assert not tried & set(models.not_felt(study))


def test_an_effect_that_is_off_leaves_the_plain_model():
    one = campaign(points=POINTS[:1])
    seen = observations(one)
    bare = predict(one, seen, FRICTION, 0)
    for candidate in extensions(one, plain_candidate(one)):
        off = predict(one, seen, candidate.off | FRICTION, 0)
        np.testing.assert_allclose(off, bare, atol=1e-12, err_msg=str(candidate))


def drawn(target: Target, *rows: list[float]) -> Draws:
    """A draw for each row: its figure, seed by seed."""
    none = np.zeros(len(rows))
    return Draws(
        models.Candidate((), "", ()), target, none[:, None], none, np.array(rows)[:, :, None]
    )


def test_misfit_is_of_distance_and_of_scatter():
    target = Target(np.array([1.0]), np.array([0.1]))
    # met; a standard deviation off; right in the mean, at the price of a wide prediction
    draws = drawn(target, [1.1] * 4, [1.0] * 4, [0.5, 1.5, 0.5, 1.5])
    off, met, scattering = draws.misfit
    assert (met, off) == pytest.approx((0.0, 1.0)) and scattering > 2.25
    assert draws.best == 1 and draws.gap == 0.0
    assert target.gap(draws.mean[0]) == pytest.approx(1.0)
    # a figure that is left out decides nothing: the first draw predicts it as well as any
    assert draws.held_out_gap == pytest.approx(1.0)
    # variance of Student's t of three degrees of freedom, and of the mean of four
    assert scattering == pytest.approx(np.log(1.0 + 3.75 * (1.0 / 3.0) / 0.1**2))
    assert (draws + draws).misfit == pytest.approx([off, met, scattering] * 2)


def test_nothing_is_missing_where_nothing_is_and_the_same_seed_says_the_same():
    one = campaign(points=POINTS[:2])
    first, second = (find_summary_gap(one, seed=3, jobs=jobs) for jobs in (1, 2))
    assert first.verdict == "none"
    assert first.gap_before[0] < 1.0
    assert first.effects == () and first.extended is None
    assert first.plain.shown.tolist() == second.plain.shown.tolist()
    assert first.plain.values["friction.mu_k"] == pytest.approx(0.2, abs=0.01)


@pytest.mark.slow
def test_an_effect_is_found_in_figures_of_the_exact_model(monkeypatch):
    few = ("static_strengthening", "film_drag", "spring_hardening")  # all fourteen take long

    def chosen(*args):
        return tuple(each for each in extensions(*args) if each.effects[-1] in few)

    monkeypatch.setattr(find, "extensions", chosen)
    hidden = FRICTION | {"static_strengthening.rate": 0.08}
    one = campaign(hidden, points=[*POINTS, (0.15, 2.0, 68.0)])
    answer = find_summary_gap(one, seed=1)
    assert answer.found[0] == "static_strengthening"
    assert answer.gap_before[0] > 2.0 > 1.0 > answer.gap_after[0]
    assert answer.chance["p"] <= 0.05
