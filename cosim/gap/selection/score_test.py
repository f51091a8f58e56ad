"""Score test (Rao 1948): what each law could take away from the misfit if it acted linearly.

The law is put into the fitted model as next to nothing; its response, less what the model's own
free parameters and the runs' states can take up, is projected on the residuals.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from stickslip.effects.candidate import Candidate

from cosim.gap.estimation.fitted import Fitted, shared_of
from cosim.gap.estimation.problem import Problem
from cosim.gap.estimation.segmented_run import SegmentedRun
from cosim.gap.estimation.trial import Model
from cosim.processes import Map

#: Two laws mask one another where together they explain this part, and so many times
#: what either does alone: what one adds, the other takes away.
_MASKING, _TIMES = 0.3, 1.5


@dataclass(frozen=True)
class ScoreTest:
    """What laws could take away, alone and in pairs.

    Attributes
    ----------
    laws : the laws
    left : (1 + laws, 1 + laws) products of the residuals and of the laws' responses with one
        another, less what the model's own free parameters and the runs' states take up
    """

    laws: tuple[Candidate, ...]
    left: np.ndarray

    def gains(self) -> np.ndarray:
        """(laws,) part of the sum of squares that each explains; 0 if it points away."""
        along, own = -self.left[0, 1:], np.diag(self.left)[1:]
        least = 1e-12 * max(self.left[0, 0], 1e-300)
        return np.where(along > 0.0, along**2 / np.maximum(own, least), 0.0) / self.left[0, 0]

    def masking_pair(self) -> tuple[Candidate, Candidate] | None:
        """The two that explain most together, if neither does so alone; as strong as they come."""
        alone, best = self.gains(), _MASKING
        found: tuple[Candidate, Candidate] | None = None
        for i, j in combinations(range(len(self.laws)), 2):
            if self.laws[i].effect == self.laws[j].effect:
                continue
            strengths, gain = self._together(i, j)
            if gain > max(best, _TIMES * max(alone[i], alone[j])) and np.all(strengths > 0.0):
                best = gain
                first, second = (float(strength) for strength in strengths)
                found = self.laws[i].times(first), self.laws[j].times(second)
        return found

    def _together(self, i: int, j: int) -> tuple[np.ndarray, float]:
        """Strengths (2,) of two laws, in their own, and the part that they explain."""
        places = [i + 1, j + 1]
        matrix, along = self.left[np.ix_(places, places)], -self.left[0, places]
        strengths = np.linalg.lstsq(matrix, along, rcond=1e-6)[0]
        return strengths, float(strengths @ along) / self.left[0, 0]


def score_test(
    segmented_runs: Sequence[SegmentedRun],
    base: Model,
    fitted: Fitted,
    laws: Sequence[Candidate],
    mapped: Map,
) -> ScoreTest:
    """All laws screened on top of a fitted base.

    fitted : of the base, with derivatives
    """
    faint = tuple(law.faint() for law in laws)
    runs = [(segmented, base, fitted, i, faint) for i, segmented in enumerate(segmented_runs)]
    products = np.sum(list(mapped(products_of_run, runs)), axis=0)
    count = products.shape[0] - 1 - len(laws)
    taken = np.linalg.lstsq(products[:count, :count], products[:count, count:], rcond=1e-10)[0]
    return ScoreTest(faint, products[count:, count:] - products[count:, :count] @ taken)


def products_of_run(
    segmented: SegmentedRun, base: Model, fitted: Fitted, run: int, laws: Sequence[Candidate]
) -> np.ndarray:
    """Products, over one run, of free parameters' columns, residuals and laws' responses.

    (g + 1 + l, g + 1 + l) among g free parameters, the residuals and l laws.
    """
    at = fitted.point.shared, fitted.point.own[run], fitted.point.states[run]
    residuals, columns = fitted.residuals[run], fitted.derivatives[run]
    found = [_with_law(segmented, base, law, at) - residuals for law in laws]
    left = columns.left(np.column_stack([columns.shared, residuals, *found]))
    return left.T @ left


def _with_law(segmented: SegmentedRun, base: Model, law: Candidate, at) -> np.ndarray:
    """Residuals with the law, which is a faint one, in the model."""
    faint = {free.key: free.start for free in law.free_parameters}
    settings = {**base.settings, **law.settings, **faint}
    free_parameters = tuple(free for free in base.free_parameters if free.key not in faint)
    kept = [
        s
        for free, s in zip(shared_of(base.free_parameters), at[0], strict=True)
        if free.key not in faint
    ]
    return Problem([segmented], free_parameters, settings).residuals(0, np.array(kept), *at[1:])
