"""Campaigns of several masses and speeds, and the models that are settled on them."""

from dataclasses import replace

from gap_campaigns import NOISE, motion, noisy, write_campaign
from stickslip.effects.candidate import FreeParameter

from cosim.gap import read_campaign
from cosim.gap.candidates.plain import plain_free_parameters
from cosim.gap.estimation.preparation import prepare, thinned
from cosim.gap.estimation.trial import Model
from cosim.gap.evidence.settled import settled

#: Mass, kg, and speed of the surface, m/s; the last is held out.
SETUPS = ((0.5, 0.05), (0.5, 0.2), (1.0, 0.05), (1.0, 0.2), (0.7, 0.1))


def campaign_of(folder, blocks, seed, duration=4.0, setups=SETUPS):
    """blocks : (mass, speed) -> tables of the effects that are at work in that run."""
    runs = []
    for number, (mass, speed) in enumerate(setups):
        run = motion(speed=speed, mass=mass, duration=duration, **blocks(mass, speed))
        runs.append({
            "mass": mass,
            "surface_speed": speed,
            "hold_out": number == len(setups) - 1,
            "columns": {"t": run.time, "x": noisy(run["x"], 100 * seed + number)},
        })  # fmt: skip
    campaign = read_campaign(write_campaign(folder, runs, noise={"x": NOISE}))
    return replace(campaign, runs=tuple(thinned(run) for run in campaign.runs))


def prepared_of(campaign):
    """Segmented runs along the line."""
    return prepare(campaign, campaign.runs, False, 1.2)


def settled_on(campaign, segmented, free=(), before=None, turns=4):
    """The plain model, with these free parameters besides, at its best."""
    model = Model((*plain_free_parameters(campaign, False), *free), {})
    return settled(segmented, campaign.runs, model, before, turns)


def strength(key, start, step, low=0.0, high=1e3):
    """A free parameter that may be nothing."""
    return FreeParameter(key, start, step, low, high)
