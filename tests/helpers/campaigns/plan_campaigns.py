"""A planned campaign, made: an effect of some size in it, the rig as far off as stated, noise."""

from dataclasses import replace

import numpy as np

from cosim.gap.naming import Naming
from cosim.gap.plan.planned import simulated
from cosim.gap.weak_form.constants import ALIKE, OWN_STATIC


def made(planned, blocks, seed):
    """The campaign with tracks. Springs, speeds, zeros and friction are off within their errors."""
    random, campaign = np.random.default_rng(seed), planned.campaign
    errors, runs = campaign.errors, []
    stiffer = {s: 1.0 + errors.stiffness * random.standard_normal() for s in campaign.setups}
    for run in planned.runs:
        own, stated = run.setting, (run.setting.mass, run.setting.stiffness)
        both, static = random.standard_normal(2) * errors.friction
        friction = dict(planned.friction)
        friction["mu_k"] *= 1.0 + both
        friction["mu_s"] *= 1.0 + both + OWN_STATIC * static
        faster = 1.0 + errors.surface_speed * random.standard_normal()
        true = replace(
            own, stiffness=own.stiffness * stiffer[stated],
            surface_speed=own.surface_speed * faster,
        )  # fmt: skip
        seen = simulated(campaign, replace(run, setting=true), friction, random, blocks)
        zero = campaign.zero_sd(own) * random.standard_normal()
        runs.append(replace(own, track=replace(seen.track, x=seen.track.x + zero)))
    return replace(campaign, runs=tuple(runs))


def named(campaign):
    """What is named of a campaign with tracks: a group of effects for every finding."""
    return [
        {one.name, *(other for other, less in one.others.items() if less > -ALIKE)}
        for one in Naming.of(campaign).named().findings
    ]
