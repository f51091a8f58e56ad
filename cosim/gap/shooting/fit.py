"""Least squares over parameters, with the windows' states and the runs' phases eliminated.

Levenberg-Marquardt on the parameters of the campaign. What belongs to one run alone is linear
enough near its guess: its part of every step follows from the rest by a QR factorisation of that
run's own columns (variable projection, Golub & Pereyra 1973).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from .flight import Flight
from .knob import OFFSETS, Knob

#: Differences are taken over this part of a knob's step.
_PART = 1e-2
#: Steps of the windows' states: positions m (and rad), velocities m/s (and rad/s).
_STATE_STEP = np.array([1e-4, 1e-4, 1e-3, 1e-3, 1e-3, 1e-2])
#: Converged when a step lowers the sum of squares by less than this, and than this part of what it
#: is above that of noise: a model that does not fit need not do so to the last digit.
_ENOUGH, _PART_OF_EXCESS = 0.02, 1e-3
MOST_ROUNDS = 25
#: Steps tried in a round, each eight times as damped as the one before.
MOST_TRIES = 12
#: Most further steps by the derivatives of a round.
_CHORDS = 2
#: Longest step of a round, in steps of a knob: a parameter that is thrown to where the motion does
#: not feel it any more never comes back.
_LONGEST = 4.0
#: Steps of a window's state that are as unlikely as a residual of one.
_FAR = 50.0
#: A window whose sum of squares grows by more than this was thrown off course by its own step.
_GROWTH, _GROWTH_SLACK = 1.5, 10.0


@dataclass(frozen=True)
class Point:
    """Where a fit stands.

    Attributes
    ----------
    shared : (g,) knobs of the campaign, scaled
    own : per run (k,) knobs of the run, scaled
    states : per run (windows, 6)
    """

    shared: np.ndarray
    own: tuple[np.ndarray, ...]
    states: tuple[np.ndarray, ...]


@dataclass(frozen=True)
class Columns:
    """Derivatives of one run's residuals.

    Attributes
    ----------
    residuals : (r,) where they were taken
    shared : (r, g) by the campaign's knobs
    own : (r, k) by the run's own knobs
    states : of each window: rows, derivatives (rows, free) by the free numbers of its state
    """

    residuals: np.ndarray
    shared: np.ndarray
    own: np.ndarray
    states: tuple[tuple[np.ndarray, np.ndarray], ...]

    @cached_property
    def _bases(self) -> tuple[np.ndarray, ...]:
        return tuple(np.linalg.qr(columns)[0] for _, columns in self.states)

    @cached_property
    def _own_left(self) -> np.ndarray:
        return self._without_states(self.own)

    def _without_states(self, a: np.ndarray) -> np.ndarray:
        rest = a.copy()
        for (rows, _), basis in zip(self.states, self._bases, strict=True):
            rest[rows] -= basis @ (basis.T @ a[rows])
        return rest

    def left(self, a: np.ndarray) -> np.ndarray:
        """What of (r, ...) the run's own knobs and states cannot take up."""
        rest = self._without_states(a)
        if self.own.shape[1]:
            rest = rest - self._own_left @ (np.linalg.pinv(self._own_left) @ rest)
        return rest

    def local_step(self, shared: np.ndarray) -> tuple[np.ndarray, list[np.ndarray]]:
        """Own knobs' step (k,) and each window's, that go best with a step of the shared ones."""
        rest = self.residuals + self.shared @ shared
        own = np.zeros(0)
        if self.own.shape[1]:
            own = -np.linalg.pinv(self._own_left) @ self._without_states(rest)
            rest = rest + self.own @ own
        steps = [_damped(columns, rest[rows]) for rows, columns in self.states]
        return own, steps


def _damped(columns: np.ndarray, rest: np.ndarray) -> np.ndarray:
    """Step of a window's state; in what the motion hardly feels it stays short."""
    square = columns.T @ columns + np.eye(columns.shape[1]) / _FAR**2
    return -np.linalg.solve(square, columns.T @ rest)


@dataclass(frozen=True)
class Fitted:
    """A fit.

    Attributes
    ----------
    knobs : what was turned
    point : where it ended
    residuals : per run (rows,) in units of the noise
    columns : per run, derivatives at the end (None unless asked for)
    """

    knobs: tuple[Knob, ...]
    point: Point
    residuals: tuple[np.ndarray, ...]
    columns: tuple[Columns, ...] | None = None

    @property
    def values(self) -> dict[str, float]:
        """Fitted parameters of the campaign."""
        return _named(self.knobs, self.point.shared, per_run=False)

    def own_values(self, run: int) -> dict[str, float]:
        """Fitted parameters of one run."""
        return _named(self.knobs, self.point.own[run], per_run=True)

    @property
    def cost(self) -> float:
        """Sum of squares."""
        return float(sum(r @ r for r in self.residuals))

    def gap(self, runs: Sequence[int] | None = None) -> float:
        """Root mean square residual in units of the noise."""
        chosen = self.residuals if runs is None else [self.residuals[i] for i in runs]
        return float(np.sqrt(sum(r @ r for r in chosen) / max(1, sum(r.size for r in chosen))))


