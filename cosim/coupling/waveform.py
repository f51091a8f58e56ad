"""An input over one macro step, as a function of time."""

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Waveform:
    """A polynomial in the time since the step's start.

    coefficients: (n,) with u(t) = c0 + c1 t + c2 t^2 + ..., in the port's unit and that per s^k.
    size: length of the step, s.

    >>> Waveform((1.0, 2.0), 0.5).end
    2.0
    """

    coefficients: tuple[float, ...]
    size: float

    def at(self, time: float) -> float:
        """Value at a time since the step's start, s."""
        value = 0.0
        for coefficient in reversed(self.coefficients):
            value = value * time + coefficient
        return value

    @property
    def start(self) -> float:
        """Value at the step's start."""
        return self.coefficients[0]

    @property
    def end(self) -> float:
        """Value at the step's end."""
        return self.at(self.size)

    @property
    def mean(self) -> float:
        """Mean over the step."""
        return sum(c * self.size**k / (k + 1) for k, c in enumerate(self.coefficients))

    @property
    def rates(self) -> tuple[float, ...]:
        """First, second, ... derivative at the step's start, unit per s^k."""
        found, factorial = [], 1.0
        for k, coefficient in enumerate(self.coefficients[1:], 1):
            factorial *= k
            found.append(factorial * coefficient)
        return tuple(found)

    def after(self, time: float, size: float) -> "Waveform":
        """The same function for a part of the step: from a time (s since its start), size s long.

        By Taylor's series, which is exact for a polynomial.
        """
        shifted = list(self.coefficients)
        for low in range(len(shifted) - 1):  # Horner's scheme, repeated
            for k in range(len(shifted) - 2, low - 1, -1):
                shifted[k] += shifted[k + 1] * time
        return Waveform(tuple(shifted), size)


def through(points: Sequence[tuple[float, float]], size: float) -> Waveform:
    """The polynomial through (time since the step's start in s, value) of at most three points.

    Of degree len(points) - 1, by Newton's divided differences. They begin with the point at time 0,
    if there is one: its value is the start's to the last bit, and a bound that it keeps is kept.

    >>> through([(-1.0, 0.0), (0.0, 1.0)], 1.0).end
    2.0
    """
    if len(points) == 1:
        return Waveform((points[0][1],), size)
    if points[0][0]:
        points = sorted(points, key=lambda point: abs(point[0]))
    (t0, u0), (t1, u1) = points[0], points[1]
    slope = (u1 - u0) / (t1 - t0)
    if len(points) == 2:
        return Waveform((u0 - slope * t0, slope), size)
    t2, u2 = points[2]
    bend = ((u2 - u1) / (t2 - t1) - slope) / (t2 - t0)
    # u0 + slope (t - t0) + bend (t - t0)(t - t1)
    return Waveform((u0 - slope * t0 + bend * t0 * t1, slope - bend * (t0 + t1), bend), size)
