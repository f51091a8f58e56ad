"""The rows of a campaign and the evidence of unknowns in them.

Rows of unit noise z = X b + e. Every unknown b has a Gaussian prior, so that the evidence is in
closed form; what is shared by many unknowns and not known - how much friction scatters from run to
run, how far the tracker's zeros lie apart, how strong and how bent a curve is - is averaged over a
few values. With unit priors, X scaled by the standard deviations,

    ln p(z) = -1/2 (z'z - w'w) - ln det L,    L L' = 1 + X'X,    L w = X'z.
"""

from __future__ import annotations

import weakref
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from scipy.linalg import block_diag
from scipy.special import logsumexp, softmax

from cosim.gap.data import Campaign
from cosim.gap.weak_form.added import Added, Beside, factor_of, factors_of
from cosim.gap.weak_form.constants import (
    BENDS_ASKED,
    SCALES_ASKED,
    SCATTER_ASKED,
    SCATTER_RANGE,
    SCATTER_STEPS,
    ZERO_PARTS_ASKED,
)
from cosim.gap.weak_form.rig_unknowns import (
    SCATTER,
    ZERO_NAME,
    Level,
    contact,
    reading,
    rung_zero,
    scatter,
    set_points,
)
from cosim.gap.weak_form.rows import RunRows
from cosim.gap.weak_form.unknowns import Unknown


class System:
    """Rows of the runs that are fitted, and those held out.

    Attributes
    ----------
    runs, fitted, held_out : runs that have rows
    level : of friction
    rung_zero, contact, scatter : unknowns of every rig
    """

    def __init__(self, campaign: Campaign, runs: Sequence[RunRows], every: bool = False):
        """every : runs that are held out count among the fitted ones"""
        self.campaign = campaign
        self.runs: list[RunRows] = [run for run in runs if len(run)]
        self.fitted: list[RunRows] = [
            run for run in self.runs if every or not run.track.run.hold_out
        ]
        self.held_out: list[RunRows] = [
            run for run in self.runs if run.track.run.hold_out and not every
        ]
        self.level: Level = Level.of(self.runs)
        self.rung_zero: list[Unknown] = [
            *rung_zero(campaign, self.runs), reading(self.level), set_points(campaign),
        ]  # fmt: skip
        self.contact: list[Unknown] = contact(self.level)
        self.scatter: list[Unknown] = scatter(self.level)
        self.rows: np.ndarray = np.concatenate([np.zeros(0), *(run.values for run in self.fitted)])
        self.square: float = float(self.rows @ self.rows)
        #: id of an unknown that there still is -> its columns, X'z, and X'Y with others by theirs.
        self._columns: dict[int, np.ndarray] = {}
        self._rights: dict[int, np.ndarray] = {}
        self._grams: dict[int, dict[int, np.ndarray]] = {}
        ends = np.cumsum([0, *map(len, self.fitted)])
        self._places = {id(run): (number, slice(ends[number], ends[number + 1]))
                        for number, run in enumerate(self.fitted)}  # fmt: skip
        #: What scans for waves have made of the runs (see `periodic`).
        self.waves: dict[Any, Any] = {}
        #: ids of what is added -> that, and name -> what an argument offers beside it (`ladder`).
        self.offers: dict[tuple[int, ...], tuple[tuple[Added, ...], dict[str, Any]]] = {}

    def columns(self, unknown: Unknown) -> np.ndarray:
        """(rows, unknowns) of the fitted runs; made once."""
        if id(unknown) not in self._columns:
            weakref.finalize(
                unknown, _forget, id(unknown), self._columns, self._rights, self._grams
            )
            columns = unknown.columns(self.fitted)
            self._grams.setdefault(id(unknown), {})
            self._rights[id(unknown)] = columns.T @ self.rows
            self._columns[id(unknown)] = columns  # last: another thread may ask for both
        return self._columns[id(unknown)]

    def columns_of(self, unknown: Unknown, run: RunRows) -> np.ndarray:
        """(rows, q) of one run, which need not be among the fitted ones."""
        if id(run) not in self._places:
            return unknown.columns([run])
        (number, rows), q = self._places[id(run)], unknown.size
        columns = self.columns(unknown)[rows]
        return columns[:, number * q : (number + 1) * q] if unknown.per_run else columns

    def gram(self, unknowns: Sequence[Unknown], others: Sequence[Unknown]) -> np.ndarray:
        """X'Y of two lists of unknowns, from pairs that are made once."""
        return np.concatenate(
            [np.concatenate([self._pair(a, b) for b in others], axis=1) for a in unknowns]
        )

    def _pair(self, a: Unknown, b: Unknown) -> np.ndarray:
        product = self._grams.get(id(a), {}).get(id(b))
        if product is None:
            product = self.columns(a).T @ self.columns(b)
            self._grams[id(a)][id(b)], self._grams[id(b)][id(a)] = product, product.T
        return product

    def right(self, unknowns: Sequence[Unknown]) -> np.ndarray:
        """X'z"""
        for unknown in unknowns:
            self.columns(unknown)
        return np.concatenate([self._rights[id(unknown)] for unknown in unknowns])

    def rung(self, added: Sequence[Added] = (), contact: bool = True, scatter: bool = True) -> Rung:
        """The rows with the rig's own unknowns and some more."""
        base = [*self.rung_zero, *self.contact * contact, *self.scatter * scatter]
        return Rung(self, tuple(Added(each) for each in base), tuple(added), (contact, scatter))


