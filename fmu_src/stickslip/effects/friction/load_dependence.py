"""Friction coefficients fall (or grow) with the normal force: mu (N / N_0)^-n."""

from __future__ import annotations

from collections.abc import Iterator

from ...quantity import Table, quantity
from ..candidate import Candidate, FreeParameter, Scales
from ..effect import Case, Effect


class LoadDependence(Table):
    """Friction coefficients fall (or grow) with the normal force."""

    exponent: float = quantity(
        0.0, "1", "n of mu (N / reference_force)^-n", ge=-2, le=2, typical=(-0.5, 0.5)
    )
    reference_force: float = quantity(
        6.57,
        "N",
        "normal force at which mu_s and mu_k hold (0.67 kg)",
        gt=0,
        tried=(3.0, 12.0),
    )


def coefficient_factor(normal_force: float, reference_force: float, exponent: float) -> float:
    """mu_s and mu_k over their values at the reference force."""
    return (normal_force / reference_force) ** -exponent


def candidates(s: Scales) -> Iterator[Candidate]:
    """Falling or growing from the campaign's own mean."""
    for sign in (0.1, -0.1):
        yield Candidate(
            "load_dependence",
            "power law",
            (FreeParameter("load_dependence.exponent", sign, 0.1, -2.0, 2.0),),
            {"load_dependence.reference_force": s.force},
        )


EFFECT = Effect(
    id="load_dependence",
    table=LoadDependence,
    switch=("exponent",),
    enters="friction",
    source="the source study's literature: friction of ice falls with the load",
    terms=(coefficient_factor,),
    candidates=candidates,
    case=Case({"exponent": 0.3}, {"rig": {"mass": 1.2}}),
)
