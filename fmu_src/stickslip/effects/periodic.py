"""What the two periodic effects share: a sine, and its harmonics."""

from math import cos, radians, sin
from typing import Any

from ..quantity import quantity
from .effect import Candidate, FreeParameter

#: A harmonic is at most so many times as large as the first.
MOST_HARMONIC = 10


def harmonic_amplitude() -> Any:
    """A parameter that a wave which is no sine has besides."""
    return quantity(0.0, "1", ge=0, le=MOST_HARMONIC, typical=(0.1, 0.6))


def harmonic_phase() -> Any:
    """The phase of that harmonic."""
    return quantity(0.0, "deg", tried=(-180.0, 180.0))


# B sin(2 a + b) = B cos b sin 2 a + B sin b cos 2 a: what is a harmonic's own is worked out once,
# and sines and cosines of multiples of a follow from those of a, at a twentieth of their price.


def second_cosine(second_amplitude: float, second_phase_deg: float) -> float:
    """B cos b"""
    return second_amplitude * cos(radians(second_phase_deg))


def second_sine(second_amplitude: float, second_phase_deg: float) -> float:
    """B sin b"""
    return second_amplitude * sin(radians(second_phase_deg))


def third_cosine(third_amplitude: float, third_phase_deg: float) -> float:
    """C cos c"""
    return third_amplitude * cos(radians(third_phase_deg))


def third_sine(third_amplitude: float, third_phase_deg: float) -> float:
    """C sin c"""
    return third_amplitude * sin(radians(third_phase_deg))


def fourth_cosine(fourth_amplitude: float, fourth_phase_deg: float) -> float:
    """D cos d"""
    return fourth_amplitude * cos(radians(fourth_phase_deg))


def fourth_sine(fourth_amplitude: float, fourth_phase_deg: float) -> float:
    """D sin d"""
    return fourth_amplitude * sin(radians(fourth_phase_deg))


HARMONICS = (second_cosine, second_sine, third_cosine, third_sine, fourth_cosine, fourth_sine)


def periodic(effect: str, period: FreeParameter, form: str) -> Candidate:
    """A sine; a scan says where its period starts."""
    free = (
        FreeParameter(f"{effect}.amplitude", 0.1, 0.05, 0.0, 1.0),
        period,
        FreeParameter(f"{effect}.phase_deg", 0.0, 30.0, per_run=True),
    )
    return Candidate(effect, form, free, periodic=period.key)
