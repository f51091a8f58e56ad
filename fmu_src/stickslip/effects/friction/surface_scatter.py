"""Friction scatters from place to place on the surface: a random field, the same every time.

A sum of waves with random wavenumber and phase, of a standard deviation sigma as part of mu_s and
mu_k. A Gaussian correlation of length L has normally distributed wavenumbers, deviation 1/L. It
belongs to the place, so a place met again has the same friction, whatever the steps.
"""

from math import cos, pi, sqrt

from ...quantity import Table, quantity
from ..effect import Case, Effect

WAVES = 16


class SurfaceScatter(Table):
    """Friction scatters from place to place on the surface: a random field, the same every time.

    deviation : standard deviation as part of mu_s and mu_k
    correlation_length : distance over which the field forgets itself: exp(-(d/L)^2 / 2)
    seed : which field it is
    """

    deviation: float = quantity(0.0, "1", ge=0, le=0.5, typical=(0.02, 0.3))
    correlation_length: float = quantity(0.02, "m", gt=0, tried=(0.005, 0.1))
    seed: int = quantity(1, "1", ge=0, le=2**31 - 1, tried=(1, 10**6))


def wavenumber(deviate: float, correlation_length: float) -> float:
    """Of a wave, rad/m."""
    return deviate / correlation_length


def phase(turn: float) -> float:
    """Of a wave, rad."""
    return 2.0 * pi * turn


def wave(place: float, wavenumber: float, phase: float) -> float:
    """One of the waves."""
    return cos(wavenumber * place + phase)


def place_variation(waves: float, deviation: float) -> float:
    """Friction of the place less the mean, as part of that."""
    return deviation * sqrt(2.0 / WAVES) * waves


EFFECT = Effect(
    id="surface_scatter",
    table=SurfaceScatter,
    switch=("deviation",),
    enters="friction",
    axis="place",
    source="the source study's statistical friction, as a field on the surface",
    terms=(place_variation,),
    derived=(wavenumber, phase),
    series={"wavenumber": WAVES, "phase": WAVES},
    draws={"deviate": "normal", "turn": "uniform"},
    sums={"waves": wave},
    case=Case({"deviation": 0.08}),
)
