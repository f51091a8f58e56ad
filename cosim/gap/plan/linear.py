"""What a fit of the plain model leaves of a response, by the derivatives at the plain model.

Responses are vectors over all residuals of a campaign, in noise units, with a row for each free
parameter of which something is known beforehand.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from cosim.gap.estimation.columns import Columns
from cosim.gap.estimation.problem import Problem

from .planned import Rehearsal

#: Directions that the data feel less than this part of the strongest are none.
RANK = 1e-8


class Nuisance:
    """What belongs to the plain model: its free parameters, the runs' own, the segments' states."""

    def __init__(self, rehearsal: Rehearsal):
        self.columns: tuple[Columns, ...] = rehearsal.columns
        self.weight = Problem((), rehearsal.free_parameters).prior(rehearsal.point.shared)[1]

    @cached_property
    def _basis(self) -> np.ndarray:
        """(rows + g, rank) orthonormal, of the shared free parameters."""
        left = [columns.left(columns.shared) for columns in self.columns]
        stacked = np.vstack([*left, np.diag(self.weight)])
        u, s, _ = np.linalg.svd(stacked, full_matrices=False)
        return u[:, s > RANK * s.max(initial=1e-300)]

    def left(self, responses: Sequence[np.ndarray], known: np.ndarray | None = None) -> np.ndarray:
        """(rows + g, ...) of responses per run (rows, ...): what no plain model can take up.

        known : (g,) how far free parameters are from what is known of them, where the first of
        the responses was taken
        """
        parts = [c.left(r) for c, r in zip(self.columns, responses, strict=True)]
        padding = np.zeros((self.weight.size, *parts[0].shape[1:]))
        if known is not None:
            padding[:, 0] = known
        stacked = np.concatenate([*parts, padding])
        return stacked - self._basis @ (self._basis.T @ stacked)


def beyond(response: np.ndarray, size: np.ndarray, others: np.ndarray) -> float:
    """Squared length of what another law leaves of a response, of (n,).

    size : (n,) the other law's response: it may only be added; others : (n, k) by its shapes and
    phases, either way
    """
    basis = np.linalg.svd(others, full_matrices=False)[0] if others.size else others
    rest = response - basis @ (basis.T @ response)
    along = size - basis @ (basis.T @ size)
    own = float(along @ along)
    if own <= RANK * float(size @ size):
        return float(rest @ rest)
    return float(rest @ rest) - max(float(along @ rest), 0.0) ** 2 / own
