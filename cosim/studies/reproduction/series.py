"""The study's series: every combination of its stiffnesses, masses and speeds."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product

import numpy as np

from .cases import (
    DATASET_2,
    LAW_ASSUMED,
    MASSES,
    MASSES_ASSUMED,
    SPEEDS,
    STIFFNESS_ASSUMED,
    STIFFNESSES,
    WEAKENING,
    Case,
    three_models,
)
from .motion import MotionFigures

#: All of the series have the second set's friction, falling with the sliding speed.
CASE = DATASET_2.changed(weakening=WEAKENING)
ASSUMED = (LAW_ASSUMED, MASSES_ASSUMED, STIFFNESS_ASSUMED)

Grid = dict[str, np.ndarray]  # model -> number (stiffness, mass, speed)


def cases(stiffnesses: Sequence[float] = STIFFNESSES) -> list[Case]:
    """The combinations, the speed running fastest."""
    return [
        CASE.changed(stiffness=k, mass=m, speed=v)
        for k, m, v in product(stiffnesses, MASSES, SPEEDS)
    ]


def grid(
    number: Callable[[Case, MotionFigures], float], stiffnesses: Sequence[float] = STIFFNESSES
) -> Grid:
    """A number of every combination's steady motion, as each of the three models has it."""
    every = cases(stiffnesses)
    shape = len(stiffnesses), len(MASSES), len(SPEEDS)
    return {
        model: np.reshape([number(*pair) for pair in zip(every, figures, strict=True)], shape)
        for model, figures in three_models(every).items()
    }
