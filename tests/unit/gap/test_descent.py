"""Least squares of a few numbers: the minimum of another solver, with fewer derivatives."""

import numpy as np
import pytest
from scipy.optimize import least_squares

from cosim.gap.windows.descent import CLOSE, FIRST_TRIES, descend

TIMES = np.linspace(0.0, 4.0, 400)
TRUTH = np.array([2.0, 0.7, 3.0, 0.4])


class Decay:
    """A decaying swing of four numbers beside its measurement; counts what it is asked."""

    def __init__(self):
        self.measured = self.model(TRUTH) + 0.05 * np.random.default_rng(1).normal(size=TIMES.size)
        self.evaluations = self.jacobians = 0

    def model(self, at):
        return at[0] * np.exp(-at[1] * TIMES) * np.cos(at[2] * TIMES + at[3])

    def residuals(self, at):
        self.evaluations += 1
        return (self.model(at) - self.measured) / 0.05

    def derivatives(self, at):
        self.jacobians += 1
        step = 1e-6 * np.eye(at.size)
        return np.array([self.model(at + each) - self.model(at - each) for each in step]).T / 1e-7


@pytest.mark.parametrize("high", [np.inf, 1.8], ids=["free", "at a bound"])
@pytest.mark.parametrize("start", [(1.5, 0.5, 2.9, 0.3), (1.0, 1.5, 3.3, 0.0)], ids=["near", "far"])
def test_it_ends_where_another_solver_does(start, high):
    swing, low = Decay(), np.full(4, -np.inf)
    highest = np.array([high, np.inf, np.inf, np.inf])
    at = descend(swing, np.array(start), low, highest, 50)
    best = least_squares(swing.residuals, start, bounds=(low, highest))
    left = float(np.sum(swing.residuals(at) ** 2))
    assert left < 2.0 * best.cost + 2.0 * CLOSE
    assert at[0] <= high


def test_derivatives_are_followed_and_not_taken_at_every_step():
    swing, wide = Decay(), np.full(4, np.inf)
    descend(swing, np.array([1.5, 0.5, 2.9, 0.3]), -wide, wide, 50)
    assert swing.jacobians <= swing.evaluations / 2


@pytest.mark.parametrize(("promised", "evaluations"), [(0.7, 2), (1.3, 3)])
def test_a_small_step_that_is_refused_ends_a_fit(promised, evaluations):
    """What is left of it is the integrator's error; a greater one is tried again, shorter."""

    class Refused:
        asked = 0

        def residuals(self, at):
            self.asked += 1
            return np.array([at[0] - np.sqrt(promised), 2.0 * bool(at[0])])

        def derivatives(self, at):
            return np.array([[1.0], [0.0]])

    refused, wide = Refused(), np.array([np.inf])
    assert descend(refused, np.zeros(1), -wide, wide, 2) == 0.0
    assert refused.asked == evaluations


@pytest.mark.parametrize(("hopeless", "goes_on"), [(0.99, False), (1.01, True)])
def test_a_start_that_leads_nowhere_is_left(hopeless, goes_on):
    """Where the sum of squares after some evaluations says so."""
    left, wide = [], np.full(4, np.inf)
    for most, tries in ((np.inf, FIRST_TRIES), (np.inf, 50), (hopeless, 50)):
        swing, far = Decay(), np.array([0.1, 3.0, 1.0, 2.0])
        bound = most * left[0] if left else most
        at = descend(swing, far, -wide, wide, tries, bound)
        left.append(float(np.sum(swing.residuals(at) ** 2)))
    assert left[1] < left[0]
    assert left[2] == left[goes_on]
