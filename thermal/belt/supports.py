"""Railing and rollers: what touches the back of the belt and stays at a temperature of its own.

They stand still while the belt runs over them, like the ice. Each is cut into strips, in each of
which the flux into the belt is uniform over a step,

    p = -(h - h_air) T + h T_s + d v,

T the step-mean of the back over the strip and T_s the support's temperature (rises above the air),
d v the friction heat of a belt that rubs on the support at its speed v: the belt's modes lose heat
to the air over the whole back, which a support covers. The strips of all supports are eliminated
before the contact is solved, so that the contact sees a belt that knows its supports.
"""

from dataclasses import dataclass

import numpy as np

from thermal.arrays import Array
from thermal.contact.exchange import BeltFace
from thermal.contact.footprint import Footprint

from .parameters import Belt

#: The faces of the belt.
CONTACT, BACK = 0, 1


@dataclass(frozen=True)
class Support:
    """A railing or a roller: its middle, m behind the contact's; strip edges, m from its middle.

    conductance to it, W/m2K; rise: its temperature above the air, K; drag: friction heat that
    enters the belt, W/m2 for 1 m/s.
    """

    behind: float
    edges: Array
    conductance: float
    rise: float = 0.0
    drag: float = 0.0


def supports(belt: Belt, strip: float, lane: float) -> list[Support]:
    """All supports of a belt, cut into strips not longer than `strip` (m); lane: its width, m."""

    def cut(length: float) -> Array:
        return np.linspace(-0.5 * length, 0.5 * length, int(np.ceil(length / strip)) + 1)

    found = []
    if belt.railing_length > 0.0:
        heat = belt.railing_share * belt.railing_friction * belt.railing_load
        found.append(
            Support(
                0.0,
                cut(belt.railing_length),
                belt.railing_conductance,
                drag=heat / (belt.railing_length * lane),
            )
        )
    spacing = belt.length / max(1, belt.rollers)
    found += [
        Support(
            (n + 0.5) * spacing, cut(belt.roller_arc), belt.roller_conductance, belt.roller_rise
        )
        for n in range(belt.rollers)
    ]
    return found


@dataclass(frozen=True)
class Eliminated:
    """The belt seen from the contact, and how the supports answer what happens there."""

    face: BeltFace
    _own: Array
    _answer: Array

    def fluxes(self, contact: Array) -> Array:
        """Fluxes into the belt of all strips, W/m2: the contact's, then the supports'."""
        return np.concatenate((contact, -self._own - self._answer @ contact))


class Places:
    """Places on a belt with a flux of their own: the contact's strips, then those of its supports.

    faces, edges: of each row of strips the face of the belt, and the strips' edges, m behind the
    contact's middle. lengths m and areas m2 of all strips; conductances W/m2K, rises K and drags
    (W/m2 for 1 m/s) of those of the supports.
    """

    conductances: Array
    rises: Array
    drags: Array

    def __init__(self, belt: Belt, footprint: Footprint) -> None:
        found = supports(belt, footprint.length / footprint.strips, footprint.lane)
        self.faces: list[int] = [CONTACT] + [BACK] * len(found)
        self.edges: list[Array] = [footprint.edges, *(s.behind + s.edges for s in found)]
        self.lengths: Array = np.concatenate([np.diff(edges) for edges in self.edges])
        self.areas: Array = self.lengths * footprint.lane
        strips = np.array([s.edges.size - 1 for s in found], dtype=np.intp)
        self.conductances, self.rises, self.drags = (
            np.repeat(np.array([getattr(s, name) for s in found], dtype=np.float64), strips)
            for name in ("conductance", "rise", "drag")
        )

    @property
    def take_heat(self) -> bool:
        """Does a support take heat?"""
        return bool(np.any(self.conductances > 0.0))

    def eliminate(self, free: Array, response: Array, film: float, given: Array) -> Eliminated:
        """Solve for the supports' strips in terms of the contact's.

        free (strips,) K, response (strips, strips) K m2/W of all strips; film: to the air, W/m2K;
        given: what the supports give to a belt at the air's temperature, W/m2.
        """
        excess = self.conductances - film
        contact = free.size - excess.size
        if excess.size == 0:
            return Eliminated(BeltFace(free, response), np.zeros(0), np.zeros((0, contact)))
        matrix = np.eye(excess.size) + excess[:, None] * response[contact:, contact:]
        right = excess[:, None] * np.column_stack((free[contact:], response[contact:, :contact]))
        right[:, 0] -= given
        solved = np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)
        own, answer = solved[:, 0], solved[:, 1:]
        across = response[:contact, contact:]
        face = BeltFace(
            free[:contact] - across @ own, response[:contact, :contact] - across @ answer
        )
        return Eliminated(face, own, answer)
