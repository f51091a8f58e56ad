"""An ingredient of a hidden campaign: what it changes in every run, at a strength of 0 to 1."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .hidden import Hidden, State


@dataclass(frozen=True)
class Ingredient:
    """An effect of the catalogue, or one out of it: its shape drawn, its size open.

    Attributes
    ----------
    id : what the product should name, or what it has no name for
    form : which formula was drawn
    change : Hidden and strength (0 to 1) to Hidden: the run with the effect
    plane : whether the block leaves the line
    start : State and strength to State, where the effect needs a push to be seen
    pixel : x in m and strength to the x that the tracker reports, m
    sized : whether a larger strength makes a larger disagreement
    known : whether only friction coefficients that are known beforehand can show it
    """

    id: str
    form: str
    change: Callable[[Hidden, float], Hidden]
    plane: bool = False
    start: Callable[[State, float], State] = lambda state, strength: state
    pixel: Callable[[np.ndarray, float], np.ndarray] | None = None
    sized: bool = True
    known: bool = False


def between(rng: np.random.Generator, low: float, high: float) -> float:
    """A number drawn evenly in the logarithm."""
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def either(rng: np.random.Generator) -> float:
    """+1 or -1."""
    return float(rng.choice((-1.0, 1.0)))
