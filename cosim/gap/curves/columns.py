"""Columns of a mixed model for a free curve: over stretches, over the sliding speed, as a force."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace

import numpy as np
from stickslip.effects.candidate import Candidate
from stickslip.kernel import layout
from stickslip.packing import GRAVITY
from stickslip.restarted import Force

from cosim.gap.data import MeasuredRun
from cosim.gap.estimation.drive import driven_speed, parts_at, table
from cosim.gap.estimation.problem import STATE_STEP, Problem
from cosim.gap.estimation.segmented_run import SegmentedRun
from cosim.gap.estimation.segments import FRICTION, STATES
from cosim.gap.evidence.mixed import MixedModel, RunProducts
from cosim.gap.evidence.products import mixed_model
from cosim.gap.evidence.settled import Settled
from cosim.processes import Map

from .axes import Stretches
from .spline import Spline
from .vote import Columns

#: What of a stretch's friction a curve moves: logarithms of both, of mu_s beside them.
ON = {"mu_k": (1.0, -1.0), "mu_s": (0.0, 1.0), "both": (1.0, 0.0)}
#: Part of friction over which responses are taken: felt, and small enough to be linear.
_FELT = 0.01
#: Axes of a force on the block, and where the model's outputs have them.
FORCES = {"position": layout.O_X, "velocity": layout.O_VX, "sliding speed": layout.O_SLIDING_SPEED}
#: Places at which a force is tabulated over its axis, which the block looks up.
_LOOKED_UP = 400


def of_stretches(base: Settled, along: Stretches, on: str) -> Columns | None:
    """Friction that goes with where a stretch stands on an axis; None where all stand alike."""
    spline = along.spline
    if spline is None:
        return None
    direction = np.zeros(STATES)
    direction[list(FRICTION)] = np.array(ON[on]) / STATE_STEP[list(FRICTION)]
    runs = [
        _with_columns(run, direction[:, None] * spline.columns(values)[:, None, :])
        for run, values in zip(base.mixed.runs, along.values, strict=True)
    ]
    mixed = MixedModel(runs, base.mixed.shared, [along.axis] * spline.size)
    return Columns(along.axis, on, mixed, spline, memory=along.memory, per=along.per)


def _with_columns(run: RunProducts, by_state: np.ndarray) -> RunProducts:
    """With columns (segments, m, k) of the segments' states, before e0."""
    count, size, more = len(run.grams), run.grams.shape[-1], by_state.shape[-1]
    change = np.zeros((count, size, size + more))
    change[:, range(size - 1), range(size - 1)] = 1.0
    change[:, : by_state.shape[1], size - 1 : -1] = by_state
    change[:, -1, -1] = 1.0
    return replace(run, grams=np.swapaxes(change, 1, 2) @ run.grams @ change)


def of_sliding_speed(
    base: Settled, runs: Sequence[MeasuredRun], outputs: Sequence[np.ndarray], mapped: Map
) -> Columns:
    """mu_k that goes with the sliding speed within a slip, by the kernel's table.

    On top of the table that the base has, if it has one.
    """
    fastest = max(float(np.nanmax(out[:, layout.O_SLIDING_SPEED])) for out in outputs)
    spline = Spline(0.0, fastest, "root")
    speeds = spline.grid(layout.CURVE_LIMIT)
    parts = parts_at(base.model.settings, speeds)
    laws = [
        Candidate("friction", f"table {n}", (), table(speeds, parts * (1.0 + _FELT * bump)))
        for n, bump in enumerate(spline.columns(speeds).T)
    ]
    held_out = [run.hold_out for run in runs]
    mixed = mixed_model(base.problem, base.fitted, laws, held_out, mapped)
    return Columns("sliding speed", "mu_k", mixed, spline, _FELT)


def of_force(
    base: Settled,
    runs: Sequence[MeasuredRun],
    outputs: Sequence[np.ndarray],
    axis: str,
    mapped: Map,
) -> Columns:
    """A force along x that goes with position or velocity, or against sliding with its speed.

    That of sliding is no friction coefficient: the same whatever the load.
    """
    values = np.concatenate([out[:, FORCES[axis]] for out in outputs])
    slides = axis == "sliding speed"
    low = 0.0 if slides else float(values.min())
    spline = Spline(low, float(values.max()), "root" if slides else "")
    load = float(np.mean([run.mass for run in runs])) * GRAVITY
    friction = base.fitted.values["friction.mu_k"] * load
    unit = _FELT * friction
    columns = spline.columns(np.linspace(spline.low, spline.high, _LOOKED_UP))
    tables = (unit * columns).T.tolist()
    pushed = [_pushed(run, axis, spline, tables) for run in base.problem.segmented_runs]
    problem = Problem(
        pushed, base.problem.free_parameters, base.problem.settings, base.problem.local
    )
    laws = [Candidate("force", str(n), (), {_CHOSEN: float(n)}) for n in range(spline.size)]
    held_out = [run.hold_out for run in runs]
    mixed = mixed_model(problem, base.fitted, laws, held_out, mapped)
    return Columns(axis, "force", mixed, spline, unit, friction)


#: Which of a run's forces acts on it.
_CHOSEN = "curve.number"


@dataclass(frozen=True)
class PushedRun(SegmentedRun):
    """A run on whose block a tabulated force acts along x.

    axis : of FORCES; low, high : of the tables, each of even steps, N
    """

    axis: str = "position"
    low: float = 0.0
    high: float = 1.0
    tables: Sequence[Sequence[float]] = ()

    def force(self, values: Mapping[str, float]) -> Force | None:
        """The one that is chosen; none for none."""
        if _CHOSEN not in values:
            return None
        table = self.tables[int(values[_CHOSEN])]
        low, last = self.low, len(table) - 1
        per_unit = last / (self.high - self.low)

        def at(value: float) -> float:
            place = min(max((value - low) * per_unit, 0.0), float(last))
            left = min(int(place), last - 1)
            return table[left] + (place - left) * (table[left + 1] - table[left])

        if self.axis == "position":
            return lambda block: at(block[layout.X])
        if self.axis == "velocity":
            return lambda block: at(block[layout.VX])
        surface = driven_speed(self.speed, values)

        def with_sliding(block: Sequence[float]) -> float:
            if block[layout.MODE] == layout.STICK:
                return 0.0
            sliding = surface - block[layout.VX]
            return at(abs(sliding)) * math.copysign(1.0, sliding)

        return with_sliding


def _pushed(run: SegmentedRun, axis: str, spline: Spline, tables) -> PushedRun:
    known = {one.name: getattr(run, one.name) for one in fields(run) if one.init}
    return PushedRun(**known, axis=axis, low=spline.low, high=spline.high, tables=tables)
