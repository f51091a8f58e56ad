"""What derivatives at a fitted model promise of an effect is what a fit with it gains."""

import numpy as np
import pytest
from test_windows import measured

from cosim.gap.windows import Number, fit, user_model, windows_of_campaign
from cosim.gap.windows.score_test import ScoreTest

DRAG = Number("film_drag.coefficient", 0.3, None, 0.0, 5.0)
FALL = Number("velocity_weakening.linear", 0.3, None, 0.0, 5.0)


@pytest.fixture(scope="module")
def tested(tmp_path_factory):
    """Of a campaign with some effects: that, its user's model and the test beside it."""

    def of(name, **blocks):
        campaign = measured(tmp_path_factory.mktemp(name), **blocks)
        windows, (numbers, settings) = windows_of_campaign(campaign), user_model(campaign)
        found = fit(campaign, windows, numbers, settings)
        test = ScoreTest.at(campaign, windows, numbers, settings, found)

        def gained(more):
            with_it = fit(campaign, windows, [*numbers, more], settings, near=found)
            fitted, before = (one.cost - one.held_out_cost for one in (with_it, found))
            return 0.5 * (before - fitted) / max(found.misfit, 1.0)

        return test, gained

    return of


@pytest.mark.parametrize("size", [0.1, 0.3])
def test_a_promise_is_kept(tested, size):
    """To first order."""
    test, gained = tested("drag", film_drag={"coefficient": size})
    promised = test.promised([DRAG], {}, {})
    assert promised == pytest.approx(gained(DRAG), rel=0.1)
    assert promised > 25.0
    assert test.promised([FALL], {}, {}) == 0.0  # it would have to grow


def test_nothing_is_promised_where_nothing_is_hidden(tested):
    test, _ = tested("plain")
    assert max(test.promised([one], {}, {}) for one in (DRAG, FALL)) < 5.0
    length = Number("run_in.distance", 1.0, None, 0.1, 10.0)
    assert test.promised([length], {}, {}) is None  # nothing says how large


def test_a_promise_does_not_hang_on_the_size_that_is_tried(tested):
    test, _ = tested("tried", film_drag={"coefficient": 0.05})
    sizes = [1e-3, 0.3, 30.0]
    tried = [test.promised([Number(DRAG.key, size, None, 0.0, 99.0)], {}, {}) for size in sizes]
    assert np.ptp(tried) < 0.05 * tried[1]
