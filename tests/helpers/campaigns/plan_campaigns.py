"""A planned campaign made: an effect of some size in it, noise on it, and fitted as `gap` does."""

from dataclasses import replace

import numpy as np

from cosim.gap.data import Track, find_sticks
from cosim.gap.estimation.fit import fit
from cosim.gap.estimation.fitted import Point, start
from cosim.gap.estimation.preparation import prepare, thinned
from cosim.gap.estimation.problem import Problem
from cosim.gap.estimation.segmented_run import COLUMN
from cosim.gap.plan.planned import motion


def measured(plan, rehearsal, law, part, seed):
    """The campaign as a tracker would have it, with a law at a part of its start.

    rehearsal : of the plan, whose contact the rig has
    """
    random = np.random.default_rng(seed)
    friction = {f"friction.{key}": value for key, value in plan.friction.items()}
    runs = []
    for number, run in enumerate(plan.runs):
        phases = {key: random.uniform(0.0, 360.0) for key in law.phase(number)}
        settings = {**friction, **law.settings(part), **phases}
        outputs = motion(plan, run, rehearsal.free_parameters, settings)
        noise = plan.campaign.noise
        seen = {
            name: outputs[:, COLUMN[name]] + sigma * random.standard_normal(run.time.size)
            for name, sigma in noise.items()
        }
        setting = run.setting
        track = Track(run.time, seen["x"], seen.get("y"), seen.get("phi"))
        sticks = find_sticks(track, setting.surface_speed, setting.natural_frequency, noise["x"])
        runs.append(thinned(replace(setting, track=track, sticks=sticks)))
    return replace(plan.campaign, runs=tuple(runs))


def gain(campaign, rehearsal, planar, law):
    """Sum of squares that a law takes away: the likelihood-ratio statistic, in noise units.

    The law sets out as next to nothing, the plain model from what is expected, and once more from
    where the model with the law ended.
    """
    segmented = prepare(campaign, campaign.runs, planar)
    plain = rehearsal.free_parameters
    problem = Problem(segmented, plain)
    first = fit(problem, start(segmented, plain))
    faint = replace(law.size, start=law.value(0.02))
    added = (faint, *law.candidate.free_parameters[1:])
    more = Problem(segmented, (*plain, *added), dict(law.candidate.settings))
    begun = start(segmented, more.free_parameters)
    count = first.point.shared.size
    shared = np.concatenate([first.point.shared, begun.shared[count:]])
    second = fit(more, replace(begun, shared=shared, states=first.point.states))
    own = tuple(each[: len(problem.own)] for each in second.point.own)
    again = fit(problem, Point(second.point.shared[:count], own, second.point.states))
    return min(_cost(problem, first), _cost(problem, again)) - _cost(more, second)


def _cost(problem, fitted):
    known = problem.prior(fitted.point.shared)[0]
    return fitted.cost + float(known @ known)
