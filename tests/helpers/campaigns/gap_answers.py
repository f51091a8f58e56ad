"""An answer of the gap workflow, made by hand from real fits of a small campaign."""

from dataclasses import replace
from functools import cache

import numpy as np
from gap_campaigns import NOISE, motion, noisy, write_campaign
from stickslip.effects.candidate import FreeParameter

from cosim.gap import read_campaign
from cosim.gap.curves.curve import Curve
from cosim.gap.diagnostics import analyse_residuals, find_where
from cosim.gap.estimation.fit import fit
from cosim.gap.estimation.fitted import Point, start
from cosim.gap.estimation.preparation import prepare
from cosim.gap.estimation.problem import Problem
from cosim.gap.fitted_model import fitted_model
from cosim.gap.result import Gap, Law, Ranked, Step

TRUE = {"velocity_weakening": {"linear": 0.8}}
PLAIN = (
    FreeParameter("friction.mu_s", 0.29, 0.01, 0.0, 2.0),
    FreeParameter("friction.mu_k", 0.19, 0.01, 0.0, 2.0),
    FreeParameter("offset.x", 0.0, 4e-4, prior=4e-4),
)
ADDED = FreeParameter("velocity_weakening.linear", 0.7, 0.1, 0.0, 5.0)
SPEEDS = (0.06, 0.12, 0.2)


@cache
def answer(folder):
    """velocity_weakening, named, found in three runs of six seconds; the last is held out."""
    campaign = read_campaign(write(folder))
    plain = fitted(campaign, PLAIN)
    extended = fitted(campaign, (*PLAIN, ADDED))
    intervals = {
        key: (0.98 * value, 1.02 * value)
        for key, value in extended.values.items()
        if not key.startswith("offset")
    }
    extended = replace(extended, intervals=intervals)
    key = ADDED.key
    found = Ranked(
        "velocity_weakening",
        "linear",
        extended.gap[1],
        extended.gap[0],
        1234.56789,
        {key: extended.values[key]},
        {key: intervals[key]},
        0.9995,
    )
    other = Ranked(
        "film_drag",
        "linear",
        1.01 * plain.gap[1],
        plain.gap[0],
        -3.0,
        {"film_drag.coefficient": 0.0},
        {"film_drag.coefficient": (0.0, np.inf)},
        4e-4,
    )
    analysis = analyse_residuals([run.track for run in plain.runs])
    determined = {k: (v, 0.9 * v, 1.1 * v) for k, v in plain.values.items() if "friction" in k}
    return Gap(
        campaign,
        "named",
        ("velocity_weakening",),
        (),
        find_where(analysis),
        (found, other, RULED_OUT),
        plain.gap,
        extended.gap,
        plain,
        extended,
        determined,
        ladder=(
            Step((), 0.0, *plain.gap, 0.0),
            Step(("velocity_weakening",), 1234.5, *extended.gap, 0.998, CERTAIN),
        ),
        share=0.998,
        spreads={"friction_from_run_to_run": 0.021},
        laws=(Law("velocity_weakening", _curve()),),
        remains=find_where(analyse_residuals([run.track for run in extended.runs])),
        analysis=analysis,
        remarks=("a remark",),
    )


#: As the screening leaves an effect that it rules out.
RULED_OUT = Ranked("run_in", "exponential", None, None, -9.0, {}, {}, 1e-4)
CERTAIN = {"velocity_weakening": 1.0}


def _curve():
    """The law that is hidden, with a band of 2 %."""
    speed = np.linspace(0.0, 0.4, 41)
    mean = -TRUE["velocity_weakening"]["linear"] * speed
    mean -= mean.mean()
    band = mean - 0.02, mean + 0.02
    return Curve("sliding speed", "mu_k", speed, mean, *band, 900.0, 200.0, np.ones(3), 0.2)


def write(folder):
    """A campaign on disk."""
    runs = []
    for number, speed in enumerate(SPEEDS):
        run = motion(speed=speed, duration=6.0, **TRUE)
        runs.append(
            {
                "surface_speed": speed,
                "hold_out": number == len(SPEEDS) - 1,
                "columns": {"t": run.time, "x": noisy(run["x"], number)},
            }
        )
    return write_campaign(folder, runs, name="cold room, week 3", noise={"x": NOISE})


def fitted(campaign, free_parameters):
    """Fitted to the runs for fitting, their states to those held out."""
    problem = Problem(prepare(campaign, campaign.fit_runs, False), free_parameters)
    at = fit(problem, start(problem.segmented_runs, free_parameters))
    held = Problem(prepare(campaign, campaign.held_out_runs, False), free_parameters)
    first = start(held.segmented_runs, free_parameters)
    other = fit(held, Point(at.point.shared, first.own, first.states), fixed=True)
    return fitted_model(campaign, [(problem, at), (held, other)])
