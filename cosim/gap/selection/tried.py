"""A law tried on top of a model, and how the evidence for it is counted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from stickslip.effects.candidate import Candidate

from cosim.gap.evidence.settled import Settled


@dataclass(frozen=True)
class Tried:
    """A candidate on top of a model.

    Attributes
    ----------
    candidate : the law
    gain : by how much -2 ln evidence is less with it, as far as it was looked at
    settled : the model with it at its best; None where the screening ruled it out
    """

    candidate: Candidate
    gain: float
    settled: Settled | None = None

    @property
    def model(self) -> Settled:
        """At its best; ValueError where it was ruled out before."""
        if self.settled is None:
            raise ValueError(f"{self.candidate.effect}: ruled out by the screening")
        return self.settled


def gain(one: Settled, other: Settled) -> float:
    """By how much -2 ln evidence of all runs is less with ``one`` than with ``other``."""
    return other.evidence - one.evidence


def by_run(one: Settled, other: Settled) -> np.ndarray:
    """(runs,) the same, of every run as the others predict it."""
    return other.left_out - one.left_out


def best_of_effects(tried: Sequence[Tried]) -> list[Tried]:
    """The best law of each effect, best first."""
    best: dict[str, Tried] = {}
    for each in sorted(tried, key=lambda t: (t.settled is None, -t.gain)):
        best.setdefault(each.candidate.effect, each)
    return list(best.values())
