"""The next experiment: what a rig can do, and what a refit takes back of a separation."""

from dataclasses import replace

import numpy as np
import pytest
from gap_campaigns import NOISE, motion, noisy, write_campaign
from stickslip.effects.candidate import FreeParameter

from cosim.gap.data import read_campaign
from cosim.gap.design import Member, experiments, next_experiment
from cosim.gap.design.rehearsal import problem_of, rehearse, setting_of
from cosim.gap.design.separation import separation
from cosim.gap.estimation.fit import with_columns
from cosim.gap.estimation.fitted import Fitted, start
from cosim.gap.estimation.preparation import prepare
from cosim.gap.estimation.problem import Problem

DRAG = FreeParameter("structural_damping.coefficient", 0.4, 0.2, 0.0)


@pytest.fixture(scope="module")
def campaign(tmp_path_factory):
    folder = tmp_path_factory.mktemp("campaign")
    runs = []
    for seed, speed in enumerate((0.03, 0.06)):
        seen = motion(speed=speed, duration=6.0, structural_damping={"coefficient": 0.4})
        x = noisy(seen["x"], seed)
        runs.append({"surface_speed": speed, "columns": {"t": seen.time, "x": x}})
    return read_campaign(write_campaign(folder, runs, noise={"x": NOISE}))


def member(campaign, effect, *free_parameters, **settings):
    """The true friction, as if it had been fitted, with other free parameters."""
    plain = (FreeParameter("friction.mu_s", 0.3, 0.015), FreeParameter("friction.mu_k", 0.2, 0.01))
    problem = Problem(prepare(campaign, campaign.runs, False), (*plain, *free_parameters), settings)
    point = start(problem.segmented_runs, problem.free_parameters)
    fitted = Fitted(problem.free_parameters, point, problem.all_residuals(point))
    return Member(effect, problem.free_parameters, settings, with_columns(problem, fitted))


def test_range_is_that_of_the_campaign_widened(campaign):
    found = experiments(campaign)
    assert {one.mass for one in found} == {0.87, 1.74}
    assert {one.stiffness for one in found} == {38.5, 77.0}
    speeds = [one.surface_speed for one in found]
    assert min(speeds) == 0.01 and max(speeds) == 0.18
    assert found[0].changed == 0 and found[-1].changed == 2
    farthest = max(np.nanmax(np.abs(run.track.x)) for run in campaign.runs)
    assert all(abs(abs(one.pull) - farthest) < 1e-4 for one in found)


def test_speeds_have_the_campaigns_direction(campaign):
    back = [replace(run, surface_speed=-run.surface_speed) for run in campaign.runs]
    assert all(one.surface_speed < 0.0 for one in experiments(replace(campaign, runs=tuple(back))))


def test_fewer_are_tried_by_leaving_the_rig_as_it_is(campaign):
    every, some = experiments(campaign), experiments(campaign, most=20)
    assert len(some) < len(every)
    assert {one.changed for one in some} == {0}


def test_a_model_is_not_separated_from_itself(campaign):
    one = member(campaign, "structural_damping", DRAG)
    setting = setting_of(campaign, planar=False)
    segmented = rehearse(setting, experiments(campaign)[0], one.values)
    assert separation(segmented, one, one.information()) < 0.02


def test_what_a_free_parameter_can_take_up_is_no_separation(campaign):
    """mu_k off by 3 %: seen by a campaign that knows mu_k, absorbed by one that does not."""
    one = member(campaign, "structural_damping", DRAG)
    setting = setting_of(campaign, planar=False)
    values = one.values | {"friction.mu_k": 0.206}
    segmented = rehearse(setting, experiments(campaign)[0], values)
    known, unknown = one.information() * 100.0, np.zeros((3, 3))
    for rounds in (0, 3):
        assert separation(segmented, one, known, rounds) > 1.0
    assert separation(segmented, one, unknown, 10) < 0.1


def test_the_rig_cannot_crush_its_springs(campaign):
    one = member(campaign, "structural_damping", DRAG)
    far = replace(experiments(campaign)[0], start="let go", pull=0.12)
    assert rehearse(setting_of(campaign, planar=False), far, one.values) is None


def test_rehearsed_run_is_sampled_as_the_campaign(campaign):
    one = member(campaign, "structural_damping", DRAG)
    segmented = rehearse(setting_of(campaign, planar=False), experiments(campaign)[0], one.values)
    assert segmented.time[-1] == pytest.approx(6.0)
    assert np.diff(segmented.time) == pytest.approx(0.01)
    own = problem_of(segmented, one)
    point = start([segmented], one.free_parameters)
    assert np.abs(own.residuals(0, point.shared, point.own[0], point.states[0])).max() < 1.0


def test_proposal_is_plain_data_and_the_same_every_time(campaign):
    damped = member(campaign, "structural_damping", DRAG)
    plain = member(campaign, "film_drag", **{"film_drag.coefficient": 0.4})
    first = next_experiment(campaign, [damped, plain], planar=False)
    assert first == next_experiment(campaign, [damped, plain], planar=False)
    assert set(first) >= {"mass", "stiffness", "surface_speed", "duration", "separates", "text"}
    ((a, b, units),) = first["separates"]
    assert (a, b) == ("structural_damping", "film_drag")
    assert units == first["predicted_separation"] > 0.5
    assert f"{first['mass']:.4g} kg" in first["text"]
    assert all(isinstance(first[key], float) for key in ("mass", "stiffness", "surface_speed"))


def test_nothing_is_proposed_for_a_single_model(campaign):
    one = member(campaign, "structural_damping", DRAG)
    assert next_experiment(campaign, [one], planar=False) is None


def test_a_fit_without_derivatives_is_refused(campaign):
    one = member(campaign, "structural_damping", DRAG)
    with pytest.raises(ValueError, match="derivatives"):
        Member("structural_damping", one.free_parameters, {}, replace(one.fitted, columns=None))
