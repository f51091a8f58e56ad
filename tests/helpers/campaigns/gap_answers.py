"""Answers of the gap workflow, made by hand from real fits of a small campaign in windows."""

import re
from dataclasses import replace
from functools import cache
from html import unescape

import numpy as np
from gap_campaigns import NOISE, motion, noisy, write_campaign

from cosim.gap import read_campaign
from cosim.gap.result import Doubt, Exponent, Gap, Law, Ranked, Rates, RigNumber, Rung, Score, Where
from cosim.gap.windows import Number, fit, user_model, windows_of_campaign

TRUE = {"velocity_weakening": {"linear": 0.8}}
ADDED = Number("velocity_weakening.linear", 0.7, None, 0.0, 5.0)
SPEEDS = (0.06, 0.12, 0.2)
VERDICTS = ("named", "class", "none", "partial", "unknown")


def write(folder, held_out=True):
    """A campaign of three runs of six seconds on disk; the last is held out."""
    runs = []
    for number, speed in enumerate(SPEEDS):
        run = motion(speed=speed, duration=6.0, **TRUE)
        columns = {"t": run.time, "x": noisy(run["x"], number)}
        is_last = held_out and number == len(SPEEDS) - 1
        runs.append({"surface_speed": speed, "hold_out": is_last, "columns": columns})
    return write_campaign(folder, runs, name="cold room, week 3", noise={"x": NOISE})


@cache
def answer(folder):
    """velocity_weakening, named; the effect that the runs were made with."""
    campaign = read_campaign(write(folder))
    plain, extended = fitted(campaign), fitted(campaign, ADDED)
    before, after = score(plain), score(extended)
    value, sd = extended.values[ADDED.key], extended.sd[ADDED.key]
    interval = (value - 1.645 * sd, value + 1.645 * sd)
    found = Ranked(
        "velocity_weakening", "linear", 617.3, 0.9995, after,
        {ADDED.key: value}, {ADDED.key: interval},
    )  # fmt: skip
    other = Ranked(
        "film_drag", "linear", -1.5, 4e-4, None, {"film_drag.coefficient": 0.0},
        {"film_drag.coefficient": (0.0, np.inf)}, ("film_drag.coefficient",),
    )  # fmt: skip
    weak = Score(1.4, 1.5), Score(1.01, 1.03)
    return Gap(
        campaign=campaign,
        verdict="named",
        effects=("velocity_weakening",),
        sentence="Kinetic friction falls with the sliding speed: velocity_weakening.",
        classes=(),
        where=Where("x", "slip", ("run02", "run01"), "along x, in slip, most in run02"),
        ladder=(
            Rung("user's model", "ideal dry friction, as stated", before, weak[0], 0.0),
            Rung("velocity_weakening", "mu_k falls", after, weak[1], 0.996, 617.3),
        ),
        ranking=(found, other, Ranked("run_in", "exponential", -4.5, 1e-5)),
        plain=plain,
        extended=extended,
        laws=(law(),),
        exponents=(Exponent("velocity_weakening", "sliding speed", 1.04, 0.9, 1.2, 1.0),),
        scatter=(0.004, 0.0, 0.02),
        rig=(RigNumber("surface speed of run02", "m/s", 0.12, 0.0012, 0.1231, 0.0003),),
        rates=Rates(50, {"velocity_weakening": {"velocity_weakening": 47, "none": 3},
                         "film_drag": {"film_drag": 50}}),
        doubts=(Doubt("sampling", "run01 is sampled only 60 times a cycle", ("run01",)),),
    )  # fmt: skip


def fitted(campaign, *added):
    """The user's model, with more numbers, fitted in windows."""
    numbers, settings = user_model(campaign)
    return fit(campaign, windows_of_campaign(campaign), [*numbers, *added], settings)


def score(model):
    """Its gaps."""
    fit_gap, held_out = model.gap
    return Score(fit_gap, held_out if held_out == held_out else None)


def law():
    """The law that is hidden, with a band of 2 %, and what the runs for fitting say."""
    speed = np.linspace(0.0, 0.3, 31)
    mean = -0.8 * (speed - 0.1)
    at = np.array([0.05, 0.11, 0.19])
    points = np.stack([at, -0.8 * (at - 0.1) + [0.01, -0.01, 0.0], [0.01, 0.02, 0.01]], axis=1)
    return Law(
        "velocity_weakening", "sliding speed", "m/s", "mu_k", speed, mean, np.full(31, 0.012),
        points, ("run01", "run02", "run03"), "linear", mean + 0.004,
    )  # fmt: skip


def other(gap, verdict):
    """The same runs with another verdict."""
    first, last = gap.ladder
    members = ("velocity_weakening", "film_drag")
    asked = {"text": "0.87 kg at 0.4 m/s for 20 s: velocity_weakening and film_drag would differ"}
    bare = dict(effects=(), ladder=(first,), extended=gap.plain, laws=(), exponents=(),
                rates=None)  # fmt: skip
    changes = {
        "named": {},
        "none": bare | dict(sentence="Nothing is missing."),
        "unknown": bare
        | dict(sentence="The model does not fit, and no effect of the catalogue repairs it."),
        "class": dict(
            effects=members, classes=(members,), next_experiment=asked,
            sentence="velocity_weakening or film_drag is missing; these runs cannot tell which.",
        ),
        "partial": dict(
            ladder=(first, replace(last, gap=Score(2.3, 2.8), share=0.83)),
            sentence="velocity_weakening takes 83 % of the misfit; something else is missing.",
        ),
    }  # fmt: skip
    return replace(gap, verdict=verdict, **changes[verdict])


def with_a_fault(gap, **numbers):
    """A measurement fault is named; numbers : scale=0.02, ..."""
    values = {f"measurement.{name}": value for name, value in numbers.items()}
    name = "measurement." + next(iter(numbers)).partition("_")[0]
    extended = replace(
        gap.extended,
        values=gap.extended.values | values,
        sd=gap.extended.sd | {key: 0.02 * abs(value) for key, value in values.items()},
        runs=tuple(replace(run, values=run.values | values) for run in gap.extended.runs),
    )
    rung = replace(gap.ladder[-1], name=name, text="the camera's scale is off")
    return replace(
        gap, effects=(name,), extended=extended, ladder=(*gap.ladder, rung),
        sentence=f"The camera is off: {name}.",
    )  # fmt: skip


def without_held_out(gap):
    """Nothing was held out: no gap of it, and no run."""
    runs = {run.name for run in gap.campaign.runs if not run.hold_out}
    campaign = replace(
        gap.campaign, runs=tuple(run for run in gap.campaign.runs if run.name in runs)
    )
    ladder = [
        replace(rung, gap=Score(rung.gap.fit, None), weak=Score(rung.weak.fit, None))
        for rung in gap.ladder
    ]
    ranking = [replace(row, gap=row.gap and Score(row.gap.fit, None)) for row in gap.ranking]
    plain, extended = (
        replace(model, runs=tuple(run for run in model.runs if run.name in runs))
        for model in (gap.plain, gap.extended)
    )
    return replace(
        gap, campaign=campaign, plain=plain, extended=extended, ladder=tuple(ladder),
        ranking=tuple(ranking),
    )  # fmt: skip


def words_of(html):
    """A page's text: without tags, scripts and styles."""
    body = re.sub(r"<(style|script)\b.*?</\1>", "", html[html.index("<main") :], flags=re.S)
    return re.sub(r"\s+", " ", unescape(re.sub(r"<[^>]+>", " ", body)))
