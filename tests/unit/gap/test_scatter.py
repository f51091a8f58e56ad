"""A scatter of friction that simulated runs are averaged over, against closed forms."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.stats import multivariate_normal

from cosim.gap.scatter import SCATTER_ASKED, averaged_over
from cosim.gap.windows.fitted import Fitted, Information

#: Friction of six runs in parts, the standard deviation to which each is seen, and what a fit has
#: let friction scatter by.
SEEN, ASSUMED, EXPECTED = 2e-3, 0.045, 0.02
LOADS = np.array([-1.0, -0.6, -0.2, 0.2, 0.6, 1.0])


def regressed(friction, trend, assumed=ASSUMED):
    """The fit of a level, of a trend over the loads or of none, and of the runs' own friction."""
    shared = np.column_stack([np.ones_like(LOADS), LOADS][: 1 + trend])
    columns = np.hstack([shared, assumed * np.eye(LOADS.size)]) / SEEN
    prior = np.hstack([np.zeros_like(shared[:, :0]), np.zeros((LOADS.size, shared.shape[1]))])
    rows = np.vstack([columns, np.hstack([prior, np.eye(LOADS.size)])])
    data = np.concatenate([friction / SEEN, np.zeros(LOADS.size)])
    found = np.linalg.lstsq(rows, data, rcond=None)[0]
    names = ["level", "trend"][: 1 + trend]
    labels = (*names, *(f"offset.friction@run{n}" for n in range(LOADS.size)))
    values = dict(zip(labels, found, strict=True))
    for label in labels[len(names) :]:
        values[label] *= assumed
    run = SimpleNamespace(residuals=np.ones(3), states=np.zeros((1, 6)))
    known = Information(labels, np.linalg.qr(rows, mode="r"))
    cost = float(np.sum((rows @ found - data) ** 2))
    return Fitted(values, {}, {}, (run,), cost, known=(known,))


def exactly(friction, trend, scatter):
    """ln of how probable the runs are, the level and the trend as they are then."""
    shared = np.column_stack([np.ones_like(LOADS), LOADS][: 1 + trend])
    left = friction - shared @ np.linalg.lstsq(shared, friction, rcond=None)[0]
    return multivariate_normal.logpdf(left, cov=(scatter**2 + SEEN**2) * np.eye(LOADS.size))


@pytest.mark.parametrize("trend", [False, True])
@pytest.mark.parametrize("assumed", [0.03, 0.09])
def test_shared_numbers_follow_where_less_scatter_is_allowed(trend, assumed):
    friction = 0.06 * LOADS + SEEN * np.array([0.3, -1.1, 0.6, 0.2, -0.4, 0.9])
    fitted = regressed(friction, trend, assumed)
    asked = np.array(SCATTER_ASKED)
    weights = np.exp(-0.5 * (asked / EXPECTED) ** 2)
    densities = np.array([exactly(friction, trend, one) for one in asked])
    average = np.log(np.sum(weights * np.exp(densities)) / weights.sum())
    off = average - exactly(friction, trend, assumed)
    assert averaged_over(fitted, assumed, EXPECTED) == pytest.approx(off, abs=1e-6)


def test_a_trend_that_scatter_has_half_taken_up_is_worth_what_all_of_it_is():
    friction = 0.06 * LOADS
    without, found = (regressed(friction, trend) for trend in (False, True))
    gain = found.gain_over(without)
    gain += averaged_over(found, ASSUMED, EXPECTED) - averaged_over(without, ASSUMED, EXPECTED)
    assert found.gain_over(without) < 6.0 < 12.0 < gain
