"""Slopes of friction against speed on logarithmic axes, and its minimum."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

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


def lowest_friction(speed: Sequence[float], value: Sequence[float]) -> tuple[float, float] | None:
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
