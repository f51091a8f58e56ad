"""A free curve over one axis: a straight line and what is smooth beside it.

A cubic B-spline with a penalty on second differences of its coefficients (Eilers & Marx,
Statistical Science 11, 1996) as a mixed model (Currie & Durban, Statistical Modelling 2, 2002):
with the singular vectors of the differences, D = U S V', the coefficients are a line and V S^-1 w,
where all w are normal with one standard deviation, the roughness. A constant is friction's own.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import BSpline

#: Knots over the range of an axis: five stretches, in each of which a curve can bend once.
KNOTS = 6
_DEGREE = 3


@dataclass(frozen=True)
class Spline:
    """Curves over low ... high of an axis.

    Attributes
    ----------
    low, high : of the axis; a curve goes on beyond them as it ends
    warped : axis -> a scale on which knots are even: "", "root" or "logarithm"
    """

    low: float
    high: float
    warped: str = ""

    @property
    def size(self) -> int:
        """Columns: the line's first."""
        return KNOTS + _DEGREE - 1 - 1

    def columns(self, values: np.ndarray) -> np.ndarray:
        """(n, size) of the axis at (n,) values; 0 where there is none (NaN)."""
        seen = np.isfinite(values)
        out = np.zeros((values.size, self.size))
        if seen.any():
            bases = BSpline.design_matrix(self._even(values[seen]), self._knots, _DEGREE)
            out[seen] = bases.toarray() @ self._combined
        return out

    def grid(self, count: int) -> np.ndarray:
        """(count,) values of the axis, even on its scale."""
        even = np.linspace(0.0, 1.0, count)
        start, end = (self._scale(np.array([v]))[0] for v in (self.low, self.high))
        back: dict[str, Callable] = {"": np.array, "root": np.square, "logarithm": np.exp}
        return np.clip(back[self.warped](start + (end - start) * even), self.low, self.high)

    @cached_property
    def _knots(self) -> np.ndarray:
        inner = np.linspace(0.0, 1.0, KNOTS)
        return np.concatenate([[0.0] * _DEGREE, inner, [1.0] * _DEGREE])

    @cached_property
    def _combined(self) -> np.ndarray:
        """(bases, size) coefficients of the line, from -1 to 1, and of what is smooth beside it."""
        knots = self._knots
        count = KNOTS + _DEGREE - 1
        places = np.array([knots[i + 1 : i + 1 + _DEGREE].mean() for i in range(count)])
        slopes = np.diff(np.eye(count), axis=0) / np.diff(places)[:, None]
        differences = np.diff(slopes, axis=0)  # 0 of a line, whose coefficients are the places
        _, sizes, vectors = np.linalg.svd(differences, full_matrices=False)
        rough = vectors.T / sizes * sizes.min()
        return np.column_stack([2.0 * places - 1.0, rough])

    def _even(self, values: np.ndarray) -> np.ndarray:
        """(n,) in 0 ... 1."""
        start, end = (self._scale(np.array([v]))[0] for v in (self.low, self.high))
        return np.clip((self._scale(values) - start) / (end - start), 0.0, 1.0)

    def _scale(self, values: np.ndarray) -> np.ndarray:
        scales: dict[str, Callable] = {"": np.array, "root": np.sqrt, "logarithm": np.log}
        return scales[self.warped](np.asarray(values, dtype=float))
