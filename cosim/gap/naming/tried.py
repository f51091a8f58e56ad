"""A law tried on top of a model, and which of several are worth another look."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from stickslip.effects.candidate import Candidate

from cosim.gap.shooting.fitted import Fitted
from cosim.gap.shooting.trial import Model, Trial

#: Where a law leaves less than this part of the misfit, others are out that leave more than that.
NEARLY_ALL, HOPELESS = 0.1, 0.5
#: The setting by which friction acts across the motion.
ACROSS = "lateral_friction.ratio"


@dataclass(frozen=True)
class Tried:
    """A candidate on top of a base model; `trial` is None where a shorter look ruled it out."""

    candidate: Candidate
    model: Model
    sketched: Fitted
    trial: Trial | None = None


def penalised(fitted: Fitted) -> float:
    """Sum of squares and the BIC's penalty for the campaign's free parameters."""
    rows = sum(r.size for r in fitted.residuals)
    count = sum(not free_parameter.per_run for free_parameter in fitted.free_parameters)
    return fitted.cost + count * float(np.log(max(rows, 2)))


def best_laws(tried: Sequence[Tried], most: int, key=None) -> list[Tried]:
    """The best laws of each effect, best first."""
    counts: dict[str, int] = {}
    best = []
    for t in sorted(tried, key=key or (lambda t: penalised(t.sketched))):
        counts[t.candidate.effect] = counts.get(t.candidate.effect, 0) + 1
        if counts[t.candidate.effect] <= most:
            best.append(t)
    return best


def rank(tried: Tried, seen: Sequence[Tried]) -> int:
    """How many laws of its effect did better."""
    cost = penalised(tried.sketched)
    return sum(
        t.candidate.effect == tried.candidate.effect and penalised(t.sketched) < cost for t in seen
    )


def in_the_running(tried: Sequence[Tried], fitted: Fitted) -> list[Tried]:
    """Best first, without those that do little where the best does nearly all.

    fitted : the base
    """
    before = fitted.gap() ** 2 - 1.0
    left = [max(t.sketched.gap() ** 2 - 1.0, 0.0) for t in tried]
    if not tried or min(left) > NEARLY_ALL * before:
        return list(tried)
    return [t for t, rest in zip(tried, left, strict=True) if rest <= HOPELESS * before]
