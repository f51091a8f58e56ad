"""The round contact on a belt that is averaged over its width.

The ice is a disc of radius a, the belt a strip of width w through the disc's centre. The 2-D
belt (x, thickness) carries the mean over w, so a flux that is uniform over the disc enters at x
in proportion to the chord that lies on the belt,

    c(x) = min(w, 2 sqrt(a^2 - x^2)).

Parts of the disc beyond the belt's edges touch nothing. The footprint is cut across the belt into
strips of equal length; each carries its own flux. Loads on the hat functions of a uniform mesh,
and their mean over a movement of the disc, are differences of repeated integrals of c and
therefore exact wherever the edges fall.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Movement, in cells, below which the mean over the movement is taken at its middle: the closed
#: form divides by the movement and loses digits; both err by about 1e-8 of a load here.
_STANDSTILL = 3e-4


def _repeated(primitives: tuple[Array, Array, Array, Array],
              at_end: tuple[float, float, float]) -> tuple[Array, Array, Array]:
    """Integrals, 1- to 3-fold, of a function from the left end of its interval.

    `primitives`: distance of the points from the left end (clipped to the interval) and three
    successive antiderivatives there; `at_end`: those at the left end.
    """
    y, p1, p2, p3 = primitives
    e1, e2, e3 = at_end
    return p1 - e1, p2 - e2 - e1 * y, p3 - e3 - y * (e2 + 0.5 * e1 * y)


def _beyond(integrals: tuple[Array, Array, Array], excess: Array) -> tuple[Array, Array, Array]:
    """Continue the repeated integrals `excess` (m) past the right end, where the function is 0."""
    i1, i2, i3 = integrals
    return i1, i2 + i1 * excess, i3 + excess * (i2 + 0.5 * i1 * excess)


class Footprint:
    """Chord-shaped footprint of a disc on a belt, cut into strips.

    radius, width: m. strips: their number. `areas` (strips,) in m2 sum to `area`.
    """

    def __init__(self, radius: float, width: float, strips: int) -> None:
        self.radius = radius
        self.width = width
        half = 0.5 * width
        #: Half of the length over which the belt is narrower than the disc, m.
        self.flat = float(np.sqrt(radius**2 - half**2)) if half < radius else 0.0
        self.edges = np.linspace(-radius, radius, strips + 1)
        self._at_edges = tuple(part[:, None] for part in self.integrals(self.edges))
        self.areas: Array = np.diff(self._at_edges[0][:, 0])
        self.area = float(self.areas.sum())

    def chord(self, x: Array) -> Array:
        """Length of the disc's chord on the belt at x (m from the centre), m."""
        root = np.sqrt(np.maximum(self.radius**2 - np.square(x), 0.0))
        return np.minimum(self.width, 2.0 * root) * (np.abs(x) <= self.radius)

    def arc_share(self, r: Array) -> Array:
        """Share of the circle of radius r (m) that lies on the belt."""
        half = 0.5 * self.width
        return 2.0 / np.pi * np.arcsin(np.minimum(1.0, half / np.maximum(r, half)))

    def _arc(self, x: Array) -> tuple[Array, Array, Array]:
        """Successive antiderivatives of 2 sqrt(a^2 - x^2): m2, m3, m4."""
        a2 = self.radius**2
        root = np.sqrt(np.maximum(a2 - x * x, 0.0))
        angle = np.arcsin(np.clip(x / self.radius, -1.0, 1.0))
        first = x * root + a2 * angle
        second = a2 * x * angle + a2 * root - root**3 / 3.0
        third = (a2 * (0.5 * x * x + 0.125 * a2) * angle
                 + x * root * (0.625 * a2 - root**2 / 12.0))
        return first, second, third

    def _interval(self, half: float, x: Array, antiderivatives: Callable) -> tuple:
        """Repeated integrals from -half of a function that vanishes outside [-half, half]."""
        inside = np.clip(x, -half, half)
        ends = tuple(float(p[0]) for p in antiderivatives(np.array([-half])))
        values = _repeated((inside + half, *antiderivatives(inside)), ends)
        return _beyond(values, np.maximum(x - half, 0.0))

    def integrals(self, x: Array) -> tuple[Array, Array, Array]:
        """1-, 2- and 3-fold integral of the chord from minus infinity to x: m2, m3, m4."""
        total = self._interval(self.radius, x, self._arc)
        if self.flat == 0.0:
            return total

        def overhang(y: Array) -> tuple[Array, Array, Array]:
            flat = self.width * y, 0.5 * self.width * y**2, self.width * y**3 / 6.0
            return tuple(p - q for p, q in zip(self._arc(y), flat, strict=True))

        cut = self._interval(self.flat, x, overhang)
        return tuple(p - q for p, q in zip(total, cut, strict=True))

    def _strips(self, x: Array, fold: int) -> Array:
        """2- or 3-fold integral of each strip's part of the chord: shape (strips, points)."""
        e1, e2, e3 = self._at_edges
        values = self.integrals(x)[fold - 1]
        from_edge = np.maximum(x - self.edges[:, None], 0.0)
        taylor = e2 + e1 * from_edge
        if fold == 3:
            taylor = e3 + from_edge * (e2 + 0.5 * e1 * from_edge)
        beyond = np.where(from_edge > 0.0, values - taylor, 0.0)
        return beyond[:-1] - beyond[1:]

    def loads(self, centre: float, movement: float, cell: float) -> tuple[int, Array]:
        """Loads of the strips on hat functions, as mean over a movement of the disc.

        centre: of the disc at the start, m; movement: signed, m; cell: spacing of the nodes
        i * cell, m. Returns the first node's number (unwrapped, may be negative) and the
        loads, shape (strips, nodes), m2; every row sums to that strip's area.
        """
        low = centre + min(movement, 0.0) - self.radius
        high = centre + max(movement, 0.0) + self.radius
        first = int(np.floor(low / cell))
        count = int(np.ceil(high / cell)) - first + 1
        x = (first - 1 + np.arange(count + 2)) * cell - centre
        if abs(movement) < _STANDSTILL * cell:
            integral = self._strips(x - 0.5 * movement, 2)
        else:
            both = self._strips(np.concatenate((x, x - movement)), 3)
            integral = (both[:, :count + 2] - both[:, count + 2:]) / movement
        loads = np.diff(integral, 2, axis=1) / cell
        return first, loads * (self.areas / loads.sum(axis=1))[:, None]
