"""Railing and rollers: what touches the back of the belt and stays at a temperature of its own.

They stand still while the belt runs over them, like the ice. Each is cut into strips, in each of
which the flux into the belt is uniform over a step,

    p = -(h - h_air) T + h T_s + d v,

T the step-mean of the back over the strip and T_s the support's temperature (rises above the air),
d v the friction heat of a belt that rubs on the support at its speed v: the belt's modes lose heat
to the air over the whole back, which a support covers. The strips of all supports are eliminated
before the contact is solved, so that the contact sees a belt that knows its supports.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from thermal.contact.exchange import BeltFace

from .parameters import Belt

Array = NDArray[np.float64]


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

    @property
    def strips(self) -> int:
        """Number of its strips."""
        return self.edges.size - 1


def each_strip(supports: Sequence[Support], value: Callable[[Support], float]) -> Array:
    """A number of the supports for each of their strips: (strips,)."""
    return np.concatenate([np.zeros(0)] + [np.full(s.strips, value(s)) for s in supports])


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


def eliminate(free: Array, response: Array, excess: Array, given: Array) -> Eliminated:
    """Solve for the supports' strips, the last ones, in terms of the contact's.

    free (strips,) K, response (strips, strips) K m2/W of all strips; excess: h - h_air of the
    supports' strips, W/m2K; given: what they give to a belt at the air's temperature, W/m2.
    """
    contact = free.size - excess.size
    if excess.size == 0:
        return Eliminated(BeltFace(free, response), np.zeros(0), np.zeros((0, contact)))
    matrix = np.eye(excess.size) + excess[:, None] * response[contact:, contact:]
    right = excess[:, None] * np.column_stack((free[contact:], response[contact:, :contact]))
    right[:, 0] -= given
    solved = np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)
    own, answer = solved[:, 0], solved[:, 1:]
    across = response[:contact, contact:]
    return Eliminated(
        BeltFace(free[:contact] - across @ own, response[:contact, :contact] - across @ answer),
        own,
        answer,
    )