def _forget(
    gone: int, columns: dict[int, np.ndarray], rights: dict[int, np.ndarray],
    grams: dict[int, dict[int, np.ndarray]],
) -> None:  # fmt: skip
    """What was made of an unknown that nobody has any more: its id may be another's next."""
    columns.pop(gone, None)
    rights.pop(gone, None)
    for other in list(grams.pop(gone, ())):
        if other in grams:
            grams[other].pop(gone, None)


@dataclass(frozen=True)
class Rung:
    """Rows with some unknowns: how probable they are, and what the unknowns are.

    base : of the rig, with the priors that it states; added : arguments, at their scales
    kinds : whether the contact is no switch, and whether friction may scatter from run to run
    """

    system: System
    base: tuple[Added, ...]
    added: tuple[Added, ...]
    kinds: tuple[bool, bool]

    def with_more(self, more: Sequence[Added]) -> Rung:
        """The same rows with more unknowns."""
        return replace(self, added=(*self.added, *more))

    @property
    def unknowns(self) -> tuple[Added, ...]:
        return (*self.base, *self.added)

    @cached_property
    def settings(self) -> tuple[np.ndarray, np.ndarray]:
        """(h, 2) scatter of friction, spread of the zeros in parts of the stated one; ln weights.

        Evenly over the logarithms, up to what is stated: friction that repeats itself to 0.2 % and
        a tracker that is off by a tenth of its stated error are as probable as any other.
        """
        spreads = np.array(SCATTER_ASKED) if self.kinds[1] else np.zeros(1)
        pairs = np.array([(s, z) for s in spreads for z in ZERO_PARTS_ASKED])
        expected = self.system.campaign.errors.friction
        log_weights = -0.5 * np.square(pairs[:, 0] / expected)
        return pairs, log_weights - logsumexp(log_weights)

    @cached_property
    def _size(self) -> list[int]:
        runs = len(self.system.fitted)
        return [each.unknown.size * (runs if each.unknown.per_run else 1) for each in self.unknowns]

    @cached_property
    def _factor(self) -> np.ndarray:
        """(Q, Q) from unit unknowns to columns, scatter and zeros at 1."""
        runs = len(self.system.fitted)
        return np.asarray(block_diag(*(factor_of(each, runs) for each in self.unknowns)))

    def _deviations(self, pairs: np.ndarray) -> np.ndarray:
        """(h, Q) what settings (h, 2) multiply the unit unknowns by."""
        parts = {SCATTER: pairs[:, 0], ZERO_NAME: pairs[:, 1]}
        columns = [parts.get(each.unknown.name, np.ones(len(pairs))) for each in self.unknowns]
        return np.repeat(np.column_stack(columns), self._size, axis=1)

    def _at(self, pairs: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Of settings (h, 2): Cholesky factors (h, Q, Q), w (h, Q) and ln evidences (h,)."""
        names = [each.unknown for each in self.unknowns]
        gram = self._factor.T @ self.system.gram(names, names) @ self._factor
        right = self._factor.T @ self.system.right(names)
        scale = self._deviations(pairs)
        inner = scale[:, :, None] * gram * scale[:, None, :] + np.eye(gram.shape[0])
        lower = np.linalg.cholesky(inner)
        w = np.linalg.solve(lower, (scale * right)[:, :, None])[:, :, 0]
        determinants = np.log(np.einsum("hii->hi", lower)).sum(axis=1)
        return lower, w, -0.5 * (self.system.square - np.sum(w**2, axis=1)) - determinants

    @cached_property
    def _solved(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        return self._at(self.settings[0])

    @cached_property
    def whitens(self) -> np.ndarray:
        """(h, Q, Q) from X'z to w."""
        turned = self._deviations(self.settings[0])[:, :, None] * self._factor.T
        return np.asarray(np.linalg.solve(self._solved[0], turned))

    @property
    def weights(self) -> np.ndarray:
        """(h,) ln weight and determinant of each setting: with w'w / 2 its ln evidence."""
        lower = self._solved[0]
        return np.asarray(self.settings[1] - np.log(np.einsum("hii->hi", lower)).sum(axis=1))

    @property
    def evidences(self) -> np.ndarray:
        """(h,) ln evidence of each setting, with its weight."""
        return np.asarray(self._solved[2] + self.settings[1])

    @property
    def evidence(self) -> float:
        """ln evidence."""
        return float(logsumexp(self.evidences))

    @property
    def best(self) -> int:
        """Number of the most probable setting."""
        return int(np.argmax(self.evidences))

    def offered(self, variants: Sequence[Unknown]) -> tuple[float, Added]:
        """ln evidence with one more argument, averaged over its variants, and the best of these."""
        totals, best = [], []
        for unknown in variants:
            values = self._with(unknown)
            totals.append(logsumexp(values) + np.log(unknown.weight))
            scale, bend = np.unravel_index(int(np.argmax(values)), values.shape)
            bends = BENDS_ASKED if unknown.bends is not None else (0.0,)
            best.append((totals[-1], Added(unknown, SCALES_ASKED[scale], bends[bend])))
        return (
            float(logsumexp(totals) - np.log(sum(unknown.weight for unknown in variants))),
            max(best, key=lambda pair: pair[0])[1],
        )

    def forms(self, unknown: Unknown) -> Iterator[tuple[float, Added]]:
        """ln evidence with one more argument and that, for each bend of its curve."""
        bends = BENDS_ASKED if unknown.bends is not None else (0.0,)
        for bend, values in zip(bends, self._with(unknown).T, strict=True):
            scale = SCALES_ASKED[int(np.argmax(values))]
            yield float(logsumexp(values)), Added(unknown, scale, bend)

    def _with(self, unknown: Unknown) -> np.ndarray:
        """(scales, bends) ln evidence with one more unknown, each with its weight."""
        option = self.beside((unknown,), factors_of(unknown, len(self.system.fitted)), SCALES_ASKED)
        w, right = self._solved[1][:, :, None], self.system.right([unknown])[:, None]
        values = option.offered(right, w, self.evidences[:, None])[:, 0]
        return np.asarray(values.reshape(-1, len(SCALES_ASKED)).T - np.log(values.size))

    def beside(
        self, unknowns: Sequence[Unknown], factors: Sequence[np.ndarray], scales: Sequence[float]
    ) -> Beside:
        """More unknowns beside these. factors : (q, q) each, from unit unknowns to columns"""
        half = self.whitens @ self.system.gram([each.unknown for each in self.unknowns], unknowns)
        across = np.swapaxes(half, 1, 2)
        gram = self.system.gram(unknowns, unknowns) - across @ half
        axes = []
        for factor in factors:
            g, v = np.linalg.eigh(factor.T @ gram @ factor)
            axes.append((np.maximum(g, 0.0), np.swapaxes(factor @ v, 1, 2)))
        return Beside(tuple(unknowns), across, axes, np.array(scales))

    @cached_property
    def posterior(self) -> tuple[np.ndarray, np.ndarray]:
        """Mean (Q,) and covariance (Q, Q) of the columns' unknowns at the most probable setting."""
        lower, w, _ = self._solved
        factor = self._factor * self._deviations(self.settings[0])[self.best]
        half = np.linalg.solve(lower[self.best], factor.T)
        return half.T @ w[self.best], half.T @ half

    @cached_property
    def residuals(self) -> np.ndarray:
        """(rows,) of the fitted runs, in units of the noise."""
        columns = np.hstack([self.system.columns(each.unknown) for each in self.unknowns])
        return np.asarray(self.system.rows - columns @ self.posterior[0])

    def left(self, run: RunRows) -> np.ndarray:
        """(rows,) residuals of a run that need not be among the fitted ones.

        What is shared is free within what the fitted runs leave of it, which is much where they
        never show it; what is the run's own, its zero and its friction within the scatter that the
        others show, is free within its prior.
        """
        rows, own = run.values.copy(), []
        mean, covariance = self.posterior
        shared = [(each, part) for each, part in self._parts if not each.unknown.per_run]
        columns = np.hstack([self.system.columns_of(each.unknown, run) for each, _ in shared])
        places = np.concatenate([np.arange(part.start, part.stop) for _, part in shared])
        rows -= columns @ mean[places]
        inside = covariance[np.ix_(places, places)]
        own.append(columns @ np.linalg.cholesky(inside + 1e-12 * np.diag(np.diag(inside))))
        scatter, zeros = self.settings[0][self.best]
        for each in self.unknowns:
            if not each.unknown.per_run:
                continue
            columns = self.system.columns_of(each.unknown, run)
            scale = {SCATTER: scatter, ZERO_NAME: zeros}.get(each.unknown.name, 1.0)
            own.append(scale * (columns @ each.factor))
        free = np.hstack(own)
        inner = free.T @ free + np.eye(free.shape[1])
        return np.asarray(rows - free @ np.linalg.solve(inner, free.T @ rows))

    @property
    def held_out_gap(self) -> float | None:
        """Root mean square of what is left of the runs that were held out."""
        left = [self.left(run)[run.counted > 0.0] for run in self.system.held_out]
        return float(np.sqrt(np.mean(np.concatenate(left) ** 2))) if left else None

    @cached_property
    def _parts(self) -> list[tuple[Added, slice]]:
        """Unknowns, and where their numbers stand."""
        ends = np.cumsum([0, *self._size])
        pairs = zip(self.unknowns, zip(ends, ends[1:], strict=False), strict=True)
        return [(each, slice(int(a), int(b))) for each, (a, b) in pairs]

    def part_of(self, added: Added) -> slice:
        """Where an added unknown's numbers stand."""
        for each, part in self._parts:
            if each is added:
                return part
        raise KeyError(added.unknown.name)

    @property
    def gap(self) -> float:
        """Root mean square of the residuals: 1 is noise."""
        return float(np.sqrt(np.mean(self.residuals**2)))

    @property
    def misfit(self) -> float:
        """Sum of squares beyond the noise's."""
        return float(max(self.residuals @ self.residuals - self.residuals.size, 0.0))

    def scatter_posterior(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(s,) values of the scatter of friction; their probabilities as the rows alone have them,
        and with what is expected beforehand.

        Over all spreads of the zeros: a block that slides one way only is pushed aside alike by its
        own friction and by its tracker's zero.
        """
        spreads = np.geomspace(*SCATTER_RANGE, SCATTER_STEPS)
        pairs = np.array([(s, z) for s in spreads for z in ZERO_PARTS_ASKED])
        values = logsumexp(self._at(pairs)[2].reshape(spreads.size, -1), axis=1)
        expected = values - 0.5 * np.square(spreads / self.system.campaign.errors.friction)
        return spreads, softmax(values), softmax(expected)
