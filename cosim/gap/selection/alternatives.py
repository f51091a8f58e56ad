"""A model once more by other laws of its effect, or from other starts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from stickslip.effects.candidate import Candidate

from cosim.gap.candidates.extend import extended, moved, reduced
from cosim.gap.estimation.trial import Model

from .tried import Tried


def other_laws(tried: Tried, candidates: Sequence[Candidate]) -> list[Tried]:
    """The effect's other laws, as far as they can be said with the numbers fitted."""
    values = {**tried.model.settings, **tried.trial.fitted.values}
    own = {free.key for free in tried.candidate.free_parameters}
    base = reduced(tried.model, tried.candidate, values, ())
    laws: dict[tuple, Tried] = {}
    for law in candidates:
        if law.effect == tried.candidate.effect and law.form != tried.candidate.form:
            if law.periodic and law.periodic not in own:
                continue
            told = any(free.key in values for free in law.free_parameters[:1])
            law = replace(
                law,
                free_parameters=tuple(moved(free, values) for free in law.free_parameters),
                grows=0.0 if told else law.grows,
            )
            model = extended(base, law, values)
            key = (law.free_parameters, *law.settings.items())
            laws.setdefault(key, replace(tried, candidate=law, model=model))
    return list(laws.values())


#: Starts of mu_s, as parts of mu_k.
_MU_S = (1.1, 1.3, 1.6)


def other_starts(model: Model, values: Mapping[str, float]) -> list[Model]:
    """The model starting where it was fitted, but for mu_s."""
    return [_from(model, values, part * values["friction.mu_k"]) for part in _MU_S]


def _from(model: Model, values: Mapping[str, float], mu_s: float) -> Model:
    free_parameters = []
    for free in model.free_parameters:
        if free.key == "friction.mu_s" and free.prior is None:
            free_parameters.append(replace(free, start=mu_s))
        else:
            free_parameters.append(free if free.per_run else moved(free, values))
    return replace(model, free_parameters=tuple(free_parameters))
