"""What a curve takes away, run by run, and what it looks like, from columns of a mixed model."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.stats import norm

from cosim.gap.evidence.mixed import Law, MixedModel, Solution
from cosim.gap.evidence.products import Spreads, deviations
from cosim.gap.evidence.settled import Settled, best_spreads

from .curve import Curve
from .spline import Spline

#: Standard deviations of a curve's roughness that are compared by likelihood, parts of friction:
#: next to a straight line, and what bends within the range as laws of friction do. A rougher one
#: takes up at low speeds what is mu_s and its transition.
ROUGH = (0.003, 0.01, 0.03)
#: The line's, from its middle to its end: of friction everything.
LINE = 1.0
#: Part of the probability that a band holds.
BAND = 0.90
#: Spreads of friction are looked for anew with a curve, which takes up what was put down to them:
#: a first look at parts of those without it, then a search of so many steps.
_PARTS, _STEPS = (1.0, 0.3, 0.1, 0.03), 6
#: Places at which a curve is stated.
PLACES = 41


@dataclass(frozen=True)
class Columns:
    """A curve's columns in a mixed model, and what it moves.

    Attributes
    ----------
    axis, on, memory, per : see `Curve`
    mixed : with the curve's columns, one for each of the spline's, as its laws
    spline : over the axis
    unit : of the curve for a coefficient of one in the mixed model: part of friction, or N
    scale : of the curve, in its unit, that is as large as all of friction
    """

    axis: str
    on: str
    mixed: MixedModel
    spline: Spline
    unit: float = 1.0
    scale: float = 1.0
    memory: float = 0.0
    per: str = ""

    def laws(self, rough: float) -> list[Law]:
        """The columns with what is usual of them."""
        part = self.scale / self.unit
        widths = [LINE * part, *[rough * part] * (self.spline.size - 1)]
        return [Law(number, width=width) for number, width in enumerate(widths)]


@dataclass(frozen=True)
class Vote:
    """A curve's columns with spreads of friction near those of largest likelihood."""

    columns: Columns
    spreads: Spreads
    deviance: float


def quick(base: Settled, columns: Columns) -> Vote:
    """The best of every roughness, with spreads of friction as they were, or smaller."""
    found = []
    for part in _PARTS:
        friction, stretch, static, zero, speed = base.spreads
        spreads = Spreads(part * friction, part * stretch, part * static, zero, speed)
        wide = deviations(base.problem, base.fitted, base.model.free_parameters, spreads)
        forms = columns.mixed.forms(wide)
        for rough in ROUGH:
            laws = columns.laws(rough)
            deviance = columns.mixed.solved(forms, wide, laws, predict=False).deviance
            found.append(Vote(columns, spreads, deviance))
    return min(found, key=lambda vote: vote.deviance)


def counted(base: Settled, vote: Vote) -> Curve:
    """The curve, and its gain over the settled model, with the likeliest roughness and spreads."""
    columns, about = vote.columns, (base.problem, base.fitted, base.model.free_parameters)
    found = []
    for rough in ROUGH:
        laws = columns.laws(rough)
        spreads, deviance = best_spreads(columns.mixed, *about, vote.spreads, laws, _STEPS)
        found.append((deviance, rough, spreads))
    _, rough, spreads = min(found, key=lambda each: each[0])
    wide = deviations(*about, spreads)
    solution = columns.mixed.solved(columns.mixed.forms(wide), wide, columns.laws(rough))
    gains = base.left_out - solution.left_out
    error = float(np.std(gains, ddof=1) * np.sqrt(gains.size)) if gains.size > 1 else np.inf
    values, mean, deviation, centre = _drawn(columns, solution)
    reach = norm.ppf(0.5 + 0.5 * BAND) * deviation
    level = _kinetic(base, solution)
    if columns.on != "force":
        level *= float(np.exp(centre))
    return Curve(
        columns.axis, columns.on, values, mean, mean - reach, mean + reach, float(gains.sum()),
        error, gains, level, columns.memory, columns.per,
    )  # fmt: skip


def _drawn(
    columns: Columns, solution: Solution
) -> tuple[np.ndarray, np.ndarray, np.ndarray, float]:
    """Values of the axis, the curve less its mean over them, its standard deviation, that mean."""
    values = columns.spline.grid(PLACES)
    basis = columns.unit * columns.spline.columns(values)
    middle = basis.mean(axis=0)
    size = columns.spline.size
    strengths = solution.values[-size:]
    covariance = np.linalg.pinv(solution.information, hermitian=True)[-size:, -size:]
    about = basis - middle
    variance = np.einsum("ij,jk,ik->i", about, covariance, about)
    deviation = np.sqrt(np.clip(variance, 0.0, None))
    return values, about @ strengths, deviation, float(middle @ strengths)


def _kinetic(base: Settled, solution: Solution) -> float:
    """mu_k as the model with the curve has it."""
    place = [free.key for free in base.problem.shared].index("friction.mu_k")
    free, scaled = base.problem.shared[place], base.fitted.point.shared[place]
    return free.value(free.inside(scaled + solution.values[place]))
