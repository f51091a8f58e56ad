"""What a fit found: values, their standard deviations, and how far each run is from its model."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from .numbers import Unknown

#: A number this near to a bound, in its scales, is at it: the solver stays a little inside.
NEAR = 0.02
#: Singular values below this part of the largest are directions that the data do not determine.
RANK = 1e-9
#: A number with more than this of such a direction in it is not determined either.
UNFELT = 1e-3
#: Shared numbers may be off in held-out runs by sqrt(k) + this many standard deviations in all.
FURTHEST = 2.0


@dataclass(frozen=True)
class FittedRun:
    """One run beside its model.

    Attributes
    ----------
    values : key -> value of all that is set or fitted of the run
    track : (n, 3) x, y, phi of the model (m, m, rad) at the data's times, tracker's zero included
    states : (w, 6 + sticks) of the block at the windows' starts, and what each stick holds more,
        the logarithm of the factor on mu_s
    residuals : (m,) model less data in units of the noise, one for each sample seen
    window : (m,) number of the window that each belongs to
    rows, axes : (m,) the sample that each belongs to, and which of `windows.AXES`
    rounding : (m,) factor by which the noise of each is larger than stated
    """

    name: str
    values: dict[str, float]
    track: np.ndarray = field(repr=False)
    states: np.ndarray = field(repr=False)
    residuals: np.ndarray = field(repr=False)
    window: np.ndarray = field(repr=False)
    hold_out: bool
    rows: np.ndarray = field(repr=False)
    axes: np.ndarray = field(repr=False)
    rounding: np.ndarray | float = field(default=1.0, repr=False)

    @property
    def begin(self) -> int:
        """First sample that is compared."""
        return int(self.rows[0])

    @property
    def gap(self) -> float:
        """Root mean square residual in units of the noise: 1 where nothing is missing."""
        return _rms([self])


@dataclass(frozen=True)
class Information:
    """What a fit knows of its numbers, those that are known beforehand included.

    labels, scaled : (k,) of the numbers; root : (k, k), the information by these is R' R
    slope : (k,) of half the sum of squares, not quite 0 where the fit ended early
    """

    labels: tuple[str, ...]
    scaled: np.ndarray
    root: np.ndarray
    slope: np.ndarray


@dataclass(frozen=True)
class Leeway:
    """What a fit leaves open of the numbers that all runs share.

    labels : of the numbers; centre : (k,) their scaled values as fitted
    rows : (k, k) of unit variance by the scaled numbers: the fit's information, other numbers
        eliminated; what the runs do not determine has next to none
    """

    labels: tuple[str, ...]
    centre: np.ndarray
    rows: np.ndarray
    weight: float = 1.0

    @classmethod
    def at(cls, unknowns: Sequence[Unknown], scaled: np.ndarray, root: np.ndarray) -> Leeway:
        """From what a fit knows where it ended, as of `Information`."""
        shared = np.array([unknown.number.scope != "run" for unknown in unknowns], dtype=bool)
        order = np.argsort(shared, kind="stable")
        first = int(np.sum(~shared))
        rows = np.asarray(np.linalg.qr(root[:, order], mode="r"))[first:, first:]
        labels = tuple(unknowns[i].label for i in order[first:])
        return cls(labels, scaled[order[first:]], rows)

    def of(self, labels: Sequence[str]) -> Leeway:
        """Of these numbers alone, the others staying as fitted."""
        kept = [i for i, label in enumerate(self.labels) if label in labels]
        known = tuple(self.labels[i] for i in kept)
        return Leeway(known, self.centre[kept], self.rows[:, kept], self.weight)

    def excess(self, scaled: np.ndarray, labels: Sequence[str]) -> float:
        """How far the numbers are from the fit, in parts of what its errors explain, 3 in 1000."""
        if not self.labels:
            return 0.0
        moved = np.array([scaled[labels.index(label)] for label in self.labels]) - self.centre
        size = float(np.linalg.norm(self.rows @ moved)) / self.weight
        return size / (math.sqrt(len(self.labels)) + FURTHEST)

    def within(self, scaled: np.ndarray, labels: Sequence[str], excess: float) -> np.ndarray:
        """The same numbers, of which these are half as far from the fit as its errors explain."""
        inside = scaled.copy()
        places = [labels.index(label) for label in self.labels]
        inside[places] = self.centre + 0.5 / excess * (scaled[places] - self.centre)
        return inside

    def tightened(self, excess: float) -> Leeway:
        """The same, held harder: against a constant pull a weight's square shortens the way."""
        by = max(2.0, math.sqrt(excess))
        return Leeway(self.labels, self.centre, by * self.rows, by * self.weight)


