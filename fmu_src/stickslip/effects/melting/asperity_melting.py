"""Asperities that melt in passing limit mu_k: as (T_m - T) / sqrt(v), boundary friction.

Evans, Nye & Cheeseman, Proc. R. Soc. A (1976): mu_a = C e (T_m - T) / (H sqrt(l v)). Dry and
boundary friction blend as in Churchill & Usagi, AIChE J. 18 (1972), exponent 2, which is smooth
down to v = 0:
1 / mu^2 = 1 / mu_dry^2 + 1 / mu_a^2.
"""

from __future__ import annotations

from math import sqrt

from ...quantity import Table, quantity
from ..effect import Case, Effect


class AsperityMelting(Table):
    """Asperities that melt in passing limit mu_k: as (T_m - T) / sqrt(v), boundary friction.

    mu_a = C e (T_m - T) / (H sqrt(l v)): the heat mu_a H v of a contact of length l that slides for
    l / v warms ice of effusivity e from the interface temperature T to melting, 0 degC. mu_k is
    what is left as v -> 0, so mu_s >= mu_k stays the static value.
    """

    length: float = quantity(
        0.0,
        "m",
        "l, length of an asperity's contact along the sliding: that of a grain; 0 is off",
        ge=0,
        le=1,
        typical=(1e-4, 1e-2),
    )
    hardness: float = quantity(
        2e7,
        "Pa",
        "H, pressure that an asperity of ice bears: some 1e7 near melting to 3e7 in the cold",
        ge=1e3,
        le=1e10,
        typical=(3e6, 3e7),
    )
    effusivity: float = quantity(
        2034.0,
        "W.s0.5/(m2.K)",
        "e of the ice, sqrt(k rho c)",
        ge=1,
        le=1e6,
        typical=(1900.0, 2200.0),
    )
    constant: float = quantity(
        1.128,
        "1",
        "C: 1.128 isothermal contact, 1.329 uniform heat flux and melting in the mean, 0.886 "
        "uniform flux and melting at the trailing edge",
        ge=0.1,
        le=10,
        typical=(0.886, 1.329),
    )


MELTING_POINT = 0.0  # of ice, degC
FINEST_COLD = 1e-12  # K; a temperature this near to melting is there, but for rounding


def warming(length: float, hardness: float, effusivity: float, constant: float) -> float:
    """l (H / (C e))^2, K^2 s/m."""
    ratio = hardness / (constant * effusivity)
    return length * (ratio * ratio)


def melting(mu: float, speed: float, temperature: float, warming: float) -> float:
    """Friction that melts asperities; the dry value at speed 0."""
    cold = MELTING_POINT - temperature
    if cold > FINEST_COLD:
        return mu * cold / sqrt(cold * cold + warming * mu * mu * speed)
    return 0.0  # melting ice has no dry friction, not even at rest


EFFECT = Effect(
    id="asperity_melting",
    table=AsperityMelting,
    switch=("length",),
    enters="friction",
    axis="sliding speed",
    source="Evans, Nye & Cheeseman, Proc. R. Soc. A (1976): 1/sqrt(v) well below melting",
    terms=(melting,),
    derived=(warming,),
    feels_melting=("length",),
    case=Case({"length": 1e-3}),
)
