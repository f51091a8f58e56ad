"""How warm steady sliding gets, and when."""

import pytest

from thermal import Ambient, Belt, Ice, SteadySliding, ThermalParameters
from thermal.steady_sliding import in_the_end

RIG = ThermalParameters(belt=Belt(length=1.0))


def test_the_end_is_the_steady_state_and_is_reached_when_it_is_said():
    found = in_the_end(RIG, 0.15, 1.4, 10.0)
    sliding = SteadySliding(RIG, 0.15, 1.4)
    sliding.ramp(10.0)
    then = sliding.run(found.reached - 10.0).mean_interface
    ended = sliding.settle().mean_interface
    # fewer waves, longer steps, and looks half as far apart as the time: 2 % of the rise
    assert found.rise == pytest.approx(ended, rel=5e-3)
    assert then == pytest.approx((1.0 - found.within) * ended, rel=0.02)


def test_a_block_that_melts_has_no_end_and_one_of_steel_has():
    hot = RIG.model_copy(update={"ambient": Ambient(temperature_degC=-0.05)})
    assert in_the_end(hot, 0.82, 4.0, 10.0).rise is None
    steel = hot.model_copy(update={"ice": Ice(material="steel")})
    assert in_the_end(steel, 0.82, 4.0, 10.0).rise > 0.05
