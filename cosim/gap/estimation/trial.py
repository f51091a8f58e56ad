"""One model tried on a campaign: fitted on the runs for fitting, judged on all of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from stickslip.effects.candidate import FreeParameter

from .fit import MOST_ROUNDS, fit, with_columns
from .fitted import Fitted, Point, start
from .initial_states import with_lost_segments_found, with_velocities
from .phases import best_states, with_phases, with_phases_followed
from .preparation import Data
from .problem import Problem
from .segmented_run import SegmentedRun

#: Rounds that the segments' states take to follow parameters that stay as they are.
_ROUNDS_UNFITTED, _ROUNDS_SHORT = 2, 4
#: Fits that may follow one whose phases turned out to be better elsewhere.
_REPEATS = 3
#: Another follows one that left less than this part of the sum of squares.
_LEADS_ON = 0.98


@dataclass(frozen=True)
class Model:
    """What is turned and what is set.

    Attributes
    ----------
    free_parameters, settings : fitted, and set beside what is known of the rig
    local : spread of friction, and of static friction beside it, from segment to segment
    """

    free_parameters: tuple[FreeParameter, ...]
    settings: dict[str, float]
    local: tuple[float, float] = (0.0, 0.0)

    def problem(self, segmented_runs: Sequence[SegmentedRun]) -> Problem:
        """Of some runs."""
        return Problem(segmented_runs, self.free_parameters, self.settings, self.local)


@dataclass(frozen=True)
class Trial:
    """A model, fitted and judged.

    Attributes
    ----------
    fitted, held_out : the fit, and the held-out runs with its parameters
    squares, rows : per run, fit runs first: sum of squares and number of measured samples
    """

    model: Model
    fitted: Fitted
    held_out: Fitted
    squares: np.ndarray
    rows: np.ndarray

    @property
    def rms_residual(self) -> float:
        """Root mean square residual of all runs in units of the noise."""
        return float(np.sqrt(self.squares.sum() / self.rows.sum()))

    @property
    def held_out_rms(self) -> float:
        """Of the runs that were kept back; of all where none was."""
        first = len(self.fitted.residuals) if self.held_out.residuals else 0
        return float(np.sqrt(self.squares[first:].sum() / self.rows[first:].sum()))

    @property
    def fit_rms(self) -> float:
        """Of the runs for fitting."""
        fitted = slice(0, len(self.fitted.residuals))
        return float(np.sqrt(self.squares[fitted].sum() / self.rows[fitted].sum()))


def coarse_fit(data: Data, model: Model, rounds: int, before: Fitted | None = None) -> Fitted:
    """A fit in short segments: robust, cheap, and near enough for the long ones.

    before : the same model's, to go on from
    """
    problem = model.problem(data.short)
    point = before.point if before else start(data.short, model.free_parameters)
    return fit(problem, with_phases(problem, point), rounds)


def try_model(data: Data, model: Model, coarse: Fitted, rounds: int = MOST_ROUNDS) -> Trial:
    """Fit in long segments from a coarse fit, and judge; with no ``rounds`` that is judged."""
    problem = model.problem(data.fit)
    point = carried_over(problem, data.short, coarse.point)
    if rounds:  # states first: parameters would make up for those that are not of this model
        point = with_velocities(problem, point)
        point = fit(problem, point, _ROUNDS_UNFITTED, fixed=True).point
        fitted = with_columns(problem, _fit(problem, point, rounds))
    else:
        fitted = fit(problem, point, _ROUNDS_UNFITTED, fixed=True)
    return _judged(data, model, fitted, closely=rounds > 0)


def _judged(data: Data, model: Model, fitted: Fitted, closely: bool = True) -> Trial:
    held_out = _hold_out(data, model, fitted, closely)
    runs = (*data.fit, *data.held_out)
    rows = np.array([run.segment_of_rows().size for run in runs])
    residuals = [*fitted.residuals, *held_out.residuals]
    squares = [float(r[:n] @ r[:n]) for r, n in zip(residuals, rows, strict=True)]
    return Trial(model, fitted, held_out, np.array(squares), rows)


def _hold_out(data: Data, model: Model, fitted: Fitted, closely: bool) -> Fitted:
    """The held-out runs with the shared free parameters as fitted; states and phases are free.

    closely : phases are followed, and lost segments searched for
    """
    short = model.problem(data.held_out_short)
    point = start(short.segmented_runs, model.free_parameters)
    own = tuple(
        np.array([free.scaled(free.start) for free in short.own]) for _ in short.segmented_runs
    )
    point = with_phases(short, Point(fitted.point.shared, own, point.states))
    point = fit(short, with_velocities(short, point), _ROUNDS_SHORT, fixed=True).point
    problem = model.problem(data.held_out)
    point = with_velocities(problem, carried_over(problem, short.segmented_runs, point))
    if not closely:
        return fit(problem, point, fixed=True)
    point = fit(problem, with_phases_followed(problem, point), fixed=True).point
    fitted = fit(problem, with_lost_segments_found(problem, point), fixed=True)
    return with_columns(problem, fitted, by=())


def carried_over(problem: Problem, segmented_runs: Sequence[SegmentedRun], point: Point) -> Point:
    """A point in short segments as one in long ones, which start where some of the short ones do.

    Each starts from the state that was fitted in its short segment, or from that read off the data
    where it does better.
    """
    states = []
    for run, (long, short) in enumerate(zip(problem.segmented_runs, segmented_runs, strict=True)):
        rows = [segment.first for segment in short.segments]
        fitted = point.states[run][[rows.index(segment.first) for segment in long.segments]]
        states.append(best_states(problem, run, point.shared, point.own[run], fitted))
    return Point(point.shared, point.own, tuple(states))


def _fit(problem: Problem, point: Point, rounds: int = MOST_ROUNDS) -> Fitted:
    """A fit; again from where phases, and lost segments, fit better, as long as it leads on.

    With fewer ``rounds`` it is not to the end, and is not repeated.
    """
    fitted = fit(problem, point, rounds)
    for _ in range(_REPEATS if rounds == MOST_ROUNDS else 0):
        again = with_lost_segments_found(problem, with_phases_followed(problem, fitted.point))
        if again is fitted.point:
            break
        other = fit(problem, again, rounds)
        if other.cost >= _LEADS_ON * fitted.cost:
            return min(fitted, other, key=lambda found: found.cost)
        fitted = other
    return fitted
