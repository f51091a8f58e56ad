"""Confounders: what is not in the catalogue and has the same signature as something that is.

A rig that is tilted sideways pulls a block off its line as crooked springs do, but in proportion to
its mass and whatever the springs; runs of several masses or stiffnesses tell.
"""

from __future__ import annotations

from stickslip.effects.candidate import Candidate, FreeParameter

from cosim.gap.estimation.fitted import Fitted
from cosim.gap.estimation.segmented_run import TILT
from cosim.gap.estimation.trial import Trial

from .criteria import as_good, excess_chi_square
from .search import Search
from .tried import ACROSS, Tried

#: By effect of the catalogue: what is confounded with it.
_CONFOUNDERS = {
    "spring_misalignment": tuple(
        Candidate(
            "a rig tilted sideways",
            "tilt",
            (FreeParameter(TILT, sine, 0.005, -0.3, 0.3),),
            across,
            lateral=True,
        )
        for across in ({}, {ACROSS: 1.0})
        for sine in (0.01, -0.01)
    ),
}


def better_confounder(search: Search, plain: Trial, coarse: Fitted, best: Tried) -> Tried | None:
    """What does clearly better than an effect without being in the catalogue, or None.

    coarse : the plain model in short segments
    """
    laws = _CONFOUNDERS.get(best.candidate.effect, ())
    if not laws:
        return None
    other = min(
        (t for t in search.on(plain.model, coarse, laws) if t.judged is not None),
        key=lambda t: t.trial.rms_residual,
    )
    clearly = (
        best.trial.rms_residual**2 > as_good(other.trial) and excess_chi_square(best.trial) > 0.0
    )
    return other if clearly else None
