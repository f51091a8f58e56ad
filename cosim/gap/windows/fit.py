"""Least squares over a campaign's numbers; the windows' start states follow them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from scipy.optimize import least_squares

from cosim.gap.data import Campaign, MeasuredRun

from .fitted import Fitted, FittedRun, joined
from .numbers import Number, Unknown, owners_of, unknowns_of
from .run_model import RunModel
from .scan import valleys
from .start_states import Started, StartStates
from .windows import Windows

#: Finite differences of a number, in its scales. Numbers that compensate each other but for their
#: priors (mu_s, mu_k and all zeros) need derivatives to 1e-4 of themselves: with ten times the step
#: the curvature of the motion seems to tell them apart.
STEP = 1e-4
#: A fit ends where a step would change the sum of squares by less than this part of it.
SETTLED = 1e-5
#: Most evaluations of a fit, and of one that only shows which start leads on.
MOST_TRIES, FIRST_TRIES = 40, 8
#: Gap up to which nothing is missing, and there is no other minimum to look for.
IN_STEP = 1.05
#: Fits in a row, each from states found anew, as long as one leads on by this part.
REPEATS, LEADS_ON = 3, 1e-3
#: A window whose misfit grows by this factor in a step has lost its course.
LOST = 2.0


def fit(
    campaign: Campaign,
    windows: Mapping[str, Windows],
    numbers: Sequence[Number],
    settings: Mapping[str, float] | None = None,
    scatter: float = 0.0,
) -> Fitted:
    """Numbers that minimise the squared residuals over the windows of the runs for fitting.

    Minimises sum(((model - data) / noise)^2) + sum(((value - start) / prior)^2); held-out runs are
    then judged as by `judge`.

    windows : run's name -> windows, as of `windows_of_campaign`; settings : key or label -> value
    of what else of the model is not at its default; scatter : see `judge`
    """
    settings = dict(settings or {})
    runs = [run for run in campaign.fit_runs if run.name in windows]
    problem = _Problem(campaign, runs, windows, numbers, settings)
    fitted = problem.solved(scan=True)
    held_out = [run for run in campaign.held_out_runs if run.name in windows]
    if not held_out:
        return fitted
    values = {**settings, **fitted.values}
    judged = judge(campaign, windows, numbers, values, scatter, held_out)
    return joined(fitted, judged, [run.name for run in campaign.runs])


def judge(
    campaign: Campaign,
    windows: Mapping[str, Windows],
    numbers: Sequence[Number],
    values: Mapping[str, float],
    scatter: float = 0.0,
    runs: Sequence[MeasuredRun] | None = None,
) -> Fitted:
    """How well given values describe some runs, those held out if not said.

    Free are the windows' start states and what no other run can tell: the tracker's zero, within
    its prior, phases, and friction if ``scatter``, its relative standard deviation from run to run,
    is not 0. Surface speed and springs are as the values, else the campaign, state them.
    """
    own = [n for n in numbers if n.scope == "run" and n.key not in _STATED]
    if scatter > 0.0:
        own.append(Number("offset.friction", 0.0, scatter, -1.0, 1.0, "run"))
    runs = campaign.held_out_runs if runs is None else runs
    runs = [run for run in runs if run.name in windows]
    return _Problem(campaign, runs, windows, own, values).solved()


#: A run's own numbers that are as stated where nothing is fitted to its data.
_STATED = ("offset.speed", "offset.friction", "offset.stiffness")


class _Point(NamedTuple):
    """Scaled numbers, every run's start states, and the sum of squares there."""

    scaled: np.ndarray
    started: list[Started]
    cost: float


