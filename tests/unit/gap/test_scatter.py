"""A scatter of friction that simulated runs are averaged over, against closed forms."""

from itertools import product
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.stats import multivariate_normal

from cosim.gap.scatter import SCATTER_ASKED, ZERO_PARTS_ASKED, averaged_over
from cosim.gap.windows.fitted import Fitted, Information

#: Friction of six runs in parts, the standard deviation to which each is seen, what a fit has let
#: friction scatter by, what is expected of that, and what a zero within its stated error does.
SEEN, ASSUMED, EXPECTED, ZERO = 2e-3, 0.045, 0.02, 0.01
LOADS = np.array([-1.0, -0.6, -0.2, 0.2, 0.6, 1.0])
OBSERVED = 0.06 * LOADS + SEEN * np.array([0.3, -1.1, 0.6, 0.2, -0.4, 0.9])


def regressed(friction, trend, assumed=ASSUMED):
    """The fit of a level, of a trend over the loads or of none, and of the runs' own numbers."""
    shared = np.column_stack([np.ones_like(LOADS), LOADS][: 1 + trend])
    sizes = {"offset.friction": assumed, "offset.x": ZERO}
    kinds = [kind for kind, size in sizes.items() if size]
    own = np.hstack([sizes[kind] * np.eye(LOADS.size) for kind in kinds])
    prior = np.hstack([np.zeros((own.shape[1], shared.shape[1])), np.eye(own.shape[1])])
    rows = np.vstack([np.hstack([shared, own]) / SEEN, prior])
    data = np.concatenate([friction / SEEN, np.zeros(own.shape[1])])
    found = np.linalg.lstsq(rows, data, rcond=None)[0]
    names = ["level", "trend"][: 1 + trend]
    labels = (*names, *(f"{kind}@run{n}" for kind in kinds for n in range(LOADS.size)))
    run = SimpleNamespace(residuals=np.ones(3), states=np.zeros((1, 6)))
    known = Information(labels, found, np.linalg.qr(rows, mode="r"))
    cost = float(np.sum((rows @ found - data) ** 2))
    return Fitted({}, {}, {}, (run,), cost, known=(known,))


def exactly(trend, scatter, zeros):
    """ln of how probable the runs are, the level and the trend as they are then."""
    shared = np.column_stack([np.ones_like(LOADS), LOADS][: 1 + trend])
    left = OBSERVED - shared @ np.linalg.lstsq(shared, OBSERVED, rcond=None)[0]
    variance = scatter**2 + (zeros * ZERO) ** 2 + SEEN**2
    return multivariate_normal.logpdf(left, cov=variance * np.eye(LOADS.size))


@pytest.mark.parametrize("trend", [False, True])
@pytest.mark.parametrize("assumed", [0.0, 0.03, 0.09])
def test_shared_numbers_follow_where_less_scatter_is_allowed(trend, assumed):
    asked = list(product(SCATTER_ASKED if assumed else (0.0,), ZERO_PARTS_ASKED))
    weights = np.exp([-0.5 * (scatter / EXPECTED) ** 2 for scatter, _ in asked])
    average = np.average(np.exp([exactly(trend, *one) for one in asked]), weights=weights)
    off = np.log(average) - exactly(trend, assumed, 1.0)
    found = averaged_over(regressed(OBSERVED, trend, assumed), assumed, EXPECTED)
    assert found == pytest.approx(off, abs=1e-6)


def test_a_trend_that_scatter_has_half_taken_up_is_worth_what_all_of_it_is():
    without, found = (regressed(0.06 * LOADS, trend) for trend in (False, True))
    gain = found.gain_over(without)
    gain += averaged_over(found, ASSUMED, EXPECTED) - averaged_over(without, ASSUMED, EXPECTED)
    assert found.gain_over(without) < 6.0 < 12.0 < gain
