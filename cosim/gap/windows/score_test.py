"""What more numbers would gain, from derivatives at a fitted model alone: Rao's score test.

C. R. Rao, Math. Proc. Cambridge Phil. Soc. 44 (1948). Residuals r and derivatives J by the numbers
of a fit are there; u is what a little of an effect does to r, normal to J. To first order the least
sum of squares with the effect is lower by (u'r)^2 / u'u. That costs one simulation of every run, in
place of a fit.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import qr

from cosim.gap.data import Campaign

from .fitted import RANK, Fitted
from .numbers import Number
from .problem import Problem
from .windows import Windows

#: Part of an effect that is put into the model; what it does to a residual is then some tenth of
#: the noise, or is made so in so many rounds: far above the integrator's error, and still linear.
LITTLE, FELT, WANTED, ROUNDS = 0.02, (0.02, 1.0), 0.2, 3


@dataclass(frozen=True)
class ScoreTest:
    """A fitted model, its residuals (m,) and an orthonormal basis (m, k) of its derivatives."""

    problem: Problem
    scaled: np.ndarray
    residuals: np.ndarray
    basis: np.ndarray
    misfit: float

    @classmethod
    def at(
        cls, campaign: Campaign, windows: Mapping[str, Windows], numbers: Sequence[Number],
        settings: Mapping[str, float], fitted: Fitted, jobs: int = 2,
    ) -> ScoreTest:  # fmt: skip
        """numbers, settings : of the fit; of its runs those held out are not asked"""
        runs = [run for run in campaign.fit_runs if run.name in windows]
        states = {run.name: run.states for run in fitted.runs}
        problem = Problem(campaign, runs, windows, numbers, settings, near=states, jobs=jobs)
        scaled = problem.scaled(fitted.values)
        residuals, derivatives = problem.residuals(scaled), problem.derivatives(scaled)
        basis, triangle, _ = qr(derivatives, mode="economic", pivoting=True)
        sizes = np.abs(np.diag(triangle))
        is_felt = sizes > RANK * sizes.max(initial=0.0)
        return cls(problem, scaled, residuals, basis[:, is_felt], max(fitted.misfit, 1.0))

    def promised(
        self, more: Sequence[Number], settings: Mapping[str, float], starts: Mapping[str, float]
    ) -> float | None:
        """ln of how much more probable the runs would be with these numbers, too.

        0 of an effect that would have to turn its sign; None of one without a number that says how
        large it is. Phases stay as given.
        """
        strengths = [n for n in more if n.may_vanish and n.scope != "run"
                     and not n.key.rpartition(".")[2].startswith("static_")]  # fmt: skip
        if not strengths:
            return None
        base = {**settings, **{number.key: number.start for number in more}, **starts}
        change = self._change(base, strengths)
        left = change - self.basis @ (self.basis.T @ change)
        along, square = float(left @ self.residuals), float(left @ left)
        turns_sign = along > 0.0 and all(number.low >= 0.0 for number in strengths)
        return 0.0 if turns_sign or square == 0.0 else along**2 / square / (2.0 * self.misfit)

    def _change(self, base: Mapping[str, float], strengths: Sequence[Number]) -> np.ndarray:
        """(m,) of the residuals by a little of an effect."""
        part, change = LITTLE, np.zeros_like(self.residuals)
        for _ in range(ROUNDS):
            little = {**base, **{number.key: part * number.start for number in strengths}}
            change = self.problem.changes(self.scaled, little)
            size = float(np.sqrt(np.mean(change**2)))
            if size == 0.0 or FELT[0] < size < FELT[1]:
                break
            part *= WANTED / size
        return change
