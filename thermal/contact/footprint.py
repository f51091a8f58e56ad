"""The round contact on a belt that is averaged over its width.

The ice is a disc of radius a, the belt a strip of width w through the disc's centre; they touch
on the area A of their intersection, under the lane of width b = min(w, 2 a). The 2-D belt
(x, thickness) is the mean over that lane, and the contact on it a rectangle of the same area:
b wide and A / b long, which is the mean length of the disc's chords along the motion. Area, heat
per length of belt and mean time under the ice are then those of the disc. (The exact mean
over the disc of the face temperature of a thick belt under uniform flux is 1.8 % higher at
a = 40 mm, w = 75 mm; a footprint that follows the disc's width along x would be 5.8 % off,
because it mixes touched and untouched belt at one x.)

The rectangle is cut across the belt into strips of equal length, each with its own flux. Loads
on the hat functions of a uniform mesh, and their mean over a movement, are differences of
repeated integrals of the rectangle, and therefore exact wherever the edges fall.
"""

import numpy as np

from thermal.arrays import Array


def disc_on_strip(radius: float, width: float) -> float:
    """Area (m2) of a disc that lies on a strip of given width through its centre (m)."""
    half = min(0.5 * width, radius)
    found: float = 2.0 * (
        half * np.sqrt(radius**2 - half**2) + radius**2 * np.arcsin(half / radius)
    )
    return found


class Footprint:
    """Equivalent rectangle of a disc (radius, m) on a belt (width, m), cut into strips.

    length (m, > 0): the contact is itself a rectangle of that length along the motion. `lane`
    and `length` (m) are the sides, `area` (m2) is theirs and the true contact's.
    """

    def __init__(self, radius: float, width: float, strips: int, length: float = 0.0) -> None:
        self.radius = radius
        self.width = width
        self.strips = strips
        self.lane: float = min(width, 2.0 * radius)
        self.rectangular: bool = length > 0.0
        self.area: float = (
            length * self.lane if self.rectangular else float(disc_on_strip(radius, width))
        )
        self.length: float = self.area / self.lane
        #: Edges of the strips, m from the centre: (strips + 1,).
        self.edges: Array = np.linspace(-0.5 * self.length, 0.5 * self.length, strips + 1)

    @property
    def strip_area(self) -> float:
        """Area of one strip, m2."""
        return self.area / self.strips

    @property
    def touching(self) -> float:
        """Radius (m) up to which the ice's face touches all round."""
        return np.sqrt(self.area / np.pi) if self.rectangular else 0.5 * self.width

    def arc_share(self, r: Array) -> Array:
        """Share of the circle of radius r (m) about the disc's centre that lies on the belt.

        The ice is a body of revolution: a rectangle becomes the disc of its area there.
        """
        if self.rectangular:
            return np.where(r <= self.touching, 1.0, 0.0)
        half = 0.5 * self.width
        return 2.0 / np.pi * np.arcsin(np.minimum(1.0, half / np.maximum(r, half)))

    def loads(self, centre: float, movement: float, cell: float) -> tuple[int, Array]:
        """Loads of the strips on hat functions, as mean over a movement of the contact.

        centre: of the contact at the start, m; movement: signed, m; cell: spacing of the nodes
        i * cell, m. Returns the first node's number (unwrapped, may be negative) and the
        loads, shape (strips, nodes), m2; every row sums to a strip's area.
        """
        return strip_loads(self.edges, self.lane, centre, movement, cell)


def strip_loads(
    edges: Array, lane: float, centre: float, movement: float, cell: float
) -> tuple[int, Array]:
    """Loads of neighbouring strips, as `Footprint.loads`; edges: (strips + 1,) m from centre."""
    first = int(np.floor((centre + min(movement, 0.0) + edges[0]) / cell))
    last = int(np.ceil((centre + max(movement, 0.0) + edges[-1]) / cell))
    x = np.arange(first - 1, last + 2) * cell - centre
    past = np.maximum(x - edges[:, None], 0.0)
    moved = np.maximum(x - movement - edges[:, None], 0.0)
    # (past^3 - moved^3) / (6 movement), factored: no digits are lost for a small movement.
    share = np.where((past > 0.0) & (moved > 0.0), 1.0, (past - moved) / (movement or 1.0))
    integral = share * (past * past + past * moved + moved * moved) / 6.0
    of_strips = integral[:-1] - integral[1:]
    loads = of_strips[:, 2:] - 2.0 * of_strips[:, 1:-1] + of_strips[:, :-2]
    areas = np.diff(edges) * lane
    return first, loads * (areas / loads.sum(axis=1))[:, None]
