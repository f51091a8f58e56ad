"""The quasi-steady estimates of the belt-length study against coupled runs of the FMU."""

import numpy as np
import pytest

from cosim import Scenario, run_scenario
from cosim.studies.belt_length import Case, friction_effect
from cosim.studies.belt_length.drift import RUN
from cosim.studies.belt_length.friction_effect import (
    STATIC_OVER_KINETIC,
    STIFFNESS,
    linear_sensitivity,
)

#: A run ends somewhere in a stick-slip cycle, and begins with a stick that makes no heat: 1 % of
#: the heat; the estimate spreads both evenly.
AS_CLOSE_AS_A_CYCLE = 0.06
#: Break-aways are seen on the macro steps of 10 ms: over 6 s that is 0.3 % of a frequency.
MACRO_STEP = 0.01


def coupled(case, fmu):
    """A run of 20 s along x with friction that feels the temperature."""
    tables = {
        "name": "belt", "rig": {"mass": case.mass, "degrees_of_freedom": ["x"]},
        "springs": {"stiffness": STIFFNESS}, "initial": {"vx": case.speed},
        "friction": {"mu_s": STATIC_OVER_KINETIC * case.friction, "mu_k": case.friction},
        "surface": {"speed": case.speed}, "belt": {"length": case.length},
        "temperature_dependence": {"sensitivity": linear_sensitivity(case.ambient_degC)},
        "run": {"duration": RUN}, "coupling": {"macro_step": MACRO_STEP},
    }
    return run_scenario(Scenario.from_tables(tables), fmu=fmu).result


@pytest.mark.parametrize("speed", [0.15, 0.82])
def test_quasi_steady_estimate_is_what_a_coupled_run_shows(fmu, speed):
    case = Case(1.2, speed)  # at 1 m and 0.15 m/s the 20 s end just as the trace of a loop arrives
    estimate, result = friction_effect(case), coupled(case, fmu)
    rises = [result[f"thermal.{name}_temperature"][-1] - case.ambient_degC
             for name in ("belt_entry", "interface")]
    # within a cycle the interface swings with the sliding speed, so it is looked at over one
    last = result.time > RUN - 1.0 / estimate.frequency
    rises[1] = np.mean(result["thermal.interface_temperature"][last]) - case.ambient_degC
    assert rises == pytest.approx(
        [estimate.drift, estimate.interface], rel=AS_CLOSE_AS_A_CYCLE)
    starts = result.time[1:][np.diff(result["mechanics.slip_count"]) > 0]
    late = starts[starts > 0.7 * RUN]
    frequency = (late.size - 1) / (late[-1] - late[0])
    seen = frequency / estimate.frequency - 1.0
    assert seen == pytest.approx(
        estimate.frequency_change, abs=2.0 * MACRO_STEP / (late[-1] - late[0]))
