"""Sparse regression: which few features make up the force that is left.

Greedy forward regression with orthogonal least squares (Billings et al. 1989), as PySINDy has it.
Features of stick-slip are nearly collinear at few speeds and loads; thresholding the coefficients
of a full least-squares fit, PySINDy's default, would there drop what cancels rather than what is
small.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .features import FRICTION, Feature
from .stretches import Slip, rows_of

#: A formula has at most so many terms: more would be a fit, not a proposal.
MOST_TERMS = 3
#: Part of a feature that friction cannot stand for; with less it is another word for friction.
_OWN = 0.1


@dataclass(frozen=True)
class Formula:
    """Features and coefficients, with the root mean square that they leave.

    Attributes
    ----------
    features, coefficients : of the terms
    mu_k : kinetic friction, refitted with them
    left_fit, left_held_out : of the stretches' motion, in units of the noise
    """

    features: tuple[Feature, ...]
    coefficients: np.ndarray
    mu_k: float
    left_fit: float
    left_held_out: float


def formulas(
    fit: Sequence[Slip], held_out: Sequence[Slip], features: Sequence[Feature]
) -> list[Formula]:
    """One for each number of terms, none included; regressed on ``fit``, judged on ``held_out``."""
    columns, seen = rows_of(fit, [FRICTION, *features])
    judged = rows_of(held_out, [FRICTION, *features]) if held_out else (columns, seen)
    found = []
    for chosen in _orders(columns, seen):
        which = [0, *(i + 1 for i in chosen)]
        solved = np.linalg.lstsq(_scaled(columns[:, which])[0], seen, rcond=1e-10)[0]
        solved = solved / _scaled(columns[:, which])[1]
        left = [
            float(np.sqrt(np.mean((rows - part[:, which] @ solved) ** 2)))
            for part, rows in ((columns, seen), judged)
        ]
        terms = tuple(features[i] for i in chosen)
        found.append(Formula(terms, solved[1:], float(solved[0]), *left))
    return found


def _scaled(columns: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    size = np.maximum(np.linalg.norm(columns, axis=0), 1e-300)
    return columns / size, size


def _orders(columns: np.ndarray, seen: np.ndarray) -> list[list[int]]:
    """Features of the best formulas with no, one, two ... terms; friction is in all of them."""
    from pysindy import FROLS  # takes a second to import, and few campaigns need it

    friction = columns[:, :1] / np.linalg.norm(columns[:, 0])
    whole = _scaled(columns[:, 1:])[0]
    free, own = _scaled(whole - friction @ (friction.T @ whole))
    useful = np.flatnonzero(own > _OWN)
    rest = seen - friction[:, 0] * (friction[:, 0] @ seen)
    # the triangle of a QR factorisation holds the same regression in as many rows as columns
    triangle = np.linalg.qr(np.column_stack([free[:, useful], rest]), mode="r")
    search = FROLS(max_iter=MOST_TERMS, alpha=0.0)
    search.fit(triangle[:, :-1], triangle[:, -1])
    return [[int(useful[i]) for i in np.flatnonzero(terms[0])] for terms in search.history_]
