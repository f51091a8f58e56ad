"""Sparse regression: which few features make up the force that is left.

Greedy forward regression with orthogonal least squares (Chen, Billings & Luo 1989). Features of
stick-slip are nearly collinear at few speeds and loads; thresholding the coefficients of a full
least-squares fit (Brunton et al. 2016) would there drop what cancels rather than what is small.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .features import FRICTION, Feature
from .slips import Slip, rows_of

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
    """One for each number of terms, none included; regressed on ``fit``, judged on ``held_out``.

    The single term is the one that leaves least in both; the next ones are added greedily.
    """
    columns, seen = rows_of(fit, [FRICTION, *features])
    judged = rows_of(held_out, [FRICTION, *features]) if held_out else (columns, seen)
    every = (columns, seen), judged
    found = [_solved(every, features, chosen) for chosen in _orders(columns, seen)]
    if len(found) > 1:
        alone = [_solved(every, features, [i]) for i in _useful(columns)[0]]
        found[1] = min(alone, key=lambda one: np.hypot(one.left_fit, one.left_held_out))
    return found


def _solved(every, features: Sequence[Feature], chosen: Sequence[int]) -> Formula:
    """Friction and the chosen features; ``every`` : columns and rows to fit, and to judge."""
    which = [0, *(i + 1 for i in chosen)]
    scaled, size = _scaled(every[0][0][:, which])
    solved = np.linalg.lstsq(scaled, every[0][1], rcond=1e-10)[0] / size
    left = [
        float(np.sqrt(np.mean((seen - columns[:, which] @ solved) ** 2))) for columns, seen in every
    ]
    return Formula(tuple(features[i] for i in chosen), solved[1:], float(solved[0]), *left)


def _scaled(columns: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    size = np.maximum(np.linalg.norm(columns, axis=0), 1e-300)
    return columns / size, size


def _useful(columns: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Features that are not another word for friction; (r, f) without it; friction's direction."""
    friction = columns[:, :1] / np.linalg.norm(columns[:, 0])
    whole = _scaled(columns[:, 1:])[0]
    free, own = _scaled(whole - friction @ (friction.T @ whole))
    useful = np.flatnonzero(own > _OWN)
    return useful, free[:, useful], friction[:, 0]


def _orders(columns: np.ndarray, seen: np.ndarray) -> list[list[int]]:
    """Features of the best formulas with no, one, two ... terms; friction is in all of them."""
    useful, free, friction = _useful(columns)
    rest = seen - friction * (friction @ seen)
    # the triangle of a QR factorisation holds the same regression in as many rows as columns
    _, triangle = np.linalg.qr(np.column_stack([free, rest]))
    chosen = forward_selection(triangle[:, :-1], triangle[:, -1], MOST_TERMS)
    return [sorted(int(useful[i]) for i in chosen[:count]) for count in range(len(chosen) + 1)]


def forward_selection(columns: np.ndarray, seen: np.ndarray, most: int) -> list[int]:
    """Columns (r, f) that explain (r,) best, at most so many, in the order in which they join.

    The next is the one whose part orthogonal to those before takes most off the sum of squares.
    """
    left = columns.copy()
    chosen: list[int] = []
    for _ in range(min(most, columns.shape[1])):
        squares = np.sum(left**2, axis=0)
        squares[chosen] = np.inf
        best = int(np.argmax((seen @ left) ** 2 / np.maximum(squares, 1e-300)))
        chosen.append(best)
        direction = left[:, best] / np.linalg.norm(left[:, best])
        left -= np.outer(direction, direction @ left)
    return chosen
