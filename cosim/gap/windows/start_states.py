"""The windows' start states: found by Gauss-Newton, and eliminated from a fit's derivatives.

Windows do not know of each other, so that all of a run are perturbed in one simulation. With the
derivatives D of a window's residuals r by its state, the best state for other values of the numbers
moves by -(D'D)^-1 D' (dr/dnumbers); what remains of dr/dnumbers, its part normal to the columns of
D, is the derivative of the fit with the states eliminated (variable projection in Kaufman's
approximation, BIT 15 (1975)).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from .run_model import BREAK_AWAY, RunModel

#: Friction across, in parts of that along x.
ACROSS = "lateral_friction.ratio"
#: Finite differences of a state, in units of the noise (velocities: noise times omega).
STEP = 1e-3
#: The same of a stick's own friction: 1e-5 of some cm are tenths of a micrometre.
FRICTION_STEP = 1e-5
#: Part of the normal matrix's diagonal that is added, so that what the motion hardly feels stays.
LEVEL = 1e-6
#: Standard deviations that what the tracker does not have may be off by: with a model that is lost
#: a step would turn the block round, to where no step leads back from.
FURTHEST = 5.0
#: A window's step is taken whole, or these parts of it, whichever first lowers the misfit.
SHORTER = (1.0, 0.2)
#: Rounds of Gauss-Newton, and the relative gain below which they end.
ROUNDS, GAIN = 6, 1e-3
#: Changes of x, in units of the noise, and of vx, in parts of the surface's velocity, with which a
#: window that is off course sets out again: whether the block sticks at once or in the next cycle
#: hangs on them, and small ones do not show it.
CHANGES = ((0.0, -1.0), (0.0, -0.3), (0.0, -0.05), (0.0, 0.05), (0.0, 0.3), (-2.0, 0.0), (2.0, 0.0))
#: At first, when the numbers are off as well, a window is off course whose mean square exceeds the
#: run's median window's, and the noise's, by this factor; at last, when any may be in which the
#: block barely sticks, one whose mean square exceeds that of the noise by the second.
OFF_COURSE, AT_LAST = 4.0, 1.2


@dataclass(frozen=True)
class Started:
    """A run's start states and what they lead to: states (w, 6 + sticks), residuals (rows,)."""

    states: np.ndarray
    residuals: np.ndarray


