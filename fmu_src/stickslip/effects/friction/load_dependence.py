"""Friction coefficients fall (or grow) with the normal force N.

    mu (N / N_0)^-n (1 + A / N) / (1 + A / N_0) max(0, 1 - c log10(N / N_0))

The power is that of deformed asperities (Archard, Proc. R. Soc. A 243, 1957); adhesion A presses
beside the load, so that there is a force of friction without any (Derjaguin, 1934); so much a
decade is how measured coefficients are often stated. mu_s and mu_k are those at N_0.
"""

from collections.abc import Iterator
from math import log10

from ...quantity import Table, quantity
from ..effect import Candidate, Case, Effect, FormsOf, Scales


class LoadDependence(Table):
    """Friction coefficients fall (or grow) with the normal force.

    exponent : n of mu (N / reference_force)^-n
    reference_force : normal force at which mu_s and mu_k hold (0.67 kg)
    adhesion : A, force that presses beside the load
    logarithmic : c, part of mu_s and mu_k lost per decade of the normal force, down to none left
    """

    exponent: float = quantity(0.0, "1", ge=-2, le=2, typical=(-0.5, 0.5))
    reference_force: float = quantity(6.57, "N", gt=0, tried=(3.0, 12.0))
    adhesion: float = quantity(0.0, "N", ge=0, typical=(0.1, 5.0))
    logarithmic: float = quantity(0.0, "1", ge=-2, le=2, typical=(0.05, 0.5))


def coefficient_factor(
    normal_force: float,
    reference_force: float,
    exponent: float,
    adhesion: float,
    logarithmic: float,
) -> float:
    """mu_s and mu_k over their values at the reference force."""
    factor = float((normal_force / reference_force) ** -exponent)
    factor *= (1.0 + adhesion / normal_force) / (1.0 + adhesion / reference_force)
    return factor * max(0.0, 1.0 - logarithmic * log10(normal_force / reference_force))


own = FormsOf("load_dependence")


def candidates(s: Scales) -> Iterator[Candidate]:
    """Falling or growing from the campaign's own mean, adhesion, or so much a decade."""
    much = 0.2 * s.force
    for form, free in (
        ("power law", own.free("exponent", 0.1, 0.1, -2.0, 2.0)),
        ("power law", own.free("exponent", -0.1, 0.1, -2.0, 2.0)),
        ("adhesion", own.free("adhesion", much, much, 0.0, 1e2 * much)),
        ("logarithmic", own.free("logarithmic", 0.2, 0.2, -2.0, 2.0)),
    ):
        yield own.form(form, free, reference_force=s.force)


EFFECT = Effect(
    id="load_dependence",
    table=LoadDependence,
    switch=("exponent", "adhesion", "logarithmic"),
    enters="friction",
    axis="load",
    source="the source study's literature: friction of ice falls with the load",
    terms=(coefficient_factor,),
    candidates=candidates,
    case=Case({"exponent": 0.3}, {"rig": {"mass": 1.2}}),
)
