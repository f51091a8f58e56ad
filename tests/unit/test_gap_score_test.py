"""The first sieve: laws that explain something alone, and two that do so only together."""

import numpy as np
import pytest
from stickslip.effects.candidate import Candidate, FreeParameter

from cosim.gap.selection.score_test import ScoreTest

ROWS = 400


def law(effect, start=0.1, low=0.0, high=1.0):
    return Candidate(effect, "law", (FreeParameter(f"{effect}.strength", start, 0.1, low, high),))


def screen(residuals, responses, laws):
    """Products of what was seen with the laws' responses to their starts."""
    left = np.column_stack([residuals, *responses])
    return ScoreTest(tuple(laws), left.T @ left)


@pytest.fixture
def random():
    return np.random.default_rng(5)


def test_a_law_explains_what_its_answer_takes_away(random):
    one, other, noise = random.standard_normal((3, ROWS))
    residuals = noise - 3.0 * one  # the law's answer would take it away
    gains = screen(residuals, [one, other, -one], map(law, "abc")).gains()
    assert gains[0] == pytest.approx((residuals @ one) ** 2 / (one @ one) / (residuals @ residuals))
    assert gains[0] > 0.8 and gains[1] < 0.02
    assert gains[2] == 0.0  # points away


def test_two_laws_that_hide_one_another_are_found_with_their_strengths(random):
    """Nearly opposite responses of nearly the same size: what one adds, the other takes away."""
    common, rest, noise = random.standard_normal((3, ROWS))
    one, other = common + 0.1 * rest, 0.1 * rest - common
    residuals = 0.2 * noise - 20.0 * one - 20.0 * other  # 4 of the rest, nothing of the common
    found = screen(residuals, [one, other], [law("a", 0.01), law("b", 0.02)])
    assert found.gains().max() < 0.1
    first, second = found.masking_pair()
    assert (first.effect, second.effect) == ("a", "b")
    assert first.free_parameters[0].start == pytest.approx(0.2, rel=0.05)
    assert second.free_parameters[0].start == pytest.approx(0.4, rel=0.05)


def test_a_strength_stays_in_its_range(random):
    common, rest = random.standard_normal((2, ROWS))
    one, other = common + 0.1 * rest, 0.1 * rest - common
    found = screen(-20.0 * (one + other), [one, other], [law("a"), law("b", 0.01)]).masking_pair()
    assert found[0].free_parameters[0].start == 1.0


def test_what_one_does_alone_is_not_masked(random):
    one, other = random.standard_normal((2, ROWS))
    assert screen(-5.0 * one - 0.5 * other, [one, other], map(law, "ab")).masking_pair() is None


def test_two_laws_of_one_effect_are_no_pair(random):
    common, rest = random.standard_normal((2, ROWS))
    one, other = common + 0.1 * rest, 0.1 * rest - common
    assert screen(-20.0 * (one + other), [one, other], map(law, "aa")).masking_pair() is None
    # nor are two of which one would have to be less than nothing
    assert screen(-20.0 * (one - other), [one, other], map(law, "ab")).masking_pair() is None
