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


def _interval(half: float, x: Array, antiderivatives: Callable,
              at_start: tuple[float, float, float]) -> tuple[Array, Array, Array]:
    """1-, 2- and 3-fold integral from -half to x of a function that is 0 outside [-half, half].

    antiderivatives: three successive ones, valid inside; at_start: their values at -half.
    """
    inside = np.minimum(np.maximum(x, -half), half)
    s1, s2, s3 = at_start
    p1, p2, p3 = antiderivatives(inside)
    y = inside + half
    i1, i2, i3 = p1 - s1, p2 - s2 - s1 * y, p3 - s3 - y * (s2 + 0.5 * s1 * y)
    past = x - inside
    past[x < 0.0] = 0.0
    return i1, i2 + i1 * past, i3 + past * (i2 + 0.5 * i1 * past)


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
        self._arc_ends = tuple(float(p) for p in self._arc(np.float64(-radius)))
        self._overhang_ends = tuple(float(p) for p in self._overhang(np.float64(-self.flat)))
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
        angle = np.arcsin(x / self.radius)
        first = x * root + a2 * angle
        second = a2 * x * angle + root * (a2 - root * root / 3.0)
        third = (a2 * (0.5 * x * x + 0.125 * a2) * angle
                 + x * root * (0.625 * a2 - root * root / 12.0))
        return first, second, third

    def _overhang(self, x: Array) -> tuple[Array, Array, Array]:
        """Successive antiderivatives of 2 sqrt(a^2 - x^2) - w: m2, m3, m4."""
        first, second, third = self._arc(x)
        w = self.width
        return first - w * x, second - 0.5 * w * x * x, third - w * x * x * x / 6.0

    def integrals(self, x: Array) -> tuple[Array, Array, Array]:
        """1-, 2- and 3-fold integral of the chord from minus infinity to x: m2, m3, m4."""
        total = _interval(self.radius, x, self._arc, self._arc_ends)
        if self.flat == 0.0:
            return total
        cut = _interval(self.flat, x, self._overhang, self._overhang_ends)
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
