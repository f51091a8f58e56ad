"""One run of a fit: its start states and derivatives as the numbers change."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from .fitted import FittedRun
from .numbers import Unknown
from .run_model import RunModel
from .start_states import Started, StartStates

#: Finite differences of a number, in its scales. Numbers that compensate each other but for their
#: priors (mu_s, mu_k and all zeros) need derivatives to 1e-3 of themselves; with ten times the step
#: the curvature of the motion seems to tell them apart, with a tenth the integrator's error does.
STEP = 1e-3
#: A change of the parameters lies along others where they leave this part of it: rounding.
ALONG = 1e-6
#: What the tracker reads more: no number of the block's.
ZEROS = ("offset.x", "offset.y")
#: A window whose misfit grows by this factor, and by this, in a step has lost its course.
LOST, LOST_SQUARES = 2.0, 10.0
#: States found elsewhere are better if a run's sum of squares falls by this part.
LEADS_ON = 1e-3


class RunFit:
    """One run of a problem, with the start states that belong to the last derivatives."""

    def __init__(
        self, model: RunModel, unknowns: Sequence[Unknown], felt: Sequence[int],
        settings: Mapping[str, float], near: np.ndarray | None = None,
    ):  # fmt: skip
        """near : start states of a model nearby."""
        self.model, self.starts = model, StartStates(model)
        self.unknowns, self.felt, self.settings = unknowns, list(felt), settings
        self.near = near
        self.tried: dict[bytes, Started] = {}
        #: id of start states -> these, and their derivatives: simulated once in a fit
        self.known: dict[int, tuple[Started, np.ndarray, np.ndarray, np.ndarray]] = {}
        self.base: np.ndarray | None = None  # where the following were taken
        self.columns: np.ndarray | None = None
        self.response = np.empty(0)

    def values(
        self, scaled: np.ndarray, more: Mapping[str, float] | None = None
    ) -> dict[str, float]:
        """key -> value of this run. more : labels -> values of what is no number of the fit"""
        own = {self.unknowns[i].label: self.unknowns[i].number.value(scaled[i]) for i in self.felt}
        return self.model.values({**self.settings, **(more or {}), **own})

    def forget(self, scaled: np.ndarray | None = None, started: Started | None = None) -> None:
        """All states, but those of one point if given, from which others then follow."""
        self.base, self.tried, self.columns = None, {}, None
        if scaled is not None and started is not None:
            self.base = scaled[self.felt].copy()
            self.tried[self.base.tobytes()] = started

    def followed(self, scaled: np.ndarray) -> Started:
        """The start states that belong to other numbers; the same for the same numbers."""
        key = scaled[self.felt].tobytes()
        if key not in self.tried:
            self.tried[key] = self._followed(scaled)
        return self.tried[key]

    def _followed(self, scaled: np.ndarray) -> Started:
        values = self.values(scaled)
        p = self.model.packed(values)
        if self.base is None:
            return self.starts.found(values, p, self.near)
        base = self.tried[self.base.tobytes()]
        if self.columns is None:
            return self.starts.settled(values, self.starts.started(values, base.states, p), p)
        moved = base.states.copy()
        moved[:, self.starts.axes(values)] += self.response @ (scaled[self.felt] - self.base)
        at = self.starts.started(values, moved, p)
        limit = LOST * self.starts.squares(base) + LOST_SQUARES
        if (self.starts.squares(at) > limit).any():
            at = self.starts.better(at, self.starts.started(values, base.states, p))
        at = self.starts.stepped(values, at, self.columns, p)
        if (self.starts.squares(at) > limit).any():
            at = self.starts.settled(values, at, p, rounds=2)
        return at

    def derivatives(self, scaled: np.ndarray) -> np.ndarray:
        """(size, k) by the numbers, normal to those by the start states."""
        at = self.followed(scaled)
        if id(at) not in self.known:
            self.known[id(at)] = (at, *self._derivatives(scaled, at))
        _, self.columns, self.response, derivatives = self.known[id(at)]
        if self.base is None or (self.base != scaled[self.felt]).any():
            self.base = scaled[self.felt].copy()
            self.tried = {self.base.tobytes(): at}
        return derivatives

    def _derivatives(
        self, scaled: np.ndarray, at: Started
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """By the start states, of these by the numbers, and of the rest by the numbers."""
        values = self.values(scaled)
        p = self.model.packed(values)
        columns = self.starts.derivatives(values, at, p)
        slopes = self._slopes(scaled, at, self.model.taken_from(values, p))
        move = self.starts.coordinates(columns, slopes)
        steps = self.starts.steps[self.starts.axes(values)]
        derivatives = np.zeros((at.residuals.size, len(self.unknowns)))
        derivatives[:, self.felt] = self.starts.normal_part(columns, slopes)
        return columns, -move * steps[None, :, None], derivatives

    def _slopes(self, scaled: np.ndarray, at: Started, taken: np.ndarray) -> np.ndarray:
        """(size, felt) by the numbers, at fixed start states; taken : `RunModel.taken_from` here.

        Where numbers move the kernel's parameters in the same directions, as mu_s and mu_k do both
        coefficients together, so many are simulated as there are directions.
        """
        moved, steps = [], []
        for i in self.felt:
            number, there = self.unknowns[i].number, scaled.copy()
            steps.append(STEP if number.value(scaled[i] + STEP) <= number.high else -STEP)
            there[i] += steps[-1]
            moved.append(self.values(there))
        packed = list(map(self.model.packed, moved))
        changes = np.array(list(map(self.model.taken_from, moved, packed))) - taken
        basis, parts = _directions(changes.T / steps)
        simulated = [
            (self.model.residuals(moved[n], at.states, packed[n]) - at.residuals) / steps[n]
            for n in basis
        ]
        slopes = np.asarray(np.column_stack([at.residuals[:, None][:, :0], *simulated]) @ parts)
        for place, i in enumerate(self.felt):
            number = self.unknowns[i].number
            if number.key in ZEROS:
                seen = self.model.axes == ZEROS.index(number.key)
                of_zero = np.where(seen, number.slope(scaled[i]) / self.model.noise, 0.0)
                slopes[: seen.size, place] = of_zero
        return slopes

    def changes(self, scaled: np.ndarray, more: Mapping[str, float]) -> np.ndarray:
        """(size,) of the residuals by other values, normal to their derivatives by start states."""
        at = self.followed(scaled)
        moved = self.model.residuals(self.values(scaled, more), at.states) - at.residuals
        columns = self.known[id(at)][1]
        return np.asarray(self.starts.normal_part(columns, moved[:, None])[:, 0])

    def retried(self, scaled: np.ndarray) -> bool:
        """Whether windows off course have found better states, which are then kept."""
        at, values = self.followed(scaled), self.values(scaled)
        p = self.model.packed(values)
        columns = self.known[id(at)][1] if id(at) in self.known else None
        other = self.starts.retried(values, self.starts.settled(values, at, p, columns=columns), p)
        self.forget(scaled, other)
        return self.starts.gain(at, other) > LEADS_ON

    def described(self, scaled: np.ndarray) -> FittedRun:
        """The run as the fit left it."""
        at, values, size = self.followed(scaled), self.values(scaled), self.model.size
        return FittedRun(
            self.model.run.name, values, self.model.track(values, at.states), at.states,
            at.residuals[:size], self.model.owner[:size], self.model.run.hold_out,
            self.model.rows, self.model.axes, self.model.rounding,
        )  # fmt: skip


def _directions(changes: np.ndarray) -> tuple[list[int], np.ndarray]:
    """Columns of (n, k) in directions of their own, and (basis, k) what each column has of them."""
    sizes = np.linalg.norm(changes, axis=0)
    unit = changes / np.where(sizes > 0.0, sizes, 1.0)
    basis: list[int] = []
    for number in np.flatnonzero(sizes):
        along = np.linalg.lstsq(unit[:, basis], unit[:, number], rcond=None)[0]
        if np.linalg.norm(unit[:, number] - unit[:, basis] @ along) > ALONG:
            basis.append(int(number))
    parts = np.linalg.lstsq(unit[:, basis], unit, rcond=None)[0]
    return basis, parts * sizes / sizes[basis, None]
