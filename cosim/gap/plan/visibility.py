"""How visible a law is in a planned campaign: what of its motion no plain model can follow.

The plain model is fitted to the motion with the law, and what is left, in noise units, is the law's
visibility. Squared it is the noncentrality of the likelihood-ratio test for the law.

The first guess is linear: the response to a faint start of the law, less what the plain model's
free parameters and the segments' states take up. From there the size is moved until the response of
that size, with the plain model really refitted, is as long as is wanted: an effect as large as is
needed to be seen may have a motion of its own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from cosim.gap.estimation.columns import Columns
from cosim.gap.estimation.fit import fit
from cosim.gap.estimation.fitted import Point

from .law import Law, bent, residuals, turned, with_law
from .linear import RANK, Nuisance
from .planned import Rehearsal

#: Part of its usual start that a law has for its linear response.
FAINT = 0.02
#: Rounds of a refit of the plain model: with the derivatives kept, and with their own, which set
#: out from where the former have ended.
_ROUNDS = {True: 10, False: 6}
#: Sizes that are tried: enough of them where one, though too large, is seen; and at the very most.
_ENOUGH, _MOST = 6, 16
#: How near to the wanted noncentrality sizes have to come: 4 % of it move a chance of 90 % by one
#: percent.
_NEAR = 0.04
#: Instead of nothing, where a number is divided by.
_NONE = 1e-12
#: A size is changed by at most this factor at once: a motion of another regime tells nothing.
_LEAP = 4.0


@dataclass(frozen=True)
class Visible:
    """A law at the smallest size that would be named.

    Attributes
    ----------
    law, part : and its size in parts of its start; infinite where no size that it may have is seen
    noncentrality : at that size, or at the largest that was tried
    linear : the same by derivatives alone
    response : (rows + g,) what the refitted plain model leaves
    others : (rows + g, k) derivatives of that by the law's shapes and phases
    percent_of_start : the law at its start as percent of friction: so much more friction moves the
        block as much
    """

    law: Law
    part: float
    noncentrality: float
    linear: float
    response: np.ndarray = field(repr=False)
    others: np.ndarray = field(repr=False)
    percent_of_start: float

    @property
    def is_seen(self) -> bool:
        """Whether there is such a size."""
        return bool(np.isfinite(self.part))

    @property
    def percent(self) -> float:
        """The smallest size as percent of friction."""
        return self.part * self.percent_of_start if self.is_seen else np.inf


def smallest(rehearsal: Rehearsal, law: Law, target: float, per_cent: float) -> Visible:
    """The size of a law at which it leaves a wanted noncentrality.

    per_cent : length of the response to one percent more friction (see `friction_length`)
    """
    nuisance = Nuisance(rehearsal)
    faint = FAINT * min(1.0, law.most)
    raw = residuals(rehearsal, law, faint)
    left = nuisance.left(raw)
    linear = float(left @ left) / faint**2
    percent = _length(raw) / faint / per_cent
    if linear <= RANK * _length(raw) ** 2 / faint**2:  # the plain model takes all of it
        nothing = np.zeros((left.size, 0))
        return Visible(law, np.inf, 0.0, 0.0, left, nothing, percent)
    part, squares, point = _search(rehearsal, law, target, linear)
    reached = squares >= _reached(target)
    response, others = _tangent(rehearsal, nuisance, law, part, point)
    return Visible(
        law, part if reached else np.inf, squares, linear * part**2, response, others, percent
    )


def friction_length(rehearsal: Rehearsal) -> float:
    """Length of the plain model's response to one percent more of mu_s and mu_k, states held."""
    keys = ("friction.mu_s", "friction.mu_k")
    start = {free.key: free.start for free in rehearsal.free_parameters}
    scaled = [
        free.scaled(1.01 * start[free.key]) if free.key in keys else shared
        for free, shared in zip(rehearsal.problem.shared, rehearsal.point.shared, strict=True)
    ]
    at = rehearsal.point
    rows = rehearsal.problem.all_residuals(Point(np.array(scaled), at.own, at.states))
    return _length(rows)


