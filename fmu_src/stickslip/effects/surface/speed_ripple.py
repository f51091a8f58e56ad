"""The speed of the surface is periodic in time.

v (1 + A (sin a + B sin(2 a + b) + C sin(3 a + c) + D sin(4 a + d))),    a = 2 pi f t + phase
"""

from collections.abc import Iterator
from math import cos, pi, radians, sin

from ...quantity import Table, quantity
from ..effect import Candidate, Case, Effect, FormsOf, Scales
from ..periodic import HARMONICS, harmonic_amplitude, harmonic_phase, periodic


class SpeedRipple(Table):
    """The speed of the surface is periodic in time.

    amplitude : amplitude as part of the speed
    frequency : frequency
    phase_deg : phase at the start
    second_amplitude : amplitude of the second harmonic as part of the first's
    second_phase_deg : phase of the second harmonic where that of the first is nothing
    third_amplitude : amplitude of the third harmonic as part of the first's
    third_phase_deg : phase of the third harmonic where that of the first is nothing
    fourth_amplitude : amplitude of the fourth harmonic as part of the first's
    fourth_phase_deg : phase of the fourth harmonic where that of the first is nothing
    """

    amplitude: float = quantity(0.0, "1", ge=0, le=1, typical=(0.02, 0.3))
    frequency: float = quantity(1.0, "Hz", gt=0, le=1000, typical=(0.1, 10.0))
    phase_deg: float = quantity(0.0, "deg", tried=(-180.0, 180.0))
    second_amplitude: float = harmonic_amplitude()
    second_phase_deg: float = harmonic_phase()
    third_amplitude: float = harmonic_amplitude()
    third_phase_deg: float = harmonic_phase()
    fourth_amplitude: float = harmonic_amplitude()
    fourth_phase_deg: float = harmonic_phase()


def angular_rate(frequency: float) -> float:
    """rad/s"""
    return 2.0 * pi * frequency


def phase(phase_deg: float) -> float:
    """rad"""
    return radians(phase_deg)


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
    second_cosine: float,
    second_sine: float,
    third_cosine: float,
    third_sine: float,
    fourth_cosine: float,
    fourth_sine: float,
) -> float:
    """Speed with the ripple, m/s."""
    angle = angular_rate * time + phase
    s, c = sin(angle), cos(angle)
    s2, c2 = 2.0 * s * c, 2.0 * c * c - 1.0
    s3, c3 = s2 * c + c2 * s, c2 * c - s2 * s
    s4, c4 = 2.0 * s2 * c2, 2.0 * c2 * c2 - 1.0
    wave = s + second_cosine * s2 + second_sine * c2 + third_cosine * s3 + third_sine * c3
    wave += fourth_cosine * s4 + fourth_sine * c4
    return steady_speed * (1.0 + amplitude * wave)


def surface_acceleration(
    steady_acceleration: float,
    steady_speed: float,
    time: float,
    amplitude: float,
    angular_rate: float,
    phase: float,
    second_cosine: float,
    second_sine: float,
    third_cosine: float,
    third_sine: float,
    fourth_cosine: float,
    fourth_sine: float,
) -> float:
    """Rate of `surface_speed`, m/s^2."""
    angle = angular_rate * time + phase
    s, c = sin(angle), cos(angle)
    s2, c2 = 2.0 * s * c, 2.0 * c * c - 1.0
    s3, c3 = s2 * c + c2 * s, c2 * c - s2 * s
    s4, c4 = 2.0 * s2 * c2, 2.0 * c2 * c2 - 1.0
    wave = s + second_cosine * s2 + second_sine * c2 + third_cosine * s3 + third_sine * c3
    wave += fourth_cosine * s4 + fourth_sine * c4
    slope = c + 2.0 * (second_cosine * c2 - second_sine * s2)
    slope += 3.0 * (third_cosine * c3 - third_sine * s3)
    slope += 4.0 * (fourth_cosine * c4 - fourth_sine * s4)
    rate = steady_acceleration * (1.0 + amplitude * wave)
    return rate + steady_speed * amplitude * angular_rate * slope


own = FormsOf("speed_ripple")


def candidates(s: Scales) -> Iterator[Candidate]:
    """Of a frequency, or of a roller, whose frequency goes with the speed."""
    frequency = own.free("frequency", 1.0, 0.2 / s.duration, 0.05, 50.0)
    yield periodic("speed_ripple", frequency, "sine")
    length = own.free("wavelength", 0.1, 0.02, 1e-3, 10.0, log=True)
    yield periodic("speed_ripple", length, "sine of a roller")


EFFECT = Effect(
    id="speed_ripple",
    table=SpeedRipple,
    switch=("amplitude",),
    enters="surface",
    axis="time",
    source="the source study: the speed of the belt is not steady",
    terms=(surface_speed, surface_acceleration, fastest_rate),
    derived=(angular_rate, phase, *HARMONICS),
    candidates=candidates,
    case=Case({"amplitude": 0.3, "frequency": 0.7}),
)
