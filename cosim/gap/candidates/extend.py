"""A model with a candidate added to it, starting where the model was fitted."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from stickslip.effects.candidate import Candidate, FreeParameter

from cosim.gap.estimation.trial import Model

#: A fit that ended nearer to a bound than this has run into it.
_INSIDE = 1.02
#: mu_s of so many mu_k is felt; where it is not, it is set to as many as is usual.
_FELT, _USUAL = 1.05, 1.3
#: Part of what mu_s has over mu_k that is put down to the hold at first.
_GROWN = 0.3


def extended(base: Model, candidate: Candidate, fitted: Mapping[str, float]) -> Model:
    """The base, starting where it was fitted, with the candidate's free parameters."""
    candidate, fitted = _in_place_of_mu_s(base, candidate, _holding(fitted))
    taken = {free.key for free in candidate.free_parameters}
    kept = tuple(moved(free, fitted) for free in base.free_parameters if free.key not in taken)
    settings = {**base.settings, **candidate.settings}
    return replace(base, free_parameters=kept + candidate.free_parameters, settings=settings)


def _in_place_of_mu_s(base: Model, candidate: Candidate, fitted: Mapping[str, float]):
    """What grows in a hold sets out in place of a part of what mu_s has over mu_k.

    On top of all of it, the first break-aways would come late, and the fit go elsewhere.
    """
    stated = any(
        free.key == "friction.mu_s" and free.prior is not None for free in base.free_parameters
    )
    over = fitted.get("friction.mu_s", 0.0) - fitted.get("friction.mu_k", 0.0)
    if not candidate.grows or stated or over <= 0.0:
        return candidate, fitted
    first = replace(candidate.free_parameters[0], start=_GROWN * over / candidate.grows)
    moved_over = {**fitted, "friction.mu_s": fitted["friction.mu_s"] - _GROWN * over}
    return replace(candidate, free_parameters=(first, *candidate.free_parameters[1:])), moved_over


def _holding(fitted: Mapping[str, float]) -> Mapping[str, float]:
    """With a mu_s that the motion feels: one below mu_k is as good as any other there."""
    mu_s, mu_k = fitted.get("friction.mu_s"), fitted.get("friction.mu_k")
    if mu_s is None or mu_k is None or mu_s > _FELT * mu_k:
        return fitted
    return {**fitted, "friction.mu_s": _USUAL * mu_k}


def moved(free: FreeParameter, fitted: Mapping[str, float]) -> FreeParameter:
    """The free parameter starting where it was fitted, if that is inside its range.

    One with a prior stays centred on it.
    """
    if free.prior is not None or free.key not in fitted:
        return free
    if not free.low * _INSIDE < fitted[free.key] < free.high / _INSIDE:
        return free
    return replace(
        free,
        start=min(max(fitted[free.key], free.low), free.high),
    )
