"""More unknowns beside those that rows have: at which size, how bent, and how probable."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from cosim.gap.weak_form.constants import BENDS_ASKED
from cosim.gap.weak_form.unknowns import Unknown


@dataclass(frozen=True)
class Added:
    """An unknown of unit prior: at the scale, and as bent, as the rows ask for.

    factor : (q, q), from unit unknowns to those of the unknown's own columns
    """

    unknown: Unknown
    scale: float = 1.0
    bend: float = 0.0

    @cached_property
    def factor(self) -> np.ndarray:
        prior = self.unknown.prior
        if self.unknown.bends is not None:
            prior = prior + self.bend**2 * self.unknown.bends
        return self.scale * np.linalg.cholesky(prior)


def factor_of(added: Added, runs: int) -> np.ndarray:
    """(Q, Q) from unit unknowns to all columns of so many runs."""
    return np.kron(np.eye(runs), added.factor) if added.unknown.per_run else added.factor


def factors_of(unknown: Unknown, runs: int) -> list[np.ndarray]:
    """(Q, Q) each, one for every bend that is asked."""
    bends = BENDS_ASKED if unknown.bends is not None else (0.0,)
    return [factor_of(Added(unknown, 1.0, bend), runs) for bend in bends]


@dataclass(frozen=True)
class Beside:
    """Some unknowns in their own axes, beside those of a rung.

    With G and r what the rung leaves of X'X and X'z, F'G F = V diag(g) V' and u = V'F'r, an unknown
    of scale s adds 1/2 sum of s^2 u^2 / (1 + s^2 g) - ln(1 + s^2 g) to the ln evidence.

    half : (h, q, Q) from w to what is not left of X'z; axes : of every factor F, g (h, q) and V'F'
    """

    unknowns: tuple[Unknown, ...]
    half: np.ndarray
    axes: list[tuple[np.ndarray, np.ndarray]]
    scales: np.ndarray

    def offered(self, right: np.ndarray, w: np.ndarray, base: np.ndarray) -> np.ndarray:
        """(factors and scales, c) ln evidence of c campaigns, without a weight for the scales.

        right : X'z (q, c); w : (h, Q, c) and base : (h, c) ln evidence, of the rung
        """
        left, squares = right - self.half @ w, self.scales[:, None, None] ** 2
        values = []
        for g, turn in self.axes:
            added = squares * g  # (s, h, q)
            more = np.einsum("shq,hqc->shc", squares / (1.0 + added), np.square(turn @ left))
            more -= np.log1p(added).sum(axis=2)[:, :, None]
            values.append(np.logaddexp.reduce(base + 0.5 * more, axis=1))
        return np.concatenate(values)