#: Of a run, at a point, with its residuals there.
Derivatives = Callable[[int, Point, np.ndarray], Columns]


def _named(knobs: Sequence[Knob], scaled: np.ndarray, per_run: bool) -> dict[str, float]:
    chosen = [knob for knob in knobs if knob.per_run == per_run]
    return {knob.key: knob.value(s) for knob, s in zip(chosen, scaled, strict=True)}


def start(flights: Sequence[Flight], knobs: Sequence[Knob]) -> Point:
    """All knobs at their starts, all windows at the states read off the data."""
    shared = np.array([k.scaled(k.start) for k in knobs if not k.per_run])
    own = np.array([k.scaled(k.start) for k in knobs if k.per_run])
    return Point(shared, tuple(own.copy() for _ in flights), tuple(f.starts for f in flights))


class Problem:
    """Some runs, the knobs to turn and what else is set."""

    def __init__(self, flights: Sequence[Flight], knobs: Sequence[Knob],
                 settings: dict[str, float] | None = None):
        self.flights, self.knobs = tuple(flights), tuple(knobs)
        self.settings = dict(settings or {})
        self.shared = [knob for knob in knobs if not knob.per_run]
        self.own = [knob for knob in knobs if knob.per_run]

    def residuals(self, run: int, shared, own, states) -> np.ndarray:
        """(rows,) of one run."""
        values = dict(self.settings)
        values.update((k.key, k.value(s)) for k, s in zip(self.shared, shared, strict=True))
        values.update((k.key, k.value(s)) for k, s in zip(self.own, own, strict=True))
        offsets = {key: values.pop(key) for key in OFFSETS if key in values}
        flight = self.flights[run]
        states = states.copy()
        for axis, key in enumerate(OFFSETS):  # states are measured ones: with the tracker's zero
            states[:, axis] -= offsets.get(key, 0.0)
        rows = flight.residuals(flight.fly(values, states), offsets)
        return np.concatenate([rows, self._known_of_own(own)])

    def _known_of_own(self, own) -> np.ndarray:
        """Rows for what is known beforehand of a run's own knobs."""
        known = [(k, s) for k, s in zip(self.own, own, strict=True) if k.prior is not None]
        return np.array([(k.value(s) - k.start) / k.prior for k, s in known])

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

    def difference(self, run, at, which, j, knob: Knob, residuals) -> np.ndarray:
        """(rows,) derivative of one run by number j of its point's part ``which``."""
        moved = [a.copy() for a in at]
        step = _PART if moved[which][j] + _PART <= knob.scaled(knob.high) else -_PART
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
        """The point after a step of the campaign's knobs, the runs following, and its residuals."""
        shared = np.array([
            k.inside(s) for k, s in zip(self.shared, point.shared + step, strict=True)])
        own, states, residuals = [], [], []
        for i, c in enumerate(columns):
            own_step, state_steps = c.local_step(shared - point.shared)
            own.append(np.array([k.inside(s) for k, s in zip(
                self.own, point.own[i] + own_step, strict=True)]))
            move = self._state_step(i, state_steps)
            limit = self._limit(i, c.residuals, alone=not step.any())
            best = self._follow(i, shared, own[i], point.states[i], move, limit)
            states.append(best[0])
            residuals.append(best[1])
        return Point(shared, tuple(own), tuple(states)), tuple(residuals)

    def _limit(self, run: int, before: np.ndarray, alone: bool) -> np.ndarray:
        """(windows,) sums of squares that a step may leave; no more than before if it is alone."""
        squares = np.bincount(self._owner(run), before**2, len(self.flights[run].windows))
        return squares if alone and not self.own else _GROWTH * squares + _GROWTH_SLACK

    def _follow(self, run, shared, own, states, move, limit):
        """States after their step, shortened in the windows that it would throw off course."""
        owner = self._owner(run)
        count = len(self.flights[run].windows)
        reach = np.ones(count)
        taken = states + move
        residuals = self.residuals(run, shared, own, taken)
        for shorter in (0.25, 0.0):
            costs = np.bincount(owner, residuals**2, count)
            if not (costs > limit).any():
                break
            reach[costs > limit] = shorter
            other = states + reach[:, None] * move
            tried = self.residuals(run, shared, own, other)
            better = np.bincount(owner, tried**2, count) < costs
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
        """Residuals and weights (1 per step) of what is known of the knobs beforehand."""
        weight = np.array([k.step / k.prior if k.prior else 0.0 for k in self.shared])
        centre = np.array([k.scaled(k.start) for k in self.shared])
        return weight * (shared - centre), weight