@dataclass(frozen=True)
class Fitted:
    """A fitted model.

    Attributes
    ----------
    values : label -> value; labels are ``key``, ``key@run``, ``key@setup n``
    sd : label -> standard deviation; enlarged by the gap where that exceeds 1, since residuals that
        the noise does not explain count as much noise more; infinite where no motion depends on it
    at_bound : label -> the bound that the value is at
    runs : fitted ones and held-out ones
    cost, held_out_cost : squared residuals of all runs, and of those held out, with those of the
        numbers from what is known beforehand
    leeway : of the numbers that all runs share
    known : of the fitted runs, and of those held out
    simulated : samples of all runs that it took (see `RunModel`)
    """

    values: dict[str, float]
    sd: dict[str, float]
    at_bound: dict[str, float]
    runs: tuple[FittedRun, ...]
    cost: float = float("nan")
    leeway: Leeway | None = field(default=None, repr=False)
    known: tuple[Information, ...] = field(default=(), repr=False)
    held_out_cost: float = 0.0
    simulated: int = 0

    @classmethod
    def at(
        cls, unknowns: Sequence[Unknown], scaled: np.ndarray, derivatives: np.ndarray,
        runs: tuple[FittedRun, ...], off: np.ndarray,
    ) -> Fitted:  # fmt: skip
        """From the scaled numbers (k,), the derivatives (rows, k) and the residuals (rows,) there.

        The covariance of the scaled numbers is (J'J)^-1, sd = |d value / d scaled| times the root
        of its diagonal.
        """
        root = np.asarray(np.linalg.qr(derivatives, mode="r"))
        _, singular, right = np.linalg.svd(root)
        is_felt = singular > RANK * singular.max(initial=0.0)
        spread = np.linalg.norm(right[is_felt] / singular[is_felt, None], axis=0)
        spread = spread * max(1.0, _rms(runs))
        spread[np.linalg.norm(right[~is_felt], axis=0) > UNFELT] = np.inf
        values, sd, at_bound = {}, {}, {}
        for (number, owner), place, width in zip(unknowns, scaled, spread, strict=True):
            label = Unknown(number, owner).label
            values[label] = number.value(place)
            sd[label] = abs(number.slope(place)) * float(width)
            for bound in (number.low, number.high):
                if abs(place - number.scaled(bound)) < NEAR:
                    at_bound[label] = bound
        known = Information(tuple(values), scaled, root, derivatives.T @ off)
        leeway = Leeway.at(unknowns, scaled, root)
        return cls(values, sd, at_bound, runs, float(off @ off), leeway, (known,))

    @property
    def gap(self) -> tuple[float, float]:
        """Root mean square residual in units of the noise: of fitted, of held-out runs (or NaN)."""
        held_out = [run for run in self.runs if run.hold_out]
        return _rms([run for run in self.runs if not run.hold_out]), _rms(held_out)

    def in_stated_units(self) -> Fitted:
        """With residuals in units of the noise as stated, without what rounding adds to it."""
        runs = [replace(run, residuals=run.residuals * run.rounding) for run in self.runs]
        return replace(self, runs=tuple(runs))

    def gain_over(self, other: Fitted) -> float:
        """ln of how much more probable all runs are than with another model of the same windows.

        What noise does not explain of the better one counts as so much noise more. Held-out runs
        gain no more than the fitted ones: the fit of a run may have been lost with the other.
        """
        left = max(min(self.misfit, other.misfit), 1.0)
        all_runs = 0.5 * (other.cost - self.cost) / left
        held_out = 0.5 * (other.held_out_cost - self.held_out_cost) / left
        fitted = all_runs - held_out
        return fitted + min(held_out, max(fitted, 0.0))

    @property
    def misfit(self) -> float:
        """Mean square residual of all runs, in units of the noise."""
        return _rms(self.runs) ** 2

    @property
    def stick_scatter(self) -> float:
        """Root mean square by which single sticks of the fitted runs hold more or less, a part."""
        own = np.concatenate([run.states[:, 6:].ravel() for run in self.runs if not run.hold_out])
        own = own[own != 0.0]
        return float(np.sqrt(np.mean(own**2))) if own.size else 0.0

    def run(self, name: str) -> FittedRun:
        """One run by its name; KeyError."""
        return {run.name: run for run in self.runs}[name]


def joined(fitted: Fitted, judged: Fitted, names: Sequence[str]) -> Fitted:
    """A fit with the runs that it was judged by, in the order of the names."""
    runs = {run.name: run for run in (*fitted.runs, *judged.runs)}
    return replace(
        fitted,
        cost=fitted.cost + judged.cost,
        held_out_cost=judged.cost,
        known=(*fitted.known, *judged.known),
        simulated=fitted.simulated + judged.simulated,
        values={**judged.values, **fitted.values},
        sd={**judged.sd, **fitted.sd},
        runs=tuple(runs[name] for name in names if name in runs),
    )


def _rms(runs: Sequence[FittedRun]) -> float:
    if not runs:
        return float("nan")
    return float(np.sqrt(np.mean(np.concatenate([run.residuals for run in runs]) ** 2)))
