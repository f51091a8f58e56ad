"""An effect once more by its other laws, from the numbers that one of them was fitted with."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from stickslip.effects.candidate import Candidate

from cosim.gap.candidates.extend import extended, moved, reduced

from .tried import Tried


def other_laws(tried: Tried, candidates: Sequence[Candidate]) -> list[Tried]:
    """The effect's other laws, as far as they can be said with the numbers fitted."""
    values = {**tried.model.settings, **tried.trial.fitted.values}
    own = {free_parameter.key for free_parameter in tried.candidate.free_parameters}
    base = reduced(tried.model, tried.candidate, values, ())
    laws: dict[tuple, Tried] = {}
    for law in candidates:
        if law.effect == tried.candidate.effect and law.form != tried.candidate.form:
            if law.periodic and law.periodic not in own:
                continue
            told = any(free_parameter.key in values for free_parameter in law.free_parameters[:1])
            law = replace(
                law,
                free_parameters=tuple(
                    moved(free_parameter, values) for free_parameter in law.free_parameters
                ),
                grows=0.0 if told else law.grows,
            )
            model = extended(base, law, values)
            key = (law.free_parameters, *law.settings.items())
            laws.setdefault(key, replace(tried, candidate=law, model=model))
    return list(laws.values())