def _length(parts: Sequence[np.ndarray]) -> float:
    return float(np.sqrt(sum(part @ part for part in parts)))


def _search(
    rehearsal: Rehearsal, law: Law, target: float, linear: float
) -> tuple[float, float, Point]:
    """(part, noncentrality, refitted plain model) nearest to a noncentrality.

    First by refits that keep the derivatives of the plain model (the chord method), which are
    cheap; then by whole ones from there: mostly one, which finds the size confirmed.
    """
    part = min(float(np.sqrt(target / linear)), law.most)
    part, _, at = _approached(rehearsal, law, target, part, None, chord=True)
    return _approached(rehearsal, law, target, part, at, chord=False)


def _approached(
    rehearsal: Rehearsal, law: Law, target: float, part: float, at: Point | None, chord: bool
) -> tuple[float, float, Point]:
    """Length in proportion to size leads there in few steps; what is bracketed is halved."""
    low, high = 0.0, np.inf
    tried: list[tuple[float, float, Point]] = []
    for count in range(1, _MOST + 1):
        tried.append((part, *refitted(rehearsal, law, part, at, chord)))
        squares, at = tried[-1][1:]
        ended = squares < target and part >= law.most
        seen = [each for each in tried if each[1] >= _reached(target)]
        if abs(squares / target - 1.0) < _NEAR or ended or (seen and count >= _ENOUGH):
            break
        low, high = (part, high) if squares < target else (low, part)
        leap = np.sqrt(target / max(squares, _NONE))
        part = min(part * float(np.clip(leap, 1.0 / _LEAP, _LEAP)), law.most)
        if not low < part < high:
            part = 0.5 * (low + high)
    return min(seen or tried, key=lambda each: abs(np.log(max(each[1], _NONE) / target)))


def _reached(target: float) -> float:
    """Noncentrality that counts as the wanted one."""
    return (1.0 - 2.0 * _NEAR) * target


def refitted(
    rehearsal: Rehearsal, law: Law, part: float, at: Point | None = None, chord: bool = False
) -> tuple[float, Point]:
    """Sum of squares that a law of some size costs the plain model, refitted, and its point.

    The data stay the plain model's: how far its motions are from those with the law is the same
    seen from either side. What is known of the free parameters beforehand counts. at : where the
    refit sets out; chord : with the derivatives that the plain model has at its own motion
    """
    problem, point = with_law(rehearsal, law, part)

    def derivatives(run: int, at: Point, residuals: np.ndarray) -> Columns:
        return replace(rehearsal.columns[run], residuals=residuals)

    chord = chord and len(problem.free_parameters) == len(rehearsal.free_parameters)
    kept = derivatives if chord else None
    fitted = fit(problem, at or point, _ROUNDS[chord], derivatives=kept)
    known = problem.prior(fitted.point.shared)[0]
    return fitted.cost + float(known @ known), fitted.point


def _tangent(
    rehearsal: Rehearsal, nuisance: Nuisance, law: Law, part: float, point: Point
) -> tuple[np.ndarray, np.ndarray]:
    """What the refitted plain model leaves of a law, and its derivatives by shapes and phases."""
    here = residuals(rehearsal, law, part, at=point)
    columns = [*bent(rehearsal, law, part, point), *_apiece(turned(rehearsal, law, part, point))]
    stacked = [np.column_stack(parts) for parts in zip(here, *columns, strict=True)]
    known = rehearsal.problem.prior(point.shared)[0]
    left = nuisance.left(stacked, known)
    return left[:, 0], left[:, 1:]


def _apiece(by_run: Sequence[np.ndarray]) -> list[list[np.ndarray]]:
    """Columns that act in one run each, of (rows, k) per run."""
    return [
        [part[:, j] if i == run else np.zeros(len(part)) for i, part in enumerate(by_run)]
        for run, own in enumerate(by_run)
        for j in range(own.shape[1])
    ]
