"""A planned campaign made: an effect of some size in it, noise on it, and fitted as `gap` does."""

from dataclasses import replace

import numpy as np

from cosim.gap.candidates.plain import plain_free_parameters
from cosim.gap.data import Track, find_sticks
from cosim.gap.estimation.fit import fit
from cosim.gap.estimation.fitted import start
from cosim.gap.estimation.preparation import prepare, thinned
from cosim.gap.estimation.problem import Problem
from cosim.gap.estimation.segmented_run import COLUMN
from cosim.gap.plan.planned import motion


def measured(plan, law, part, seed):
    """The campaign as a tracker would have it, with a law at a part of its start."""
    random = np.random.default_rng(seed)
    friction = {f"friction.{key}": value for key, value in plan.friction.items()}
    runs = []
    for number, run in enumerate(plan.runs):
        phases = {key: random.uniform(0.0, 360.0) for key in law.phase(number)}
        outputs = motion(plan, run, (), {**friction, **law.settings(part), **phases})
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


def gain(campaign, planar, law):
    """Sum of squares that a law takes away: the likelihood-ratio statistic, in noise units.

    The law sets out as next to nothing.
    """
    segmented = prepare(campaign, campaign.runs, planar)
    plain = plain_free_parameters(campaign, planar)
    problem = Problem(segmented, plain)
    first = fit(problem, start(segmented, plain))
    faint = replace(law.size, start=law.value(0.02))
    added = (faint, *law.candidate.free_parameters[1:])
    more = Problem(segmented, (*plain, *added), dict(law.candidate.settings))
    begun = start(segmented, more.free_parameters)
    shared = begun.shared.copy()
    shared[: first.point.shared.size] = first.point.shared
    second = fit(more, replace(begun, shared=shared, states=first.point.states))
    return _cost(problem, first) - _cost(more, second)


def _cost(problem, fitted):
    known = problem.prior(fitted.point.shared)[0]
    return fitted.cost + float(known @ known)
