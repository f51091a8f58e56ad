"""Steady sliding at every speed and ambient temperature, and the slopes of friction over speed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cosim.scenario import Scenario

from .steady import NotSteady, SteadySliding, steady_sliding

Array = NDArray[np.float64]

#: Points that a slope over a decade needs at least.
FEWEST = 4
#: A decade may be short or long by this part, for speeds that are rounded and blocks that creep.
ROUNDING = 1e-2


@dataclass(frozen=True)
class DecadeSlope:
    """d log(y) / d log(speed) by least squares over a decade of speed, from ``low`` to ``high``."""

    slope: float
    low: float
    high: float


def decade_slopes(speed: ArrayLike, value: ArrayLike) -> list[DecadeSlope]:
    """The slope over each decade of speed that begins at one of the speeds (n,), growing.

    The window that begins at a speed holds all up to ten times that; windows of fewer than four
    points, or that reach less than a decade, are left out. Values (n,) must be positive.
    """
    speed, value = np.asarray(speed, dtype=float), np.asarray(value, dtype=float)
    slopes = []
    for low in speed:
        inside = (speed >= low) & (speed <= 10.0 * low * (1.0 + ROUNDING))
        high = speed[inside][-1]
        if inside.sum() < FEWEST or high < 10.0 * low * (1.0 - ROUNDING):
            continue
        slope = np.polyfit(np.log(speed[inside]), np.log(value[inside]), 1)[0]
        slopes.append(DecadeSlope(float(slope), float(low), float(high)))
    return slopes


def lowest_friction(speed: Array, value: Array) -> tuple[float, float] | None:
    """Speed and value of a minimum inside the range: a parabola through three points, log-log.

    None where the lowest value stands at an end.
    """
    at = int(np.argmin(value))
    if at in (0, len(value) - 1):
        return None
    three = slice(at - 1, at + 2)
    a, b, c = np.polyfit(np.log(speed[three]), np.log(value[three]), 2)
    bottom = -b / (2.0 * a)
    return float(np.exp(bottom)), float(np.exp(c - b * b / (4.0 * a)))


MELTING_POINT = 0.0  # degC


@dataclass(frozen=True)
class FrictionMap:
    """Points of all ambient temperatures (warmest last), each with the speeds growing."""

    scenario: Scenario
    duration: float
    points: tuple[SteadySliding, ...]

    @property
    def ambients(self) -> list[float]:
        """Ambient temperatures, degC, growing."""
        return sorted({point.ambient_degC for point in self.points})

    def at(self, ambient_degC: float) -> list[SteadySliding]:
        """The points of one ambient temperature, speed growing."""
        return [point for point in self.points if point.ambient_degC == ambient_degC]

    def regimes(self, ambient_degC: float) -> dict[str, Any]:
        """Steepest fall and rise over a decade of speed, and the minimum, of one temperature.

        The fall twice: of the friction itself, and of friction over the warming that melting
        takes, T_m - T with the run's own interface temperature. Faster sliding warms the interface,
        so the first falls faster than the law of a given temperature; the second does not.
        None where the speeds reach over no decade, or no minimum lies inside.
        """
        points = self.at(ambient_degC)
        speed = np.array([point.speed for point in points])
        friction = np.array([point.friction for point in points])
        warming = np.array([MELTING_POINT - point.interface_degC for point in points])
        found: dict[str, Any] = {"ambient_degC": ambient_degC}
        raw = decade_slopes(speed, friction)
        found["steepest_fall"] = _extreme(raw, min)
        found["steepest_rise"] = _extreme(raw, max)
        found["steepest_fall_over_warming"] = None
        if np.all(warming > 0.0):
            found["steepest_fall_over_warming"] = _extreme(
                decade_slopes(speed, friction / warming), min
            )
        lowest = lowest_friction(speed, friction)
        found["minimum"] = lowest and {"speed": lowest[0], "friction": lowest[1]}
        return found

    def as_json(self) -> dict[str, Any]:
        """Everything as plain data."""
        return {
            "scenario": self.scenario.to_tables(),
            "duration": self.duration,
            "regimes": [self.regimes(ambient) for ambient in self.ambients],
            "points": [asdict(point) for point in self.points],
        }


def _extreme(slopes: list[DecadeSlope], choose: Callable) -> dict[str, float] | None:
    return asdict(choose(slopes, key=lambda entry: entry.slope)) if slopes else None


def friction_map(
    scenario: Scenario,
    speeds: Sequence[float],
    ambients_degC: Sequence[float],
    duration: float = 2.0,
    progress: Callable[[], object] = lambda: None,
) -> FrictionMap:
    """Slide steadily at every speed (m/s, > 0) and ambient temperature (degC, below melting).

    progress: called after each run. Raises NotSteady or ScenarioError for what cannot be.
    """
    if any(not speed > 0.0 for speed in speeds):
        raise NotSteady(f"speed = {min(speeds):g} m/s: allowed is above 0")
    points = []
    for ambient in sorted(set(ambients_degC)):
        for speed in sorted(set(speeds)):
            points.append(steady_sliding(scenario, speed, ambient, duration))
            progress()
    return FrictionMap(scenario, duration, tuple(points))
