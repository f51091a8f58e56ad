"""Motions of the runs of a plan with ingredients at given strengths."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .ingredients import Ingredient
from .layouts import Plan, Run
from .simulator.disc import disc_points
from .simulator.hidden import Hidden, State
from .simulator.line import walk_line
from .simulator.plane import walk_plane

DENSE = 1e-3  # s between the rows of a motion
# s, step along the line and in the plane; the walks are of first order, and every break-away that
# is late by a part of a step leaves its mark: in five seconds half a usual tracker's noise
FINE = {False: 1e-6, True: 4e-6}
COARSE = {False: 2e-5, True: 4e-5}  # for the search of a strength


@dataclass(frozen=True)
class Motion:
    """What one run really did: rows every DENSE seconds, columns as `line.COLUMNS`."""

    run: Run
    rows: np.ndarray
    x: np.ndarray  # as the tracker's optics show it, without noise


def needs_plane(plan: Plan, ingredients: Sequence[Ingredient]) -> bool:
    """Whether anything moves the block off the line."""
    return any(each.plane for each in ingredients) or any(run.start.y for run in plan.runs)


def built(run: Run, ingredients: Sequence[Ingredient], strengths) -> tuple[Hidden, State]:
    """Properties and start of a run with its ingredients in."""
    p, start = run.hidden, run.start
    for each, strength in zip(ingredients, strengths, strict=True):
        p, start = each.change(p, strength), each.start(start, strength)
    return p, start


def walk(p: Hidden, start: State, plane: bool, step: float, rows: int) -> np.ndarray:
    """Rows every DENSE seconds of one motion."""
    every = round(DENSE / step)
    # one type for numba, whatever numbers an ingredient has set
    p, start = Hidden(*map(float, p)), State(*map(float, start))
    if plane:
        return walk_plane(p, start, disc_points(p.radius), step, every, rows)
    return walk_line(p, start, step, every, rows)


def move(plan: Plan, ingredients: Sequence[Ingredient], strengths, steps=FINE) -> list[Motion]:
    """All runs of a plan."""
    plane = needs_plane(plan, ingredients)
    rows, motions = round(plan.duration / DENSE), []
    for run in plan.runs:
        path = walk(*built(run, ingredients, strengths), plane, steps[plane], rows)
        x = path[:, 0]
        for each, strength in zip(ingredients, strengths, strict=True):
            if each.pixel is not None:
                x = each.pixel(x, strength)
        motions.append(Motion(run, path, x))
    return motions