class _Problem:
    """Residuals and derivatives as functions of the scaled numbers (k,)."""

    def __init__(
        self,
        campaign: Campaign,
        runs: Sequence[MeasuredRun],
        windows: Mapping[str, Windows],
        numbers: Sequence[Number],
        settings: Mapping[str, float],
    ):
        self.settings = dict(settings)
        self.unknowns = unknowns_of(campaign, runs, numbers)
        self.parts = []
        for run in runs:
            owners = set(owners_of(campaign, run).values())
            felt = [i for i, unknown in enumerate(self.unknowns) if unknown.owner in owners]
            model = RunModel(campaign, run, windows[run.name])
            self.parts.append(_Part(model, self.unknowns, felt, self.settings))

    def values(self, scaled: np.ndarray) -> dict[str, float]:
        """label -> value."""
        return {u.label: u.number.value(s) for u, s in zip(self.unknowns, scaled, strict=True)}

    def residuals(self, scaled: np.ndarray) -> np.ndarray:
        """Of all runs, with priors as rows (value - start) / prior."""
        rows = [part.followed(scaled).residuals for part in self.parts]
        return np.concatenate([*rows, self._priors(scaled)[0]])

    def derivatives(self, scaled: np.ndarray) -> np.ndarray:
        """Of `residuals`, start states eliminated."""
        blocks = [part.derivatives(scaled) for part in self.parts]
        return np.concatenate([*blocks, self._priors(scaled)[1]])

    def _priors(self, scaled: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        rows, slopes = np.zeros(len(self.unknowns)), np.zeros(len(self.unknowns))
        for i, (number, _) in enumerate(self.unknowns):
            if number.prior is not None:
                rows[i] = (number.value(scaled[i]) - number.start) / number.prior
                slopes[i] = number.slope(scaled[i]) / number.prior
        return rows, np.diag(slopes)

    def solved(self, scan: bool = False) -> Fitted:
        """The best numbers; scan: sets out from the best of several starts."""
        best = self._settled(self._first() if scan else self._descended(self._start, MOST_TRIES))
        return self._fitted(best.scaled)

    @property
    def _start(self) -> np.ndarray:
        return np.zeros(len(self.unknowns))

    def _settled(self, at: _Point) -> _Point:
        """The best nearby; again from where windows off course find better states."""
        for _ in range(REPEATS):
            at = self._descended(at.scaled, MOST_TRIES)
            if not any([part.retried(at.scaled) for part in self.parts]):
                break
        return self._point(at.scaled)

    def _point(self, scaled: np.ndarray) -> _Point:
        started = [part.followed(scaled) for part in self.parts]
        return _Point(scaled, started, float(np.sum(self.residuals(scaled) ** 2)))

    def _go_on_from(self, point: _Point) -> None:
        for part, started in zip(self.parts, point.started, strict=True):
            part.forget(point.scaled, started)

    def _first(self) -> _Point:
        """The best of a few starts after a few steps; the first guess alone if it is in step."""
        best = self._descended(self._start, FIRST_TRIES)
        if best.cost < IN_STEP**2 * sum(part.model.size for part in self.parts):
            return best
        for start in valleys(self.unknowns, self._rough_cost):
            for part in self.parts:
                part.forget()
            best = min(best, self._descended(start, FIRST_TRIES), key=lambda point: point.cost)
        self._go_on_from(best)
        return best

    def _rough_cost(self, at: np.ndarray) -> float:
        return sum(part.roughly(at) for part in self.parts)

    def _descended(self, at: np.ndarray, tries: int) -> _Point:
        """Down from one point, in so many tries."""
        if not self.unknowns:
            return self._point(at)
        low = [u.number.scaled(u.number.low) for u in self.unknowns]
        high = [u.number.scaled(u.number.high) for u in self.unknowns]
        found = least_squares(
            self.residuals, np.clip(at, low, high), self.derivatives, (low, high),
            ftol=SETTLED, xtol=1e-4, max_nfev=tries,
        )  # fmt: skip
        return self._point(found.x)

    def _fitted(self, at: np.ndarray) -> Fitted:
        derivatives = self.derivatives(at)
        runs = tuple(part.described(at) for part in self.parts)
        return Fitted.at(self.unknowns, at, derivatives, runs)


class _Part:
    """One run of a problem, with the start states that belong to the last derivatives."""

    def __init__(
        self,
        model: RunModel,
        unknowns: Sequence[Unknown],
        felt: Sequence[int],
        settings: Mapping[str, float],
    ):
        self.model, self.starts = model, StartStates(model)
        self.unknowns, self.felt, self.settings = unknowns, list(felt), settings
        self.tried: dict[bytes, Started] = {}
        self.base: np.ndarray | None = None  # where the following were taken
        self.columns: np.ndarray | None = None
        self.response = np.empty(0)

    def values(self, scaled: np.ndarray) -> dict[str, float]:
        """key -> value of this run."""
        own = {self.unknowns[i].label: self.unknowns[i].number.value(scaled[i]) for i in self.felt}
        return self.model.values({**self.settings, **own})

    def roughly(self, scaled: np.ndarray) -> float:
        """Sum of squares from the states read off the data."""
        values = self.values(scaled)
        states = self.starts.read_off(values)
        return float(np.sum(self.model.residuals(values, states) ** 2))

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
            return self.starts.found(values, p)
        base = self.tried[self.base.tobytes()]
        if self.columns is None:
            return self.starts.settled(values, self.starts.started(values, base.states, p), p)
        moved = base.states.copy()
        moved[:, self.starts.axes] += self.response @ (scaled[self.felt] - self.base)
        at = self.starts.started(values, moved, p)
        limit = LOST * self.starts.squares(base) + 10.0
        if (self.starts.squares(at) > limit).any():
            at = self.starts.better(at, self.starts.started(values, base.states, p))
        at = self.starts.stepped(values, at, self.columns, p)
        if (self.starts.squares(at) > limit).any():
            at = self.starts.settled(values, at, p, rounds=2)
        return at

    def derivatives(self, scaled: np.ndarray) -> np.ndarray:
        """(size, k) by the numbers, normal to those by the start states."""
        at, values = self.followed(scaled), self.values(scaled)
        p = self.model.packed(values)
        self.columns = self.starts.derivatives(values, at, p)
        slopes = np.zeros((self.model.size, len(self.felt)))
        for place, i in enumerate(self.felt):
            slopes[:, place] = self._slope(scaled, i, at)
        move = self.starts.coordinates(self.columns, slopes)
        steps = self.starts.steps[self.starts.axes]
        self.response = -move * steps[None, :, None]
        self.base = scaled[self.felt].copy()
        self.tried = {self.base.tobytes(): at}
        derivatives = np.zeros((self.model.size, len(self.unknowns)))
        derivatives[:, self.felt] = self.starts.normal_part(self.columns, slopes)
        return derivatives

    def _slope(self, scaled: np.ndarray, i: int, at: Started) -> np.ndarray:
        """(size,) by one number, at fixed start states."""
        number = self.unknowns[i].number
        if number.key in ("offset.x", "offset.y"):
            seen = self.model.axes == ("offset.x", "offset.y").index(number.key)
            return np.where(seen, number.slope(scaled[i]) / self.model.noise, 0.0)
        moved = scaled.copy()
        step = STEP if number.value(scaled[i] + STEP) <= number.high else -STEP
        moved[i] += step
        return (self.model.residuals(self.values(moved), at.states) - at.residuals) / step

    def retried(self, scaled: np.ndarray) -> bool:
        """Whether windows off course have found better states, which are then kept."""
        at, values = self.followed(scaled), self.values(scaled)
        p = self.model.packed(values)
        other = self.starts.retried(values, self.starts.settled(values, at, p), p)
        self.forget(scaled, other)
        return self.starts.gain(at, other) > LEADS_ON

    def described(self, scaled: np.ndarray) -> FittedRun:
        """The run as the fit left it."""
        at, values = self.followed(scaled), self.values(scaled)
        return FittedRun(
            self.model.run.name, values, self.model.track(values, at.states), at.states,
            at.residuals, self.model.owner, self.model.run.hold_out,
        )  # fmt: skip
