"""Whether the run that the product proposes would separate film drag from structural damping."""

from __future__ import annotations

import numpy as np

from .campaign import Campaign
from .layouts import Run, start_of
from .motion import FINE, built, walk
from .simulator.hidden import Hidden

ROWS = 20000  # 20 s


def twin(p: Hidden, speed: float) -> Hidden:
    """The other law with the same forces at one sliding surface speed, where it has one.

    c (v - x') is the damping -c x' and a constant c v, which the kinetic friction can stand for.
    """
    weight = 9.81 * p.mass
    if p.drag > 0.0:
        return p._replace(drag=0.0, damping=p.drag, mu_k=p.mu_k + p.drag * abs(speed) / weight)
    return p._replace(damping=0.0, drag=p.damping, mu_k=p.mu_k - p.damping * abs(speed) / weight)


def separation(campaign: Campaign, proposed: dict) -> float:
    """Difference of mean and of range of x between the two laws in the proposed run, noise units.

    proposed holds any of mass, stiffness, surface_speed; the larger difference counts. Not a
    number where the hidden law has no twin (a drag that grows with the root of the speed).
    """
    first = campaign.plan.runs[0]
    hidden, _ = built(first, campaign.ingredients, campaign.strengths)
    if hidden.root_drag > 0.0:
        return float("nan")
    names = {"mass": "mass", "stiffness": "stiffness", "surface_speed": "speed"}
    change = {field: float(proposed[key]) for key, field in names.items() if key in proposed}
    paths = []
    for p in (hidden, twin(hidden, hidden.speed)):
        new = p._replace(**change)
        new = new._replace(inertia=p.inertia * new.mass / p.mass)
        run = Run(new, start_of(new, np.random.default_rng(0), "pulled"), False)
        paths.append(walk(new, run.start, False, FINE[False], ROWS)[:, 0])
    means, ranges = [path.mean() for path in paths], [np.ptp(path) for path in paths]
    return float(max(abs(np.subtract(*means)), abs(np.subtract(*ranges))) / campaign.tracker.noise)
