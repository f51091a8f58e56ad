"""Residuals of some runs as a function of free parameters and of the segments' states."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from stickslip.effects.candidate import OFFSETS, FreeParameter

from .columns import Columns
from .drive import FRICTION_OFFSET, SCATTERED, STIFFNESS_OFFSET, stiffness_offset
from .fitted import Point, own_of, shared_of
from .segmented_run import SegmentedRun
from .segments import FRICTION, STATES, Segment

#: Longest step of a run's own numbers that are known beforehand, in their steps.
_LONGEST_KNOWN = 10.0
#: Differences are taken over this part of a free parameter's step.
_PART = 1e-2
#: Steps of the segments' states: positions m (and rad), velocities m/s (and rad/s), friction.
STATE_STEP = np.array([1e-4, 1e-4, 1e-3, 1e-3, 1e-3, 1e-2, 5e-3, 5e-3])
#: A segment whose sum of squares grows by more than this was thrown off course by its own step.
_GROWTH, _GROWTH_SLACK = 1.5, 10.0


class Problem:
    """Some runs, the free parameters to be fitted and what else is set.

    local : spread of friction, and of static friction beside it, from segment to segment, parts of
    it; 0 where a run's friction is the same all along
    """

    def __init__(
        self,
        segmented_runs: Sequence[SegmentedRun],
        free_parameters: Sequence[FreeParameter],
        settings: dict[str, float] | None = None,
        local: tuple[float, float] = (0.0, 0.0),
    ):
        self.segmented_runs, self.free_parameters = tuple(segmented_runs), tuple(free_parameters)
        self.settings, self.local = dict(settings or {}), local
        self.shared, self.own = shared_of(free_parameters), own_of(free_parameters)

    def of_run(self, run: int) -> Problem:
        """The same of one run alone."""
        alone = [self.segmented_runs[run]]
        return Problem(alone, self.free_parameters, self.settings, self.local)

    def inside(self, shared: np.ndarray) -> np.ndarray:
        """(g,) the campaign's free parameters, scaled, or the nearest that are allowed."""
        return np.array([free.inside(s) for free, s in zip(self.shared, shared, strict=True)])

    def residuals(self, run: int, shared, own, states) -> np.ndarray:
        """(rows,) of one run."""
        values, states, offsets = self._set_for(shared, own, states)
        segmented = self.segmented_runs[run]
        rows = segmented.residuals(segmented.places(values, states), offsets)
        return np.concatenate([rows, self._known_of_own(own), self._known_of_friction(states)])

    @property
    def longest_own(self) -> np.ndarray:
        """(k,) longest steps of the run's own: where it is known beforehand, that holds it."""
        return np.array([1.0 if free.prior is None else _LONGEST_KNOWN for free in self.own])

    def free_axes(self, segment: Segment) -> tuple[int, ...]:
        """Which numbers of a segment's state are free."""
        local = (axis for axis, spread in zip(FRICTION, self.local, strict=True) if spread > 0.0)
        return (*segment.free, *local)

    def _known_of_friction(self, states: np.ndarray) -> np.ndarray:
        """Rows for what is known beforehand of friction in the segments: axis by axis."""
        local = zip(FRICTION, self.local, strict=True)
        rows = [states[:, axis] / spread for axis, spread in local if spread > 0.0]
        return np.concatenate([np.empty(0), *rows])

    def simulated(self, run: int, shared, own, states) -> tuple[np.ndarray, dict[str, float]]:
        """The model's outputs (n, O_SIZE) of one run, and the tracker's zeros."""
        values, states, offsets = self._set_for(shared, own, states)
        return self.segmented_runs[run].simulate(values, states), offsets

    def _set_for(self, shared, own, states) -> tuple[dict[str, float], np.ndarray, dict]:
        """Parameters, segments' states (segments, 8) as the model has them, and tracker's zeros."""
        values = dict(self.settings)
        values.update(
            (free.key, free.value(s)) for free, s in zip(self.shared, shared, strict=True)
        )
        values.update((free.key, free.value(s)) for free, s in zip(self.own, own, strict=True))
        offsets = {key: values.pop(key) for key in OFFSETS if key in values}
        states = states.copy()
        for axis, key in enumerate(OFFSETS):  # states are measured ones: with the tracker's zero
            states[:, axis] -= offsets.get(key, 0.0)
        return values, states, offsets

    def _known_of_own(self, own) -> np.ndarray:
        """Rows for what is known beforehand of a run's own free parameters."""
        return np.array(
            [
                (free.value(s) - free.start) / free.prior
                for free, s in zip(self.own, own, strict=True)
                if free.prior is not None
            ]
        )

    def by_segment(self, run: int, residuals: np.ndarray) -> np.ndarray:
        """(segments,) sums of squares of one run."""
        return np.bincount(self._owner(run), residuals**2, len(self.segmented_runs[run].segments))

    def misfit(self, run: int, residuals: np.ndarray) -> float:
        """Of one run, so that no segment that was thrown off course outweighs the others."""
        squares = self.by_segment(run, residuals)
        rows = np.maximum(self.by_segment(run, np.ones_like(residuals)), 1.0)
        return float(np.sum(rows * np.log1p(squares / rows)))

    def _owner(self, run: int) -> np.ndarray:
        """(rows,) segment of each row; what is known beforehand is put to the first."""
        own = sum(free.prior is not None for free in self.own)
        each = np.arange(len(self.segmented_runs[run].segments))
        local = [each for spread in self.local if spread > 0.0]
        parts = [self.segmented_runs[run].segment_of_rows(), np.zeros(own, dtype=int), *local]
        return np.concatenate(parts)

    def all_residuals(self, point: Point) -> tuple[np.ndarray, ...]:
        """Of every run."""
        return tuple(
            self.residuals(i, point.shared, point.own[i], point.states[i])
            for i in range(len(self.segmented_runs))
        )

    def columns(self, run: int, point: Point, residuals: np.ndarray, free_shared) -> Columns:
        """Derivatives of one run by differences, its own part factorised."""
        at = point.shared, point.own[run], point.states[run]
        by_state = self._by_state(run, at, residuals)
        shared = np.zeros((residuals.size, len(self.shared)))
        for j in free_shared:
            if self.is_felt(run, self.shared[j]):
                shared[:, j] = self.difference(run, at, 0, j, self.shared[j], residuals)
        own = np.zeros((residuals.size, len(self.own)))
        for j, free in enumerate(self.own):
            known = self._known_response(run, at, j, shared, by_state)
            own[:, j] = self.difference(run, at, 1, j, free, residuals) if known is None else known
        return Columns(residuals, shared, own, by_state, self.longest_own)

    def _known_response(self, run: int, at, j: int, shared, by_state) -> np.ndarray | None:
        """Derivative by one of the run's own that follows from others, or None.

        A tracker's zero moves the measured states against the model's; friction of a run scales the
        campaign's coefficients.
        """
        free = self.own[j]
        if free.key in OFFSETS:
            rows = self._by_zero(run, free, by_state, shared.shape[0])
        elif free.key == FRICTION_OFFSET:
            places = [i for i, each in enumerate(self.shared) if each.key in SCATTERED]
            if len(places) < len(SCATTERED) or not all(shared[:, i].any() for i in places):
                return None
            rows = np.zeros(shared.shape[0])
            for i in places:
                each = self.shared[i]
                rows += shared[:, i] * each.value(at[0][i]) * free.step / each.step
        else:
            return None
        priors = [i for i, each in enumerate(self.own) if each.prior is not None]
        if free.prior is not None:  # what is known beforehand stands in the last rows
            local = len(at[2]) * sum(spread > 0.0 for spread in self.local)
            rows[rows.size - local - len(priors) + priors.index(j)] = free.step / free.prior
        return rows

    def _by_zero(self, run: int, free: FreeParameter, by_state, size: int) -> np.ndarray:
        axis, segmented = OFFSETS.index(free.key), self.segmented_runs[run]
        channel, rows = free.key.removeprefix("offset."), np.zeros(size)
        if channel in segmented.channels:
            rows[segmented.rows_of(channel)] = free.step / segmented.noise[channel]
        for (where, columns), segment in zip(by_state, segmented.segments, strict=True):
            if axis in segment.free:
                by_axis = columns[:, segment.free.index(axis)]
                rows[where] -= by_axis * free.step / STATE_STEP[axis]
        return rows

    def is_felt(self, run: int, free: FreeParameter) -> bool:
        """Whether a run's motion depends on a shared free parameter: other set-ups' do not."""
        if not free.key.startswith(STIFFNESS_OFFSET):
            return True
        return free.key == stiffness_offset(self.segmented_runs[run].setup)

    def difference(self, run, at, which, j, free: FreeParameter, residuals) -> np.ndarray:
        """(rows,) derivative of one run by number j of its point's part ``which``."""
        moved = [a.copy() for a in at]
        step = _PART if moved[which][j] + _PART <= free.scaled(free.high) else -_PART
        moved[which][j] += step
        return (self.residuals(run, *moved) - residuals) / step

    def _by_state(self, run, at, residuals):
        """Every segment's rows and derivatives; segments do not overlap, so one run tells all."""
        segmented = self.segmented_runs[run]
        owner = self._owner(run)
        by_axis = {}
        free = [self.free_axes(segment) for segment in segmented.segments]
        for axis in sorted({axis for axes in free for axis in axes}):
            states = at[2].copy()
            states[[axis in axes for axes in free], axis] += _PART * STATE_STEP[axis]
            by_axis[axis] = (self.residuals(run, at[0], at[1], states) - residuals) / _PART
        rows = [np.flatnonzero(owner == number) for number in range(len(segmented.segments))]
        return tuple(
            (r, np.column_stack([by_axis[axis][r] for axis in axes]))
            for r, axes in zip(rows, free, strict=True)
        )

    def tried(
        self, point: Point, step: np.ndarray, columns: Sequence[Columns]
    ) -> tuple[Point, tuple[np.ndarray, ...]]:
        """The point after a step of the shared free parameters, the runs following; residuals."""
        shared = self.inside(point.shared + step)
        own, states, residuals = [], [], []
        for i, c in enumerate(columns):
            own_step, state_steps = c.local_step(shared - point.shared)
            own.append(
                np.array(
                    [
                        free.inside(s)
                        for free, s in zip(self.own, point.own[i] + own_step, strict=True)
                    ]
                )
            )
            move = self._state_step(i, state_steps)
            limit = self._limit(i, c.residuals, alone=not step.any())
            best = self._follow(i, shared, own[i], point.states[i], move, limit)
            states.append(best[0])
            residuals.append(best[1])
        return Point(shared, tuple(own), tuple(states)), tuple(residuals)

    def _limit(self, run: int, before: np.ndarray, alone: bool) -> np.ndarray:
        """(segments,) sums of squares that a step may leave; no more than before if it is alone."""
        squares = self.by_segment(run, before)
        return squares if alone and not self.own else _GROWTH * squares + _GROWTH_SLACK

    def _follow(self, run, shared, own, states, move, limit):
        """States after their step, shortened in the segments that it would throw off course."""
        owner = self._owner(run)
        count = len(self.segmented_runs[run].segments)
        reach = np.ones(count)
        taken = states + move
        residuals = self.residuals(run, shared, own, taken)
        for shorter in (0.25, 0.0):
            costs = self.by_segment(run, residuals)
            if not (costs > limit).any():
                break
            reach[costs > limit] = shorter
            other = states + reach[:, None] * move
            tried = self.residuals(run, shared, own, other)
            better = self.by_segment(run, tried) < costs
            taken = np.where(better[:, None], other, taken)
            residuals = np.where(better[owner], tried, residuals)
        return taken, residuals

    def _state_step(self, run: int, steps: Sequence[np.ndarray]) -> np.ndarray:
        """(segments, 8) step of the states."""
        segments = self.segmented_runs[run].segments
        move = np.zeros((len(segments), STATES))
        for number, (segment, step) in enumerate(zip(segments, steps, strict=True)):
            axes = list(self.free_axes(segment))
            move[number, axes] = step * STATE_STEP[axes]
        return move

    def prior(self, shared: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Residuals and weights (1 per step) of what is known of the free parameters beforehand."""
        weight = np.array([free.step / free.prior if free.prior else 0.0 for free in self.shared])
        centre = np.array([free.scaled(free.start) for free in self.shared])
        return weight * (shared - centre), weight
