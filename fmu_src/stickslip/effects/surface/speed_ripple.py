"""The speed of the surface is periodic in time.

v (1 + A (sin a + B sin(2 a + b) + C sin(3 a + c) + D sin(4 a + d))),    a = 2 pi f t + phase
"""

from __future__ import annotations

from collections.abc import Iterator
from math import cos, pi, radians, sin

from ...quantity import Table, quantity
from ..candidate import Candidate, FreeParameter, Scales
from ..effect import Case, Effect
from ..periodic import harmonic_amplitude, harmonic_phase, periodic


class SpeedRipple(Table):
    """The speed of the surface is periodic in time."""

    amplitude: float = quantity(
        0.0, "1", "amplitude as part of the speed", ge=0, le=1, typical=(0.02, 0.3)
    )
    frequency: float = quantity(1.0, "Hz", "frequency", gt=0, le=1000, typical=(0.1, 10.0))
    phase_deg: float = quantity(0.0, "deg", "phase at the start", tried=(-180.0, 180.0))
    second_amplitude: float = harmonic_amplitude("second")
    second_phase_deg: float = harmonic_phase("second")
    third_amplitude: float = harmonic_amplitude("third")
    third_phase_deg: float = harmonic_phase("third")
    fourth_amplitude: float = harmonic_amplitude("fourth")
    fourth_phase_deg: float = harmonic_phase("fourth")


def angular_rate(frequency: float) -> float:
    """rad/s"""
    return 2.0 * pi * frequency


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


def fastest_rate(
    angular_rate: float, second_amplitude: float, third_amplitude: float, fourth_amplitude: float
) -> float:
    """Rate of what varies fastest, rad/s."""
    if fourth_amplitude != 0.0:
        return 4.0 * angular_rate
    if third_amplitude != 0.0:
        return 3.0 * angular_rate
    return angular_rate * (2.0 if second_amplitude != 0.0 else 1.0)


def surface_speed(
    steady_speed: float,
    time: float,
    amplitude: float,
    angular_rate: float,
    phase: float,
    second_amplitude: float,
    second_harmonic_phase: float,
    third_amplitude: float,
    third_harmonic_phase: float,
    fourth_amplitude: float,
    fourth_harmonic_phase: float,
) -> float:
    """Speed with the ripple, m/s."""
    angle = angular_rate * time + phase
    wave = sin(angle)
    if second_amplitude != 0.0:
        wave += second_amplitude * sin(2.0 * angle + second_harmonic_phase)
    if third_amplitude != 0.0:
        wave += third_amplitude * sin(3.0 * angle + third_harmonic_phase)
    if fourth_amplitude != 0.0:
        wave += fourth_amplitude * sin(4.0 * angle + fourth_harmonic_phase)
    return steady_speed * (1.0 + amplitude * wave)


def surface_acceleration(
    steady_acceleration: float,
    steady_speed: float,
    time: float,
    amplitude: float,
    angular_rate: float,
    phase: float,
    second_amplitude: float,
    second_harmonic_phase: float,
    third_amplitude: float,
    third_harmonic_phase: float,
    fourth_amplitude: float,
    fourth_harmonic_phase: float,
) -> float:
    """Rate of `surface_speed`, m/s^2."""
    angle = angular_rate * time + phase
    wave, slope = sin(angle), cos(angle)
    if second_amplitude != 0.0:
        second = 2.0 * angle + second_harmonic_phase
        wave += second_amplitude * sin(second)
        slope += 2.0 * second_amplitude * cos(second)
    if third_amplitude != 0.0:
        third = 3.0 * angle + third_harmonic_phase
        wave += third_amplitude * sin(third)
        slope += 3.0 * third_amplitude * cos(third)
    if fourth_amplitude != 0.0:
        fourth = 4.0 * angle + fourth_harmonic_phase
        wave += fourth_amplitude * sin(fourth)
        slope += 4.0 * fourth_amplitude * cos(fourth)
    rate = steady_acceleration * (1.0 + amplitude * wave)
    return rate + steady_speed * amplitude * angular_rate * slope


def candidates(s: Scales) -> Iterator[Candidate]:
    """Of a frequency, or of a roller, whose frequency goes with the speed."""
    frequency = FreeParameter("speed_ripple.frequency", 1.0, 0.2 / s.duration, 0.05, 50.0)
    yield periodic("speed_ripple", frequency, "sine")
    length = FreeParameter("speed_ripple.wavelength", 0.1, 0.02, 1e-3, 10.0, log=True)
    yield periodic("speed_ripple", length, "sine of a roller")


EFFECT = Effect(
    id="speed_ripple",
    table=SpeedRipple,
    switch=("amplitude",),
    enters="surface",
    axis="time",
    source="the source study: the speed of the belt is not steady",
    terms=(surface_speed, surface_acceleration, fastest_rate),
    derived=(
        angular_rate,
        phase,
        second_harmonic_phase,
        third_harmonic_phase,
        fourth_harmonic_phase,
    ),
    candidates=candidates,
    case=Case({"amplitude": 0.3, "frequency": 0.7}),
)