def fit(
    problem: Problem, point: Point, rounds: int = MOST_ROUNDS, fixed: bool = False,
    derivatives: Derivatives | None = None, tries: int = MOST_TRIES,
) -> Fitted:
    """The best point from a first one.

    fixed : only what belongs to the runs moves; derivatives : others than the model's own there;
    tries : steps in a round until one leads on
    """
    way = _Descent(problem, point, fixed)
    for _ in range(rounds):
        columns = way.columns() if derivatives is None else [
            derivatives(i, way.point, r) for i, r in enumerate(way.residuals)]
        if not way.gains(columns, tries):
            break
        # derivatives are most of the work, and do for another step or two (Shamanskii 1967)
        for _ in range(_CHORDS):
            again = [replace(c, residuals=r) for c, r in zip(columns, way.residuals, strict=True)]
            if fixed or derivatives or not way.gains(again, 1):
                break
    return Fitted(problem.knobs, way.point, way.residuals)


class _Descent:
    """A fit on its way: where it stands, what it costs, how damped its steps are."""

    def __init__(self, problem: Problem, point: Point, fixed: bool):
        self.problem, self.point, self.fixed = problem, point, fixed
        self.residuals = problem.all_residuals(point)
        self.cost, self.damping = _cost(problem, point, self.residuals), 1e-3

    def columns(self) -> list[Columns]:
        """Derivatives of every run where it stands."""
        free = [] if self.fixed else range(len(self.problem.shared))
        return [self.problem.columns(i, self.point, r, free) for i, r in enumerate(self.residuals)]

    def gains(self, columns: Sequence[Columns], tries: int) -> bool:
        """Take the first of so many steps, ever shorter, that leads down: whether by enough."""
        damping = self.damping
        for _ in range(1 if self.fixed else tries):
            step = np.zeros(len(self.problem.shared))
            if not self.fixed:
                step = _step(self.problem, self.point, columns, damping)
            point, residuals = self.problem.tried(self.point, step, columns)
            cost = _cost(self.problem, point, residuals)
            if cost < self.cost:
                excess = cost - sum(r.size for r in residuals)
                enough = self.cost - cost > max(_ENOUGH, _PART_OF_EXCESS * excess)
                self.point, self.residuals, self.cost = point, residuals, cost
                self.damping = max(0.2 * damping, 1e-9)
                return enough
            damping *= 8.0
        return False


def _cost(problem: Problem, point: Point, residuals) -> float:
    known = problem.prior(point.shared)[0]
    return float(sum(r @ r for r in residuals) + known @ known)


def _step(problem: Problem, point: Point, columns: Sequence[Columns], damping: float):
    """Of the campaign's knobs: normal equations of what the runs' own columns leave."""
    known, weight = problem.prior(point.shared)
    matrix, right = np.diag(weight**2), -weight * known
    for c in columns:
        left = c.left(c.shared)
        matrix = matrix + left.T @ left
        right = right - left.T @ c.residuals
    diagonal = np.diag(matrix)
    matrix = matrix + damping * np.diag(diagonal + 1e-12 * diagonal.max(initial=0.0) + 1e-300)
    step = _inside(problem, point.shared, matrix, right)
    return step * min(1.0, _LONGEST / max(np.abs(step).max(initial=0.0), 1e-300))


def _inside(problem: Problem, shared: np.ndarray, matrix: np.ndarray, right: np.ndarray):
    """Solution of the normal equations; a knob that would leave its range by it stays at its end.

    The others then make the best of it, which a step cut off afterwards would not.
    """
    step, free = np.zeros(right.size), np.ones(right.size, dtype=bool)
    while free.any():
        held = matrix[np.ix_(free, ~free)] @ step[~free]
        step[free] = np.linalg.lstsq(matrix[np.ix_(free, free)], right[free] - held, rcond=None)[0]
        reach = np.array([knob.inside(s) for knob, s in zip(
            problem.shared, shared + step, strict=True)]) - shared
        out = free & (np.abs(reach - step) > 1e-12 * (1.0 + np.abs(step)))
        if not out.any():
            break
        step[out] = reach[out]
        free &= ~out
    return step


def with_columns(problem: Problem, fitted: Fitted) -> Fitted:
    """The same fit with derivatives taken at its end."""
    columns = tuple(
        problem.columns(i, fitted.point, r, range(len(problem.shared)))
        for i, r in enumerate(fitted.residuals)
    )
    return replace(fitted, columns=columns)