class StartStates:
    """The start states of one run under changing values of the numbers."""

    def __init__(self, model: RunModel):
        self.model = model
        windows, run = model.windows, model.run
        guided = 1.0 - np.array([1.0, model.known["rig.free_y"], model.known["rig.free_phi"]])
        free = windows.free & (np.tile(guided, 2) == 0.0)
        sticks = np.zeros((len(free), int(model.sticks[1].max()) - 5), dtype=bool)
        self.of_block = np.hstack([free, sticks])
        self.with_sticks = self.of_block.copy()
        self.with_sticks[model.sticks] = True
        self.with_sticks[: windows.led_in] = False
        noise = run.noise["x"]
        turn = run.noise.get("phi", noise / model.known["rig.contact_radius"])
        places = np.array([noise, run.noise.get("y", noise), turn])
        own = np.full(sticks.shape[1], FRICTION_STEP)
        self.steps = np.concatenate([STEP * places, STEP * places * run.natural_frequency, own])

    def axes(self, values: Mapping[str, float]) -> np.ndarray:
        """(a,) which parts of a state are free in any window."""
        return np.flatnonzero(self.free(values).any(axis=0))

    def free(self, values: Mapping[str, float]) -> np.ndarray:
        """(w, 6 + sticks) whether each is. A block that friction holds across, too, moves with the
        surface where a window starts in a stick."""
        free = self.with_sticks if values.get(BREAK_AWAY, 0.0) > 0.0 else self.of_block
        if values.get(ACROSS, self.model.known[ACROSS]) > 0.0:
            free = free.copy()
            free[np.isfinite(self.model.windows.hold_since), 3:6] = False
        return free

    def derivatives(self, values: Mapping[str, float], at: Started, p: np.ndarray) -> np.ndarray:
        """(size, a) of the residuals by the free axes, per step; 0 where a window's is not free."""
        axes, free = self.axes(values), self.free(values)

        def column(axis: int) -> np.ndarray:
            moved = at.states.copy()
            moved[free[:, axis], axis] += self.steps[axis]
            return np.asarray(self.model.residuals(values, moved, p) - at.residuals)

        columns = np.column_stack([at.residuals[:, None][:, :0], *map(column, axes)])
        # windows without this axis feel nothing but what the model carried over from others
        return np.asarray(columns * free[:, axes][self.model.owner])

    def coordinates(self, columns: np.ndarray, rows: np.ndarray) -> np.ndarray:
        """(w, a, m) least-squares coordinates of rows (size, m) along each window's columns."""
        normal = self.model.per_window(columns[:, :, None] * columns[:, None, :])
        right = self.model.per_window(columns[:, :, None] * rows[:, None, :])
        diagonal = np.einsum("waa->wa", normal)
        diagonal += LEVEL * diagonal + (diagonal == 0.0)
        return np.linalg.solve(normal, right)

    def normal_part(self, columns: np.ndarray, rows: np.ndarray) -> np.ndarray:
        """(size, m) what of rows the windows' states cannot take up."""
        along = self.coordinates(columns, rows)[self.model.owner]
        return np.asarray(rows - np.einsum("ra,ram->rm", columns, along))

    def stepped(
        self, values: Mapping[str, float], at: Started, columns: np.ndarray, p: np.ndarray
    ) -> Started:
        """One Gauss-Newton step with these derivatives; of no window to a larger misfit."""
        axes, unseen = self.axes(values), self.model.unseen
        most = FURTHEST * self.model.unseen_sd
        move = self.coordinates(columns, at.residuals[:, None])[:, :, 0]
        for part in SHORTER:
            states = at.states.copy()
            states[:, axes] -= part * move * self.steps[axes]
            states[unseen] = np.clip(states[unseen], -most, most)
            tried = Started(states, self.model.residuals(values, states, p))
            worse = self.squares(tried) > self.squares(at)
            at, move = self.better(at, tried), move * worse[:, None]
            if not worse.any():
                break
        return at

    def settled(
        self, values: Mapping[str, float], at: Started, p: np.ndarray, rounds: int = ROUNDS,
        columns: np.ndarray | None = None,
    ) -> Started:  # fmt: skip
        """The best states nearby. columns : derivatives there, where they are known"""
        for _ in range(rounds):
            before = at
            here = self.derivatives(values, at, p) if columns is None else columns
            at, columns = self.stepped(values, at, here, p), None
            if self.gain(before, at) < GAIN:
                break
        return at

    def gain(self, before: Started, after: Started) -> float:
        """Of the sum of squares, relative."""
        return 1.0 - float(np.sum(after.residuals**2) / max(np.sum(before.residuals**2), 1e-300))

    def started(self, values: Mapping[str, float], states: np.ndarray, p: np.ndarray) -> Started:
        """States and their residuals."""
        return Started(states, self.model.residuals(values, states, p))

    def read_off(self, values: Mapping[str, float]) -> np.ndarray:
        """(w, 6 + sticks) of the block, from the data."""
        states = np.zeros(self.of_block.shape)
        states[:, :6] = self.model.windows.states
        states[:, :3] -= self.model.zero(values)
        return states

    def found(
        self, values: Mapping[str, float], p: np.ndarray, near: np.ndarray | None = None
    ) -> Started:
        """The best states from those read off the data, or from those of a model nearby."""
        at = self.started(values, self.read_off(values), p)
        if near is not None:
            there = np.where(self.free(values), near, at.states)
            at = self.better(at, self.started(values, there, p))
        return self.retried(values, self.settled(values, at, p), p, at_last=False)

    def retried(
        self, values: Mapping[str, float], at: Started, p: np.ndarray, at_last: bool = True
    ) -> Started:
        """Windows off course set out from a few other velocities; the very same if none gains."""
        mean = self.squares(at) / np.maximum(
            self.model.per_window(np.ones(self.model.owner.size)), 1.0
        )
        limit = AT_LAST if at_last else OFF_COURSE * max(float(np.median(mean)), 1.0)
        lost = (mean > limit) & self.of_block[:, 3]
        best = at
        scales = np.array([self.model.run.noise["x"], self.model.run.surface_speed])
        for change in CHANGES if lost.any() else ():
            states = at.states.copy()
            states[np.ix_(lost, [0, 3])] += change * scales
            tried = self.started(values, states, p)
            best = self.better(best, self.settled(values, tried, p, rounds=1))
        return best

    def squares(self, at: Started) -> np.ndarray:
        """(w,) sums of squares."""
        return self.model.per_window(at.residuals**2)

    def better(self, one: Started, other: Started) -> Started:
        """Of each window the better of two; the very same where the other is nowhere better."""
        better = self.squares(other) < self.squares(one)
        if not better.any():
            return one
        return Started(
            np.where(better[:, None], other.states, one.states),
            np.where(better[self.model.owner], other.residuals, one.residuals),
        )
