"""Friction is periodic in the place s on the surface.

mu_s and mu_k times 1 + A (cos a + B cos(2 a + b) + C cos(3 a + c) + D cos(4 a + d)),
a = 2 pi s / wavelength + phase: a joint of the belt, a scratch or a patch is no sine.
"""

from collections.abc import Iterator
from math import cos, pi, radians, sin

from ...quantity import Table, quantity
from ..effect import Candidate, Case, Effect, FormsOf, Scales
from ..periodic import HARMONICS, harmonic_amplitude, harmonic_phase, periodic


class SurfacePattern(Table):
    """Friction is periodic in the place on the surface.

    amplitude : amplitude as part of mu_s and mu_k
    wavelength : length of a period along the surface
    phase_deg : phase where the block stands at the start
    second_amplitude : amplitude of the second harmonic as part of the first's
    second_phase_deg : phase of the second harmonic where that of the first is nothing
    third_amplitude : amplitude of the third harmonic as part of the first's
    third_phase_deg : phase of the third harmonic where that of the first is nothing
    fourth_amplitude : amplitude of the fourth harmonic as part of the first's
    fourth_phase_deg : phase of the fourth harmonic where that of the first is nothing
    """

    amplitude: float = quantity(0.0, "1", ge=0, le=1, typical=(0.02, 0.4))
    wavelength: float = quantity(0.1, "m", gt=0, typical=(0.005, 1.0))
    phase_deg: float = quantity(0.0, "deg", tried=(-180.0, 180.0))
    second_amplitude: float = harmonic_amplitude()
    second_phase_deg: float = harmonic_phase()
    third_amplitude: float = harmonic_amplitude()
    third_phase_deg: float = harmonic_phase()
    fourth_amplitude: float = harmonic_amplitude()
    fourth_phase_deg: float = harmonic_phase()


def wavenumber(wavelength: float) -> float:
    """rad/m"""
    return 2.0 * pi / wavelength


def phase(phase_deg: float) -> float:
    """rad"""
    return radians(phase_deg)


def place_variation(
    place: float,
    amplitude: float,
    wavenumber: float,
    phase: float,
    second_cosine: float,
    second_sine: float,
    third_cosine: float,
    third_sine: float,
    fourth_cosine: float,
    fourth_sine: float,
) -> float:
    """Friction of the place less the mean, as part of that."""
    angle = wavenumber * place + phase
    s, c = sin(angle), cos(angle)
    s2, c2 = 2.0 * s * c, 2.0 * c * c - 1.0
    s3, c3 = s2 * c + c2 * s, c2 * c - s2 * s
    s4, c4 = 2.0 * s2 * c2, 2.0 * c2 * c2 - 1.0
    wave = c + second_cosine * c2 - second_sine * s2 + third_cosine * c3 - third_sine * s3
    wave += fourth_cosine * c4 - fourth_sine * s4
    return amplitude * wave


own = FormsOf("surface_pattern")


def candidates(s: Scales) -> Iterator[Candidate]:
    """A sine; a scan says where it starts."""
    # what no run passes once is no pattern: it would be a drift by another name
    longest = s.longest or s.distance
    low = min(1e-3, 0.1 * longest)
    length = own.free("wavelength", min(0.1, 0.5 * longest), 0.02, low, longest, log=True)
    yield periodic("surface_pattern", length, "sine")


EFFECT = Effect(
    id="surface_pattern",
    table=SurfacePattern,
    switch=("amplitude",),
    enters="friction",
    axis="place",
    source="waves along the track, as in paper-on-paper records (Colas et al., 2019)",
    terms=(place_variation,),
    derived=(wavenumber, phase, *HARMONICS),
    candidates=candidates,
    case=Case({"amplitude": 0.15, "wavelength": 0.3}),
)
