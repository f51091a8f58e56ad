"""A model with a candidate added to it, starting where the model was fitted."""

from __future__ import annotations

from dataclasses import replace

from cosim.gap.shooting.knob import Knob
from cosim.gap.shooting.trial import Model

from .candidate import Candidate

#: A fit that ended nearer to a bound than this has run into it.
_INSIDE = 1.02


def extended(base: Model, candidate: Candidate, fitted: dict[str, float]) -> Model:
    """The base, starting where it was fitted, with the candidate's knobs."""
    taken = {knob.key for knob in candidate.knobs}
    kept = tuple(moved(knob, fitted) for knob in base.knobs if knob.key not in taken)
    return Model(kept + candidate.knobs, {**base.settings, **candidate.settings})


def moved(knob: Knob, fitted: dict[str, float]) -> Knob:
    """The knob starting where it was fitted, if that is inside its range.

    One with a prior stays centred on it.
    """
    if knob.prior is not None or knob.key not in fitted:
        return knob
    if not knob.low * _INSIDE < fitted[knob.key] < knob.high / _INSIDE:
        return knob
    return replace(knob, start=min(max(fitted[knob.key], knob.low), knob.high))
