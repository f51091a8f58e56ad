"""Runs whose model is linear: what a fit should come to is a matter of linear algebra.

A run's residuals are A shared + B own + C states - d. `Problem` asks for no more of a segmented
run than this one has, so a fit of many segments and runs can be held against one least squares.
"""

from dataclasses import dataclass, replace

import numpy as np

from cosim.gap.estimation.fit import with_columns
from cosim.gap.estimation.problem import Problem
from cosim.gap.estimation.segments import STATES, Segment
from cosim.gap.estimation.trial import Model, Trial

#: Free numbers of every segment's state: position and velocity.
FREE = (0, 3)
#: Residuals that a metre, or a metre a second, of a state makes: noise is a part of a mm.
FELT = 3e3


@dataclass(frozen=True)
class LinearRun:
    """One run.

    by_key : `block.parameter` -> (rows,) derivative of the residuals; by_state : (rows, 2) by the
    state of the segment that a row belongs to; data : (rows,)
    """

    by_key: dict
    by_state: np.ndarray
    data: np.ndarray
    segments: tuple
    speed = 0.0  # of a surface at rest: there is no velocity to stick at

    @property
    def starts(self):
        return np.zeros((len(self.segments), STATES))

    def places(self, values, states):
        rows = sum(self.by_key[key] * value for key, value in values.items())
        return rows + np.sum(self.by_state * states[:, FREE][self.segment_of_rows()], axis=1)

    def residuals(self, places, offsets):
        assert not offsets
        return places - self.data

    def segment_of_rows(self):
        sizes = [segment.last - segment.first for segment in self.segments]
        return np.repeat(np.arange(len(sizes)), sizes)


def linear_run(random, free_parameters, data, segments=3):
    """With derivatives that are drawn, and data: (rows,), or a noise of one at so many rows."""
    data = random.standard_normal(data) if isinstance(data, int) else data
    ends = np.linspace(0, data.size, segments + 1).astype(int)
    cuts = tuple(
        Segment(int(first), int(last), np.zeros(STATES), FREE, np.nan)
        for first, last in zip(ends[:-1], ends[1:], strict=True)
    )
    by_key = {
        free_parameter.key: random.standard_normal(data.size) for free_parameter in free_parameters
    }
    by_state = FELT * random.standard_normal((data.size, len(FREE)))
    return LinearRun(by_key, by_state, data, cuts)


def joint(problem: Problem) -> tuple[np.ndarray, np.ndarray]:
    """Matrix and right-hand side of everything at once, priors as rows.

    Unknowns, unscaled: the shared free parameters, then of every run its own and its states.
    """
    shared, own = problem.shared, problem.own
    per_run = [
        len(own) + len(FREE) * len(segmented.segments) for segmented in problem.segmented_runs
    ]
    before = len(shared) + np.concatenate([[0], np.cumsum(per_run)])
    rows, right = [], []
    for segmented, first in zip(problem.segmented_runs, before, strict=False):
        block = np.zeros((segmented.data.size, before[-1]))
        for column, free_parameter in enumerate(shared):
            block[:, column] = segmented.by_key[free_parameter.key]
        for column, free_parameter in enumerate(own, first):
            block[:, column] = segmented.by_key[free_parameter.key]
        for row, segment in enumerate(segmented.segment_of_rows()):
            at = first + len(own) + len(FREE) * segment
            block[row, at : at + len(FREE)] = segmented.by_state[row]
        rows.append(block)
        right.append(segmented.data)
        rows.append(_known(own, first, before[-1]))
        right.append(_wanted(own))
    rows.append(_known(shared, 0, before[-1]))
    right.append(_wanted(shared))
    return np.concatenate(rows), np.concatenate(right)


def _known(free_parameters, first, width):
    rows = np.zeros((len(free_parameters), width))
    for number, free_parameter in enumerate(free_parameters):
        if free_parameter.prior is not None:
            rows[number, first + number] = 1.0 / free_parameter.prior
    return rows


def _wanted(free_parameters):
    return np.array([0.0 if k.prior is None else k.start / k.prior for k in free_parameters])


def trial_of(problem, fitted):
    """A fit as a trial of a campaign that holds no run out."""
    squares = np.array([r @ r for r in fitted.residuals])
    rows = np.array([r.size for r in fitted.residuals])
    model = Model(problem.free_parameters, problem.settings)
    return Trial(model, with_columns(problem, fitted), replace(fitted, residuals=()), squares, rows)
