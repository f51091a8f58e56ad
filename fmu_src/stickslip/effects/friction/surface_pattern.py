"""Friction is periodic in the place s on the surface.

mu_s and mu_k times 1 + A (cos a + B cos(2 a + b) + C cos(3 a + c) + D cos(4 a + d)),
a = 2 pi s / wavelength + phase: a joint of the belt, a scratch or a patch is no sine.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import cos, pi, radians

from ...quantity import Table, quantity
from ..candidate import Candidate, FreeParameter, Scales
from ..effect import Case, Effect
from ..periodic import harmonic_amplitude, harmonic_phase, periodic


class SurfacePattern(Table):
    """Friction is periodic in the place on the surface."""

    amplitude: float = quantity(
        0.0, "1", "amplitude as part of mu_s and mu_k", ge=0, le=1, typical=(0.02, 0.4)
    )
    wavelength: float = quantity(
        0.1, "m", "length of a period along the surface", gt=0, typical=(0.005, 1.0)
    )
    phase_deg: float = quantity(
        0.0, "deg", "phase where the block stands at the start", tried=(-180.0, 180.0)
    )
    second_amplitude: float = harmonic_amplitude("second")
    second_phase_deg: float = harmonic_phase("second")
    third_amplitude: float = harmonic_amplitude("third")
    third_phase_deg: float = harmonic_phase("third")
    fourth_amplitude: float = harmonic_amplitude("fourth")
    fourth_phase_deg: float = harmonic_phase("fourth")


def wavenumber(wavelength: float) -> float:
    """rad/m"""
    return 2.0 * pi / wavelength


def phase(phase_deg: float) -> float:
    """rad"""
    return radians(phase_deg)


def second_harmonic_phase(second_phase_deg: float) -> float:
    """rad"""
    return radians(second_phase_deg)


def third_harmonic_phase(third_phase_deg: float) -> float:
    """rad"""
    return radians(third_phase_deg)


def fourth_harmonic_phase(fourth_phase_deg: float) -> float:
    """rad"""
    return radians(fourth_phase_deg)


def place_variation(
    place: float,
    amplitude: float,
    wavenumber: float,
    phase: float,
    second_amplitude: float,
    second_harmonic_phase: float,
    third_amplitude: float,
    third_harmonic_phase: float,
    fourth_amplitude: float,
    fourth_harmonic_phase: float,
) -> float:
    """Friction of the place less the mean, as part of that."""
    angle = wavenumber * place + phase
    wave = cos(angle)
    if second_amplitude != 0.0:
        wave += second_amplitude * cos(2.0 * angle + second_harmonic_phase)
    if third_amplitude != 0.0:
        wave += third_amplitude * cos(3.0 * angle + third_harmonic_phase)
    if fourth_amplitude != 0.0:
        wave += fourth_amplitude * cos(4.0 * angle + fourth_harmonic_phase)
    return amplitude * wave


def candidates(s: Scales) -> Iterator[Candidate]:
    """A sine; a scan says where it starts."""
    # what no run passes once is no pattern: it would be a drift by another name
    longest = s.longest or s.distance
    start = min(0.1, 0.5 * longest)
    length = FreeParameter(
        "surface_pattern.wavelength", start, 0.02, min(1e-3, 0.1 * longest), longest, log=True
    )
    yield periodic("surface_pattern", length, "sine")


EFFECT = Effect(
    id="surface_pattern",
    table=SurfacePattern,
    switch=("amplitude",),
    enters="friction",
    axis="place",
    source="waves along the track, as in paper-on-paper records (Colas et al., 2019)",
    terms=(place_variation,),
    derived=(
        wavenumber,
        phase,
        second_harmonic_phase,
        third_harmonic_phase,
        fourth_harmonic_phase,
    ),
    candidates=candidates,
    case=Case({"amplitude": 0.15, "wavelength": 0.3}),
)
