"""Every law of the catalogue by algebra: what it would do for a model, were it linear in it.

A law is put into the aligned model as next to nothing; what answers to that, less all that the
model's own numbers can take up, says how strong it would be and what evidence there is for it
(a score test, Rao 1948, with the spreads of friction at their best beside it).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from stickslip.effects.candidate import Candidate

from cosim.gap.evidence.mixed import Law, MixedModel
from cosim.gap.evidence.products import mixed_model
from cosim.gap.evidence.settled import Settled, best_spreads
from cosim.processes import Map

#: Part of its usual start at which a law's answer is taken.
FAINT = 0.004
#: Usual strength of a law, in such parts.
_USUAL = 5.0 / FAINT
#: Into so many parts laws are divided among processes, each of which is sent the base.
_PARTS = 4
#: Steps of the search for spreads beside a law.
_STEPS = 6


def faint(law: Candidate) -> Candidate:
    """The law as next to nothing; a filter, which is felt by its square, as it sets out."""
    return law if law.effect == "measurement.smoothing" else law.times(FAINT)


def screened(
    base: Settled, laws: Sequence[Candidate], held_out: Sequence[bool], mapped: Map
) -> np.ndarray:
    """(laws,) by how much -2 ln evidence would be less with each."""
    if not laws:
        return np.empty(0)
    mixed = mixed_model(base.problem, base.fitted, [faint(law) for law in laws], held_out, mapped)
    whole = np.arange(len(laws))
    parts = [part.tolist() for part in np.array_split(whole, min(len(laws), _PARTS))]
    tasks = [(base, mixed.only(part), [laws[i] for i in part]) for part in parts]
    return np.concatenate(list(mapped(_gains, tasks)))


def _gains(base: Settled, mixed: MixedModel, laws: Sequence[Candidate]) -> np.ndarray:
    return np.array([_gain(base, mixed.only([i]), law) for i, law in enumerate(laws)])


def _gain(base: Settled, mixed: MixedModel, law: Candidate) -> float:
    first = law.free_parameters[0]
    column = Law(0, 0.0 if first.low >= 0.0 else -np.inf, _USUAL)
    _, deviance = best_spreads(
        mixed,
        base.problem,
        base.fitted,
        base.model.free_parameters,
        base.ahead,
        [column],
        _STEPS,
    )
    return base.promised - deviance
