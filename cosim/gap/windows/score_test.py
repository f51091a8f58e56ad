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

from .fitted import Fitted
from .numbers import Number
from .problem import Problem
from .windows import Windows

#: Part of an effect that is put into the model; what it does to a residual is then some tenth of
#: the noise, or is made so in so many rounds: far above the integrator's error, and still linear.
LITTLE, FELT, WANTED, ROUNDS = 0.02, (0.02, 1.0), 0.2, 3
#: Phases of a wave, degrees: of two any other is a sum.
PHASES = (0.0, 90.0)
PHASE = "phase_deg"


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
        is_felt = sizes > 1e-9 * sizes.max(initial=0.0)
        return cls(problem, scaled, residuals, basis[:, is_felt], max(fitted.misfit, 1.0))

    def promised(
        self, more: Sequence[Number], settings: Mapping[str, float], starts: Mapping[str, float]
    ) -> float:
        """ln of how much more probable the runs would be with these numbers, too.

        0 of an effect that would have to turn its sign, and of one without a number that says how
        large it is. A wave may have any size and phase in every run.
        """
        strengths = [n for n in more if n.low <= 0.0 <= n.high and n.scope != "run"
                     and not n.key.rpartition(".")[2].startswith("static_")]  # fmt: skip
        if not strengths:
            return 0.0
        is_wave = any(number.key.endswith(PHASE) for number in more)
        base = {**settings, **{number.key: number.start for number in more}, **starts}
        columns = self._columns(base, strengths, PHASES if is_wave else (0.0,))
        if is_wave:
            columns = self._of_each_run(columns)
        left = columns - self.basis @ (self.basis.T @ columns)
        step = np.linalg.lstsq(left, -self.residuals, rcond=None)[0]
        if not is_wave and step[0] < 0.0 and all(number.low >= 0.0 for number in strengths):
            return 0.0
        remains = self.residuals + left @ step
        return float(self.residuals @ self.residuals - remains @ remains) / (2.0 * self.misfit)

    def _columns(
        self, base: Mapping[str, float], strengths: Sequence[Number], phases: Sequence[float]
    ) -> np.ndarray:
        """(m, phases) what a little of an effect changes."""
        part, columns = LITTLE, np.zeros((self.residuals.size, len(phases)))
        for _ in range(ROUNDS):
            little = {**base, **{n.key: part * n.start for n in strengths}}
            columns = np.column_stack([self.problem.changes(self.scaled, _turned(little, phase))
                                       for phase in phases])  # fmt: skip
            size = float(np.sqrt(np.mean(columns**2)))
            if size == 0.0 or FELT[0] < size < FELT[1]:
                break
            part *= WANTED / size
        return columns

    def _of_each_run(self, columns: np.ndarray) -> np.ndarray:
        """(m, runs phases) columns of one run alone each."""
        rows = self.problem.rows
        alone = np.zeros((len(columns), len(rows), columns.shape[1]))
        for number, own in enumerate(rows):
            alone[own, number] = columns[own]
        return alone.reshape(len(columns), -1)


def _turned(values: Mapping[str, float], phase: float) -> dict[str, float]:
    """With a wave's phases farther by so much, degrees."""
    return {label: value + phase if label.partition("@")[0].endswith(PHASE) else value
            for label, value in values.items()}  # fmt: skip
