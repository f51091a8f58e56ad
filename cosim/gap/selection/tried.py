"""A law tried on top of a model, and which of several are worth a closer fit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from stickslip.effects.candidate import Candidate

from cosim.gap.estimation.fitted import Fitted, shared_of
from cosim.gap.estimation.trial import Model, Trial

#: Where a law leaves less than this part of the misfit, others are out that leave more than that.
NEARLY_ALL, HOPELESS = 0.1, 0.5
#: The setting by which friction acts across the motion.
ACROSS = "lateral_friction.ratio"


@dataclass(frozen=True)
class Tried:
    """A candidate on top of a base model.

    Attributes
    ----------
    coarse : its fit in short segments
    judged : its trial in long ones; None where the coarse fit ruled it out
    """

    candidate: Candidate
    model: Model
    coarse: Fitted
    judged: Trial | None = None

    @property
    def trial(self) -> Trial:
        """Its trial; ValueError where the coarse fit ruled it out."""
        if self.judged is None:
            raise ValueError(f"{self.candidate.effect}: ruled out before it was judged")
        return self.judged


def penalised(fitted: Fitted) -> float:
    """Sum of squares and the BIC's penalty for the campaign's free parameters."""
    rows = sum(r.size for r in fitted.residuals)
    count = len(shared_of(fitted.free_parameters))
    return fitted.cost + count * float(np.log(max(rows, 2)))


def best_laws(tried: Sequence[Tried], most: int, key=None) -> list[Tried]:
    """The best laws of each effect, best first."""
    counts: dict[str, int] = {}
    best = []
    for t in sorted(tried, key=key or (lambda t: penalised(t.coarse))):
        counts[t.candidate.effect] = counts.get(t.candidate.effect, 0) + 1
        if counts[t.candidate.effect] <= most:
            best.append(t)
    return best


def rank(tried: Tried, seen: Sequence[Tried]) -> int:
    """How many laws of its effect did better."""
    cost = penalised(tried.coarse)
    return sum(
        t.candidate.effect == tried.candidate.effect and penalised(t.coarse) < cost for t in seen
    )


def in_the_running(tried: Sequence[Tried], fitted: Fitted) -> list[Tried]:
    """Best first, without those that do little where the best does nearly all.

    fitted : the base
    """
    before = fitted.rms_residual() ** 2 - 1.0
    left = [max(t.coarse.rms_residual() ** 2 - 1.0, 0.0) for t in tried]
    if not tried or min(left) > NEARLY_ALL * before:
        return list(tried)
    return [t for t, rest in zip(tried, left, strict=True) if rest <= HOPELESS * before]
