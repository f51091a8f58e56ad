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
    tasks = [(base, mixed.only(number), law) for number, law in enumerate(laws)]
    return np.array(list(mapped(_gain, tasks)))


def _gain(base: Settled, mixed: MixedModel, law: Candidate) -> float:
    first = law.free_parameters[0]
    column = Law(0, 0.0 if first.low >= 0.0 else -np.inf, _USUAL)
    _, deviance = best_spreads(
        mixed,
        base.problem,
        base.fitted,
        base.model.free_parameters,
        base.spreads,
        [column],
        _STEPS,
    )
    return base.promised - deviance
