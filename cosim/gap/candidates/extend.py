"""A model with a candidate added to it, starting where the model was fitted."""

from __future__ import annotations

from dataclasses import replace

from cosim.gap.shooting.knob import Knob
from cosim.gap.shooting.trial import Model

from .candidate import Candidate

#: A fit that ended nearer to a bound than this has run into it.
_INSIDE = 1.02
#: mu_s of so many mu_k is felt; where it is not, it is set to as many as is usual.
_FELT, _USUAL = 1.05, 1.3


def extended(base: Model, candidate: Candidate, fitted: dict[str, float]) -> Model:
    """The base, starting where it was fitted, with the candidate's knobs."""
    fitted = _holding(fitted)
    taken = {knob.key for knob in candidate.knobs}
    kept = tuple(moved(knob, fitted) for knob in base.knobs if knob.key not in taken)
    return Model(kept + candidate.knobs, {**base.settings, **candidate.settings}, base.added + 1)


def _holding(fitted: dict[str, float]) -> dict[str, float]:
    """With a mu_s that the motion feels: one below mu_k is as good as any other there."""
    mu_s, mu_k = fitted.get("friction.mu_s"), fitted.get("friction.mu_k")
    if mu_s is None or mu_k is None or mu_s > _FELT * mu_k:
        return fitted
    return {**fitted, "friction.mu_s": _USUAL * mu_k}


def moved(knob: Knob, fitted: dict[str, float]) -> Knob:
    """The knob starting where it was fitted, if that is inside its range.

    One with a prior stays centred on it.
    """
    if knob.prior is not None or knob.key not in fitted:
        return knob
    if not knob.low * _INSIDE < fitted[knob.key] < knob.high / _INSIDE:
        return knob
    return replace(knob, start=min(max(fitted[knob.key], knob.low), knob.high))
