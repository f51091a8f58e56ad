"""What is not in the catalogue and looks like something that is: whether it does better.

A rig that is tilted sideways pulls a block off its line as crooked springs do, but in proportion to
its mass and whatever the springs; runs of several masses or stiffnesses tell.
"""

from __future__ import annotations

from stickslip.effects.candidate import Candidate, FreeParameter

from cosim.gap.shooting.fitted import Fitted
from cosim.gap.shooting.flight import TILT
from cosim.gap.shooting.trial import Trial

from .measures import as_good, excess
from .search import Search
from .tried import ACROSS, Tried

#: By effect of the catalogue: what looks like it.
_LOOKALIKES = {
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


def better_lookalike(search: Search, plain: Trial, sketched: Fitted, best: Tried) -> Tried | None:
    """What does clearly better than an effect without being in the catalogue, or None.

    sketched : the plain model in short windows
    """
    laws = _LOOKALIKES.get(best.candidate.effect, ())
    if not laws:
        return None
    other = min(
        (t for t in search.on(plain.model, sketched, laws) if t.trial is not None),
        key=lambda t: t.trial.gap,
    )
    clearly = best.trial.gap**2 > as_good(other.trial) and excess(best.trial) > 0.0
    return other if clearly else None
