"""Which features make up a force: forward regression by orthogonal least squares."""

import numpy as np
import pytest

from cosim.gap.diagnostics.sparse_regression import forward_selection


def collinear(seed, samples=40, features=12):
    """Columns that are nearly those of four, and what a few of them make up, in noise."""
    random = np.random.default_rng(seed)
    few = random.standard_normal((samples, 4)) @ random.standard_normal((4, features))
    columns = few + 0.05 * random.standard_normal((samples, features))
    weights = random.standard_normal(features) * (random.random(features) < 0.3)
    return columns, 30.0 * columns @ weights + random.standard_normal(samples)


def test_the_terms_are_those_that_the_sum_is_made_of():
    columns = np.linalg.qr(np.random.default_rng(0).standard_normal((30, 6)))[0]
    assert forward_selection(columns, columns @ [0.0, 3.0, 0.0, -5.0, 0.0, 1.0], 3) == [3, 1, 5]


def test_the_next_term_is_judged_by_what_is_left_of_it():
    """The second column goes better with the sum than the third does, but adds nothing."""
    first, second = np.eye(4)[:2]
    columns = np.column_stack([first, first + 0.01 * np.eye(4)[3], second])
    assert forward_selection(columns, 5.0 * first + second, 2) == [0, 2]


def test_no_more_terms_than_features():
    columns, seen = collinear(0, features=2)
    assert sorted(forward_selection(columns, seen, 5)) == [0, 1]
    assert forward_selection(columns[:, :0], seen, 5) == []


# as pysindy.FROLS(max_iter=3, alpha=0.0) of version 2.1 chose them
CHOSEN = [
    [[6], [6, 10], [4, 6, 10]],
    [[10], [3, 10], [3, 8, 10]],
    [[3], [3, 10], [1, 3, 10]],
    [[6], [5, 6], [5, 6, 10]],
    [[6], [6, 9], [6, 8, 9]],
    [[5], [2, 5], [1, 2, 5]],
    [[10], [10, 11], [0, 10, 11]],
    [[11], [10, 11], [6, 10, 11]],
]


@pytest.mark.parametrize("seed", range(len(CHOSEN)))
def test_orders_are_those_of_pysindy(seed):
    columns, seen = collinear(seed)
    chosen = forward_selection(columns, seen, 3)
    assert [sorted(chosen[:count]) for count in (1, 2, 3)] == CHOSEN[seed]
