"""Levenberg-Marquardt within bounds, on the normal equations of a few numbers."""

from __future__ import annotations

from math import inf
from typing import Protocol

import numpy as np

#: A fit ends where a step changes the sum of squares by less than this part of it, and by as many
#: times more as the mean square exceeds that of the noise, squared, up to the second: there the
#: model is not yet what it will be. Or by less than the third, a quarter of one number's standard
#: deviation. It also ends where a step on fresh derivatives promises no more than so many times
#: that, half of a Bayes factor's e, and gains nothing: what is left is the integrator's error.
SETTLED, COARSER, CLOSE, IDLE = 1e-5, 100.0, 0.06, 16.0
#: Damping at first, least and most, in parts of the normal matrix's diagonal; factors by which it
#: falls after a step that gains and grows after one that does not.
DAMPING, LEAST, MOST, EASIER, HARDER = 1e-3, 1e-7, 1e5, 0.2, 6.0
#: Derivatives are followed by Broyden's update (Math. Comp. 19 (1965)) while a step gains so much
#: of what they promise, and taken anew where it does not, and before a fit ends.
FOLLOWED = 0.5
#: Evaluations that show where a start leads.
FIRST_TRIES = 8
#: Longest step, in scales of the numbers: beyond it the derivatives say nothing.
LONGEST = 10.0


class Rows(Protocol):
    """Residuals and their derivatives by the scaled numbers."""

    def residuals(self, scaled: np.ndarray) -> np.ndarray:
        """(m,)"""

    def derivatives(self, scaled: np.ndarray) -> np.ndarray:
        """(m, k) at the last point whose residuals were taken and kept."""


def descend(
    rows: Rows, at: np.ndarray, low: np.ndarray, high: np.ndarray, tries: int,
    hopeless: float = inf,
) -> np.ndarray:  # fmt: skip
    """The least sum of squares nearby, in at most so many evaluations.

    hopeless : sum of squares that is left beyond which none follows the first `FIRST_TRIES`
    """
    off, damping, is_exact = rows.residuals(at), DAMPING, True
    cost, columns = float(off @ off), rows.derivatives(at)
    for number in range(tries):
        if number == FIRST_TRIES and cost > hopeless:
            break
        normal, slope = columns.T @ columns, columns.T @ off
        step = _step(normal, slope, at, (low, high), damping)
        gain = -float(2.0 * slope @ step + step @ normal @ step)
        enough = max(SETTLED * min(max(cost / off.size, 1.0) ** 2, COARSER) * cost, CLOSE)
        moved = rows.residuals(at + step) if gain >= enough else off
        taken = cost - float(moved @ moved)
        if not (is_exact or taken >= max(FOLLOWED * gain, enough)):
            columns, is_exact = rows.derivatives(at), True
            continue
        if gain < enough:
            break
        if not taken > 0.0:
            damping *= HARDER
            if damping > MOST or gain < IDLE * enough:
                break
            continue
        change = moved - off
        at, off, cost = at + step, moved, cost - taken
        damping = max(EASIER * damping, LEAST)
        if taken < enough:
            break
        is_exact = taken < FOLLOWED * gain
        if is_exact:
            columns = rows.derivatives(at)
        else:
            columns = columns + np.outer(change - columns @ step, step / (step @ step))
    return at


def _step(
    normal: np.ndarray, slope: np.ndarray, at: np.ndarray, bounds: tuple[np.ndarray, np.ndarray],
    damping: float,
) -> np.ndarray:  # fmt: skip
    """Damped step; a number that would leave its bounds stops there, the others take note."""
    least, most = bounds[0] - at, bounds[1] - at
    step, is_free = np.zeros(at.size), np.ones(at.size, dtype=bool)
    damped = normal + np.diag(damping * np.diag(normal) + 1e-12 * (np.diag(normal).max() + 1.0))
    for _ in range(at.size):
        if not is_free.any():
            break
        right = -slope[is_free] - damped[np.ix_(is_free, ~is_free)] @ step[~is_free]
        step[is_free] = np.linalg.solve(damped[np.ix_(is_free, is_free)], right)
        beyond = is_free & ((step < least) | (step > most))
        if not beyond.any():
            break
        step = np.where(beyond, np.clip(step, least, most), step)
        is_free &= ~beyond
    step = np.clip(step, least, most)
    return step * min(1.0, LONGEST / max(float(np.abs(step).max()), 1e-300))
