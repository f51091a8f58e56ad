"""Friction passes a peak as the sliding speed grows: a belt of rubber loses most at one speed.

Asperities deform a viscoelastic belt at a frequency that grows with the speed, and its losses have
a peak there (Grosch, Proc. R. Soc. A 274, 1963). On a logarithmic axis the friction is a bell,

    mu_k (1 + c exp(-(h log10(v / v_p))^2)),

as Savkoor fitted it (Wear 8, 1965). At rest, and far from the peak, mu_k is what is left.
"""

from collections.abc import Iterator
from math import exp, log10

from ...quantity import Table, quantity
from ..effect import Candidate, Case, Effect, FormsOf, Scales


class ViscoelasticPeak(Table):
    """Kinetic friction has a peak at one sliding speed: a belt of rubber loses most there.

    height : c, height of the peak above mu_k, as part of mu_k
    peak_speed : v_p, speed of the peak
    narrowness : h: 1/h decades from the peak, 1/e of its height is left
    """

    height: float = quantity(0.0, "1", ge=0, le=10, typical=(0.1, 2))
    peak_speed: float = quantity(0.1, "m/s", gt=0, le=100, typical=(0.01, 1.0))
    narrowness: float = quantity(1.0, "1", ge=0.1, le=10, tried=(0.3, 2.0))


def dry_factor(speed: float, height: float, peak_speed: float, narrowness: float) -> float:
    """mu_k at a local sliding speed over its value at rest."""
    if speed <= 0.0:
        return 1.0
    away = narrowness * log10(speed / peak_speed)
    return 1.0 + height * exp(-away * away)


own = FormsOf("viscoelastic_peak")


def candidates(s: Scales) -> Iterator[Candidate]:
    """A peak below the campaign's speed, and one above it."""
    height = own.free("height", 0.3, 0.1, 0.0, 10.0)
    low, high = 1e-2 * s.speed, 1e2 * s.speed
    for share in (0.3, 3.0):
        speed = own.free("peak_speed", share * s.speed, 0.4, low, high, log=True)
        yield own.form("bell over the logarithm", height, speed)


EFFECT = Effect(
    id="viscoelastic_peak",
    table=ViscoelasticPeak,
    switch=("height",),
    enters="friction",
    axis="sliding speed",
    source="Grosch, Proc. R. Soc. A 274 (1963), rubber; the bell: Savkoor, Wear 8 (1965)",
    terms=(dry_factor,),
    candidates=candidates,
    offered=False,
    case=Case({"height": 0.5, "peak_speed": 0.1}),
)
