"""Friction grows with the sliding speed: a film of melt or water is sheared.

A Couette film of the whole contact gives a force c U; a film that grows as it melts gives one that
grows with the root of the local speed, b sqrt(v) / N beside mu_k.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import sqrt

from ...quantity import Table, quantity
from ..candidate import Candidate, FreeParameter, Scales
from ..effect import Case, Effect


class FilmDrag(Table):
    """Friction grows with the sliding speed: a film of melt or water is sheared."""

    coefficient: float = quantity(
        0.0, "N.s/m", "force of the whole contact per sliding speed", ge=0, typical=(0.05, 5.0)
    )
    root_coefficient: float = quantity(
        0.0,
        "N",
        "force of the whole contact at 1 m/s, growing with the root of the local speed",
        ge=0,
        typical=(0.05, 2.0),
    )


def contact_drag(coefficient: float) -> float:
    """N s/m: a film of constant thickness."""
    return coefficient


def film_friction(speed: float, root_coefficient: float, normal_force: float) -> float:
    """What a film whose shear grows with the root of the speed adds to the coefficient."""
    return root_coefficient * sqrt(speed) / normal_force


def candidates(s: Scales) -> Iterator[Candidate]:
    """Either film."""
    drag = 0.02 * s.force / s.speed
    linear = FreeParameter("film_drag.coefficient", drag, drag, 0.0, 1e3 * drag)
    yield Candidate("film_drag", "linear", (linear,))
    much = 0.02 * s.force / s.speed**0.5
    root = FreeParameter("film_drag.root_coefficient", much, much, 0.0, 1e3 * much)
    yield Candidate("film_drag", "root", (root,))


EFFECT = Effect(
    id="film_drag",
    table=FilmDrag,
    switch=("coefficient", "root_coefficient"),
    enters="friction",
    source="Couette film; hydrodynamic friction of ice grows with the root of the speed",
    terms=(film_friction, contact_drag),
    candidates=candidates,
    case=Case({"coefficient": 0.5}, window=(0.0, 8.0)),
)
