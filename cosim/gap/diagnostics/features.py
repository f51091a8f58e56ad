"""What a formula may be made of: forces along x of size one, in the measured quantities."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, Generic, NamedTuple, TypeVar

import numpy as np

T = TypeVar("T", float, np.ndarray)


class Moment(NamedTuple, Generic[T]):
    """What is known of the block at a moment, or (n,) moments.

    x, vx : position and velocity, m, m/s; sliding : of the surface past the block, m/s, and its
    sign, `direction` (0 in stick); time : in the run, s; distance : slid, m; place : on the
    surface, m; load : normal force, N
    """

    x: T
    vx: T
    sliding: T
    direction: T
    time: T
    distance: T
    place: T
    load: T


@dataclass(frozen=True)
class Feature:
    """One term without its coefficient.

    Attributes
    ----------
    name : as in the formula; "" is a constant
    unit : of the coefficient, so that the term is a force in N
    of : its value at a moment, or at many: a number or an array, as the moment has them
    both_ways : only runs with the surface moving both ways can tell it from a simpler feature
    """

    name: str
    unit: str
    of: Callable[[Moment[Any]], Any]
    both_ways: bool = False


#: The kinetic friction: always there, refitted with everything else.
FRICTION = Feature("direction·N", "1", lambda m: m.direction * m.load)

#: Widths of bumps, parts of the travel that the block covers.
_WIDTHS = (0.08, 0.2)

#: Not from the slips, but from break-aways that need another force one way than the other.
HELD = Feature("N while held", "1", lambda m: m.load * (m.direction == 0.0))

#: A force by position (springs, magnets, a bent scale), by velocity (dampers, air), by sliding
#: speed (films), each also growing with time (what softens or melts), with the distance slid,
#: the load. The hold time is not among them: it decides when a stick ends, which is no force that
#: acts in slip, and within one run it stands for the break-away force itself.
_FEATURES = (
    Feature("", "N", lambda m: 1.0 + 0.0 * m.x),
    Feature("N", "1", lambda m: m.load + 0.0 * m.x, both_ways=True),
    Feature("x", "N/m", lambda m: m.x),
    Feature("x²", "N/m²", lambda m: m.x**2),
    Feature("x³", "N/m³", lambda m: m.x**3),
    Feature("vx", "N s/m", lambda m: m.vx),
    Feature("vx·|vx|", "N s²/m²", lambda m: m.vx * abs(m.vx)),
    Feature("sliding", "N s/m", lambda m: m.sliding),
    Feature("sliding·|sliding|", "N s²/m²", lambda m: m.sliding * abs(m.sliding)),
    Feature("direction·√|sliding|", "N √(s/m)", lambda m: m.direction * abs(m.sliding) ** 0.5),
    Feature("direction", "N", lambda m: m.direction, both_ways=True),
    Feature("direction·x", "N/m", lambda m: m.direction * m.x, both_ways=True),
    Feature("direction·x²", "N/m²", lambda m: m.direction * m.x**2, both_ways=True),
    Feature("direction·N²", "1/N", lambda m: m.direction * m.load**2),
    Feature("direction·t", "N/s", lambda m: m.direction * m.time),
    Feature("direction·distance", "N/m", lambda m: m.direction * m.distance),
    Feature("x·t", "N/(m s)", lambda m: m.x * m.time),
    Feature("x·ln(1 + t/1 s)", "N/m", lambda m: m.x * np.log1p(m.time)),
    Feature("vx·t", "N/m", lambda m: m.vx * m.time),
)


def library(
    both_ways: bool,
    reach: tuple[float, float],
    frequency: float | None = None,
    wavenumber: float | None = None,
) -> list[Feature]:
    """All features that a campaign can tell.

    both_ways : the surface moved both ways; reach : lowest and highest x, m, over which bumps of a
    force are laid; frequency, wavenumber : periods of the misfit in time (Hz) and along the surface
    (1/m), if there are any: a sine and a cosine of each
    """
    found: Sequence[Feature] = [one for one in _FEATURES if both_ways or not one.both_ways]
    found = [*found, *_bumps(*reach)]
    if frequency:
        found = [*found, *_waves(frequency, "Hz", "t", "time")]
    if wavenumber:
        found = [*found, *_waves(wavenumber, "1/m", "place", "place")]
    return list(found)


def _bumps(low: float, high: float) -> list[Feature]:
    """A force about a place and nowhere else."""
    found = []
    for part in _WIDTHS:
        width = float(f"{part * (high - low):.2g}")
        for place in np.arange(low + width, high - 0.5 * width, width):
            centre = float(f"{place:.3g}")
            name = f"exp(-((x - {1e3 * centre:.4g} mm)/{1e3 * width:.3g} mm)²)"
            found.append(Feature(name, "N", partial(_bump, centre, width)))
    return found


def _bump(centre: float, width: float, m: Moment[T]) -> T:
    return np.exp(-(((m.x - centre) / width) ** 2))


def _waves(rate: float, unit: str, shown: str, field: str) -> list[Feature]:
    angle = f"(2π·{rate:.5g} {unit}·{shown})"
    turn = 2.0 * np.pi * rate
    return [
        Feature(f"cos{angle}", "N", lambda m: np.cos(turn * getattr(m, field))),
        Feature(f"sin{angle}", "N", lambda m: np.sin(turn * getattr(m, field))),
    ]
