"""Least squares over a campaign's numbers; the windows' start states follow them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from functools import cache
from math import inf
from typing import NamedTuple

import numpy as np

from cosim.gap.data import Campaign, MeasuredRun

from .descent import FIRST_TRIES, descend
from .fitted import Fitted, Leeway
from .numbers import Number, owners_of, unknowns_of
from .run_fit import RunFit
from .run_model import RunModel
from .start_states import Started
from .windows import Windows

#: Most evaluations of a fit; starts that lead on: those whose sum of squares is, after
#: `FIRST_TRIES`, at most so many times that of the best.
MOST_TRIES, LEADS = 20, 1.25
#: Gap up to which nothing is missing, and there is no other minimum to look for.
IN_STEP = 1.05
#: Fits in a row, each from better states of windows that were off course.
REPEATS = 3


@cache
def _threads(count: int) -> ThreadPoolExecutor:
    """Runs are simulated beside one another, outside the interpreter."""
    return ThreadPoolExecutor(count)


class Point(NamedTuple):
    """Scaled numbers, every run's start states, and the sum of squares there."""

    scaled: np.ndarray
    started: list[Started]
    cost: float


class Problem:
    """Residuals and derivatives as functions of the scaled numbers (k,)."""

    def __init__(
        self, campaign: Campaign, runs: Sequence[MeasuredRun], windows: Mapping[str, Windows],
        numbers: Sequence[Number], settings: Mapping[str, float], leeway: Leeway | None = None,
        near: Mapping[str, np.ndarray] | None = None, jobs: int = 2, hopeless: float = inf,
    ):  # fmt: skip
        """leeway : what another fit left open of some of the numbers, in place of their priors;
        near : run's name -> start states of a model nearby; jobs : runs simulated at a time;
        hopeless : sum of squares beyond which no start is followed for long."""
        self.settings, self.threads, self.hopeless = dict(settings), _threads(jobs), hopeless
        self.unknowns = unknowns_of(campaign, runs, numbers)
        self.labels = [unknown.label for unknown in self.unknowns]
        self.leeway = None if leeway is None else leeway.of(self.labels)
        self.parts = []
        for run in runs:
            owners = set(owners_of(campaign, run).values())
            felt = [i for i, unknown in enumerate(self.unknowns) if unknown.owner in owners]
            model = RunModel(campaign, run, windows[run.name])
            states = (near or {}).get(run.name)
            self.parts.append(RunFit(model, self.unknowns, felt, self.settings, states))

    def values(self, scaled: np.ndarray) -> dict[str, float]:
        """label -> value."""
        return {u.label: u.number.value(s) for u, s in zip(self.unknowns, scaled, strict=True)}

    def residuals(self, scaled: np.ndarray) -> np.ndarray:
        """Of all runs, with priors as rows (value - start) / prior."""
        rows = self.threads.map(lambda part: part.followed(scaled).residuals, self.parts)
        return np.concatenate([*rows, self._priors(scaled)[0]])

    def derivatives(self, scaled: np.ndarray) -> np.ndarray:
        """Of `residuals`, start states eliminated."""
        blocks = self.threads.map(lambda part: part.derivatives(scaled), self.parts)
        return np.concatenate([*blocks, self._priors(scaled)[1]])

    def changes(self, scaled: np.ndarray, more: Mapping[str, float]) -> np.ndarray:
        """(rows,) of the residuals by other values beside the numbers, start states eliminated.

        At the last point whose derivatives were taken.
        """
        rows = self.threads.map(lambda part: part.changes(scaled, more), self.parts)
        return np.concatenate([*rows, np.zeros_like(self._priors(scaled)[0])])

    def _priors(self, scaled: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        rows, slopes = np.zeros(len(self.unknowns)), np.zeros(len(self.unknowns))
        known = () if self.leeway is None else self.leeway.labels
        for i, (number, _) in enumerate(self.unknowns):
            if number.prior is not None and self.labels[i] not in known:
                rows[i] = (number.value(scaled[i]) - number.start) / number.prior
                slopes[i] = number.slope(scaled[i]) / number.prior
        if self.leeway is None:
            return rows, np.diag(slopes)
        there = [self.labels.index(label) for label in known]
        more = np.zeros((len(self.leeway.rows), len(self.unknowns)))
        more[:, there] = self.leeway.rows
        off = self.leeway.rows @ (scaled[there] - self.leeway.centre)
        return np.concatenate([rows, off]), np.vstack([np.diag(slopes), more])

    def solved(self, starts: Sequence[Mapping[str, float]] = ()) -> Fitted:
        """The best numbers, from the best of several starts: labels -> values, the rest as given"""
        leading = self._first(starts or [{}])
        points = [self._settled(point) for point in leading]
        best = min(points, key=lambda point: point.cost)
        if best is not points[-1]:
            self._go_on_from(best)
        while self.leeway is not None:
            excess = self.leeway.excess(best.scaled, self.labels)
            if excess <= 1.0:
                break
            # from inside: where no step leads back, no weight would
            inside = self.leeway.within(best.scaled, self.labels, excess)
            self.leeway = self.leeway.tightened(excess)
            best = self._descended(inside, FIRST_TRIES)
        return self._fitted(best.scaled)

    @property
    def _start(self) -> np.ndarray:
        start = np.zeros(len(self.unknowns))
        if self.leeway is not None:
            for label, place in zip(self.leeway.labels, self.leeway.centre, strict=True):
                start[self.labels.index(label)] = place
        return start

    def _settled(self, at: Point) -> Point:
        """The best nearby; again from where windows off course find better states."""
        self._go_on_from(at)
        for _ in range(0 if at.cost > self.hopeless else REPEATS):
            at = self._descended(at.scaled, MOST_TRIES)
            if not self._retried(at.scaled):
                break
        return self._point(at.scaled)

    def _retried(self, scaled: np.ndarray) -> bool:
        """Whether windows of any run, all tried, have found better states."""
        return any(list(self.threads.map(lambda part: part.retried(scaled), self.parts)))

    def _point(self, scaled: np.ndarray) -> Point:
        started = [part.followed(scaled) for part in self.parts]
        return Point(scaled, started, float(np.sum(self.residuals(scaled) ** 2)))

    def _go_on_from(self, point: Point) -> None:
        for part, started in zip(self.parts, point.started, strict=True):
            part.forget(point.scaled, started)

    def _first(self, starts: Sequence[Mapping[str, float]]) -> list[Point]:
        """Where starts lead in a few steps: those near to the best."""
        points: list[Point] = []
        for start in starts:
            for part in self.parts:
                part.forget()
            tries = FIRST_TRIES if len(starts) > 1 else MOST_TRIES
            points.append(self._descended(self.scaled(start), tries))
            in_step = IN_STEP**2 * sum(part.model.size for part in self.parts)
            if points[-1].cost < in_step:
                return points[-1:]
        best = min(point.cost for point in points)
        return [point for point in points if point.cost <= LEADS * best]

    def scaled(self, values: Mapping[str, float]) -> np.ndarray:
        """(k,) of labelled values, within their bounds; the others at their starts."""
        start = self._start
        for place, (label, (number, _)) in enumerate(zip(self.labels, self.unknowns, strict=True)):
            if label in values:
                inside = min(max(values[label], number.low), number.high)
                start[place] = number.scaled(inside)
        return np.asarray(np.nan_to_num(start, neginf=0.0))

    def _descended(self, at: np.ndarray, tries: int) -> Point:
        """Down from one point, in so many tries."""
        if not self.unknowns:
            return self._point(at)
        low = [u.number.scaled(u.number.low) for u in self.unknowns]
        high = [u.number.scaled(u.number.high) for u in self.unknowns]
        found = descend(self, np.clip(at, low, high), np.array(low), np.array(high), tries,
                        self.hopeless)  # fmt: skip
        return self._point(found)

    def _fitted(self, at: np.ndarray) -> Fitted:
        derivatives = self.derivatives(at)
        runs = tuple(part.described(at) for part in self.parts)
        fitted = Fitted.at(self.unknowns, at, derivatives, runs, self.residuals(at))
        return replace(fitted, simulated=sum(part.model.simulated for part in self.parts))
