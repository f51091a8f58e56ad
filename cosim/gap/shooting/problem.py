"""Residuals of some runs as a function of the free parameters to turn and of the windows' states."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from stickslip.effects.candidate import OFFSETS, FreeParameter

from .columns import Columns
from .fitted import Point
from .flight import Flight

#: Differences are taken over this part of a free parameter's step.
_PART = 1e-2
#: Steps of the windows' states: positions m (and rad), velocities m/s (and rad/s).
_STATE_STEP = np.array([1e-4, 1e-4, 1e-3, 1e-3, 1e-3, 1e-2])
#: A window whose sum of squares grows by more than this was thrown off course by its own step.
_GROWTH, _GROWTH_SLACK = 1.5, 10.0


class Problem:
    """Some runs, the free parameters to turn and what else is set."""

    def __init__(
        self,
        flights: Sequence[Flight],
        free_parameters: Sequence[FreeParameter],
        settings: dict[str, float] | None = None,
    ):
        self.flights, self.free_parameters = tuple(flights), tuple(free_parameters)
        self.settings = dict(settings or {})
        self.shared = [
            free_parameter for free_parameter in free_parameters if not free_parameter.per_run
        ]
        self.own = [free_parameter for free_parameter in free_parameters if free_parameter.per_run]

    def residuals(self, run: int, shared, own, states) -> np.ndarray:
        """(rows,) of one run."""
        values, states, offsets = self._set_for(shared, own, states)
        flight = self.flights[run]
        rows = flight.residuals(flight.places(values, states), offsets)
        return np.concatenate([rows, self._known_of_own(own)])

    def flown(self, run: int, shared, own, states) -> tuple[np.ndarray, dict[str, float]]:
        """The model's outputs (n, O_SIZE) of one run, and the tracker's zeros."""
        values, states, offsets = self._set_for(shared, own, states)
        return self.flights[run].fly(values, states), offsets

    def _set_for(self, shared, own, states) -> tuple[dict[str, float], np.ndarray, dict]:
        """Parameters, windows' states (windows, 6) as the model has them, and tracker's zeros."""
        values = dict(self.settings)
        values.update((k.key, k.value(s)) for k, s in zip(self.shared, shared, strict=True))
        values.update((k.key, k.value(s)) for k, s in zip(self.own, own, strict=True))
        offsets = {key: values.pop(key) for key in OFFSETS if key in values}
        states = states.copy()
        for axis, key in enumerate(OFFSETS):  # states are measured ones: with the tracker's zero
            states[:, axis] -= offsets.get(key, 0.0)
        return values, states, offsets

    def _known_of_own(self, own) -> np.ndarray:
        """Rows for what is known beforehand of a run's own free parameters."""
        known = [(k, s) for k, s in zip(self.own, own, strict=True) if k.prior is not None]
        return np.array([(k.value(s) - k.start) / k.prior for k, s in known])

    def by_window(self, run: int, residuals: np.ndarray) -> np.ndarray:
        """(windows,) sums of squares of one run."""
        return np.bincount(self._owner(run), residuals**2, len(self.flights[run].windows))

    def misfit(self, run: int, residuals: np.ndarray) -> float:
        """Of one run, so that no window that was thrown off course outweighs the others."""
        squares = self.by_window(run, residuals)
        rows = np.maximum(self.by_window(run, np.ones_like(residuals)), 1.0)
        return float(np.sum(rows * np.log1p(squares / rows)))

    def _owner(self, run: int) -> np.ndarray:
        """(rows,) window of each row; what is known beforehand is put to the first."""
        own = sum(k.prior is not None for k in self.own)
        return np.concatenate([self.flights[run].window_of_rows(), np.zeros(own, dtype=int)])

    def all_residuals(self, point: Point) -> tuple[np.ndarray, ...]:
        """Of every run."""
        return tuple(
            self.residuals(i, point.shared, point.own[i], point.states[i])
            for i in range(len(self.flights))
        )

    def columns(self, run: int, point: Point, residuals: np.ndarray, free_shared) -> Columns:
        """Derivatives of one run by differences, its own part factorised."""
        at = point.shared, point.own[run], point.states[run]
        shared = np.zeros((residuals.size, len(self.shared)))
        for j in free_shared:
            shared[:, j] = self.difference(run, at, 0, j, self.shared[j], residuals)
        own = [self.difference(run, at, 1, j, k, residuals) for j, k in enumerate(self.own)]
        own = np.array(own).reshape(len(own), residuals.size).T
        return Columns(residuals, shared, own, self._by_state(run, at, residuals))

    def difference(self, run, at, which, j, free_parameter: FreeParameter, residuals) -> np.ndarray:
        """(rows,) derivative of one run by number j of its point's part ``which``."""
        moved = [a.copy() for a in at]
        step = (
            _PART
            if moved[which][j] + _PART <= free_parameter.scaled(free_parameter.high)
            else -_PART
        )
        moved[which][j] += step
        return (self.residuals(run, *moved) - residuals) / step

    def _by_state(self, run, at, residuals):
        """Every window's rows and derivatives; windows do not overlap, so one run tells all."""
        flight = self.flights[run]
        owner = self._owner(run)
        by_axis = {}
        for axis in sorted({axis for w in flight.windows for axis in w.free}):
            states = at[2].copy()
            states[[axis in w.free for w in flight.windows], axis] += _PART * _STATE_STEP[axis]
            by_axis[axis] = (self.residuals(run, at[0], at[1], states) - residuals) / _PART
        rows = [np.flatnonzero(owner == number) for number in range(len(flight.windows))]
        return tuple(
            (r, np.column_stack([by_axis[axis][r] for axis in window.free]))
            for r, window in zip(rows, flight.windows, strict=True)
        )

    def tried(
        self, point: Point, step: np.ndarray, columns: Sequence[Columns]
    ) -> tuple[Point, tuple[np.ndarray, ...]]:
        """The point after a step of the campaign's free parameters, the runs following, and its residuals."""
        shared = np.array(
            [k.inside(s) for k, s in zip(self.shared, point.shared + step, strict=True)]
        )
        own, states, residuals = [], [], []
        for i, c in enumerate(columns):
            own_step, state_steps = c.local_step(shared - point.shared)
            own.append(
                np.array(
                    [k.inside(s) for k, s in zip(self.own, point.own[i] + own_step, strict=True)]
                )
            )
            move = self._state_step(i, state_steps)
            limit = self._limit(i, c.residuals, alone=not step.any())
            best = self._follow(i, shared, own[i], point.states[i], move, limit)
            states.append(best[0])
            residuals.append(best[1])
        return Point(shared, tuple(own), tuple(states)), tuple(residuals)

    def _limit(self, run: int, before: np.ndarray, alone: bool) -> np.ndarray:
        """(windows,) sums of squares that a step may leave; no more than before if it is alone."""
        squares = self.by_window(run, before)
        return squares if alone and not self.own else _GROWTH * squares + _GROWTH_SLACK

    def _follow(self, run, shared, own, states, move, limit):
        """States after their step, shortened in the windows that it would throw off course."""
        owner = self._owner(run)
        count = len(self.flights[run].windows)
        reach = np.ones(count)
        taken = states + move
        residuals = self.residuals(run, shared, own, taken)
        for shorter in (0.25, 0.0):
            costs = self.by_window(run, residuals)
            if not (costs > limit).any():
                break
            reach[costs > limit] = shorter
            other = states + reach[:, None] * move
            tried = self.residuals(run, shared, own, other)
            better = self.by_window(run, tried) < costs
            taken = np.where(better[:, None], other, taken)
            residuals = np.where(better[owner], tried, residuals)
        return taken, residuals

    def _state_step(self, run: int, steps: Sequence[np.ndarray]) -> np.ndarray:
        """(windows, 6) step of the states."""
        windows = self.flights[run].windows
        move = np.zeros((len(windows), 6))
        for number, (window, step) in enumerate(zip(windows, steps, strict=True)):
            axes = list(window.free)
            move[number, axes] = step * _STATE_STEP[axes]
        return move

    def prior(self, shared: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Residuals and weights (1 per step) of what is known of the free parameters beforehand."""
        weight = np.array([k.step / k.prior if k.prior else 0.0 for k in self.shared])
        centre = np.array([k.scaled(k.start) for k in self.shared])
        return weight * (shared - centre), weight
