"""Kinetic friction drifts with the distance slid: wear, polishing, wetting.

mu_k (1 + r (1 - exp(-s / D)))
"""

from __future__ import annotations

from collections.abc import Iterator
from math import exp

from ...quantity import Table, quantity
from ..candidate import Candidate, FreeParameter, Scales
from ..effect import Case, Effect


class RunIn(Table):
    """Kinetic friction drifts with the distance slid: wear, polishing, wetting."""

    change: float = quantity(
        0.0, "1", "final change of mu_k, part of it", ge=-0.95, le=5, typical=(-0.5, 0.5)
    )
    distance: float = quantity(
        1.0,
        "m",
        "distance over which the change is approached exponentially",
        gt=0,
        tried=(0.1, 3.0),
    )


def kinetic_factor(slid: float, change: float, distance: float) -> float:
    """mu_k over its value at the start."""
    return 1.0 + change * (1.0 - exp(-slid / distance))


def candidates(s: Scales) -> Iterator[Candidate]:
    """A growth or a fall, over a tenth or half of a run."""
    for share in (0.1, 0.5):
        for change in (0.1, -0.1):
            yield Candidate(
                "run_in",
                "exponential",
                (
                    FreeParameter("run_in.change", change, 0.1, -0.95, 5.0),
                    FreeParameter(
                        "run_in.distance",
                        share * s.distance,
                        0.5,
                        1e-3 * s.distance,
                        1e2 * s.distance,
                        log=True,
                    ),
                ),
            )


EFFECT = Effect(
    id="run_in",
    table=RunIn,
    switch=("change",),
    enters="friction",
    source="wear, polishing and wetting, named by the source study",
    terms=(kinetic_factor,),
    candidates=candidates,
    case=Case({"change": -0.5}, window=(0.0, 8.0)),
)
