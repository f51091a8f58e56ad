"""The belt-length study against coupled runs of the FMU, and as a command on a scenario."""

import json
from dataclasses import replace

import numpy as np
import pytest
from command_line import stickslip_here

from cosim import Scenario, run_scenario
from cosim.studies.belt_length import Case, Protocol, scenario_case
from cosim.studies.belt_length.drift import drift, friction_effect, linear_sensitivity, run_drift

#: A run begins with a stick that makes no heat: 1 % of the heat; the estimate spreads it evenly.
AS_CLOSE_AS_A_CYCLE = 0.03
#: Break-aways are seen on the macro steps of 10 ms: over 6 s that is 0.3 % of a frequency.
MACRO_STEP = 0.01
RUN = 20.0
AMBIENT = -8.0


def scenario(case, **tables):
    """The rig of a case along x, 15 W/m2K to the air."""
    own = dict(
        name="belt", rig={"mass": case.mass, "degrees_of_freedom": ["x"]},
        springs={"stiffness": case.stiffness}, surface={"speed": case.speed},
        friction={"mu_s": case.static_over_kinetic * case.friction, "mu_k": case.friction},
        belt={"length": case.length, "air_heat_transfer": 15.0},
        run={"duration": RUN}, coupling={"macro_step": MACRO_STEP},
    )  # fmt: skip
    return Scenario.from_tables(own | tables)


def coupled(case, fmu):
    """A run of 20 s with friction that feels the temperature."""
    feels = {"sensitivity": linear_sensitivity(case.ambient_degC)}
    return run_scenario(
        scenario(case, initial={"vx": case.speed}, temperature_dependence=feels), fmu=fmu
    ).result


def over_a_cycle(result, name, period):
    """Mean rise in the last stick-slip cycle, K.

    Heat is made in slips alone: the interface swings with them, and the belt comes round in stripes
    that are a tenth warmer or colder than their mean.
    """
    last = result.time > result.time[-1] - period
    return np.mean(result[f"thermal.{name}_temperature"][last]) - AMBIENT


@pytest.mark.parametrize("speed", [0.15, pytest.param(0.82, marks=pytest.mark.slow)])
def test_quasi_steady_estimate_is_what_a_coupled_run_shows(fmu, speed):
    # at 1 m and 0.15 m/s the 20 s end just as the trace of a loop arrives
    case = Case(1.2, speed, h=15.0, protocol=Protocol(ramp=0.0))
    estimate, result = friction_effect(case), coupled(case, fmu)
    rises = [
        over_a_cycle(result, name, 1.0 / estimate.frequency) for name in ("belt_entry", "interface")
    ]
    assert rises == pytest.approx([estimate.drift, estimate.interface], rel=AS_CLOSE_AS_A_CYCLE)
    starts = result.time[1:][np.diff(result["mechanics.slip_count"]) > 0]
    late = starts[starts > 0.7 * RUN]
    frequency = (late.size - 1) / (late[-1] - late[0])
    seen = frequency / estimate.frequency - 1.0
    assert seen == pytest.approx(
        estimate.frequency_change, abs=2.0 * MACRO_STEP / (late[-1] - late[0])
    )


def ramped(case, belt, ramp=10.0, run=20.0):
    """A scenario of a ramp and a run at constant speed, s."""
    return scenario(
        case, belt={"length": case.length, "air_heat_transfer": 15.0} | belt,
        surface={"speed": case.speed, "run_up_time": ramp}, run={"duration": ramp + run},
    )  # fmt: skip


@pytest.mark.parametrize("speed", [pytest.param(0.15, marks=pytest.mark.slow), 0.82])
def test_the_drift_of_a_ramped_scenario_is_what_its_coupled_run_shows(fmu, speed):
    """Railing heat and rollers and all; the ramp begins with sticks, the run ends in a cycle."""
    case = Case(1.2, speed)
    belt = {
        "railing_length": 0.08, "railing_friction": 0.1, "railing_conductance": 15.0, "rollers": 2,
        "roller_conductance": 100.0, "roller_rise": 0.1,
    }  # fmt: skip
    given = ramped(case, belt, 5.0, 10.0)
    result = run_scenario(given, fmu=fmu).result
    own = scenario_case(given)
    period = 1.0 / friction_effect(own, 0.0).frequency
    entry = over_a_cycle(result, "belt_entry", period)
    assert entry == pytest.approx(run_drift(own), rel=AS_CLOSE_AS_A_CYCLE)
    rubbed = 0.5 * 0.1 * case.mass * 9.81 * result["mechanics.surface_travel"][-1]
    assert result["thermal.railing_heat"][-1] == pytest.approx(rubbed, rel=1e-9)
    residual = np.abs(result["thermal.heat_residual"]).max()
    assert residual < 1e-9 * result["thermal.heat_received"][-1]


def test_the_command_answers_both_questions_for_a_scenario(tmp_path):
    file = tmp_path / "rig.toml"
    file.write_text(ramped(Case(1.0, 0.15), {}).to_toml(), encoding="utf-8")
    words = "--length 1 2 --samples 0 --map 0 --jobs 1 --json -o".split()
    done = stickslip_here(tmp_path, "belt-length", file, *words, "out")
    assert done.returncode == 0, done.stderr
    numbers = json.loads(done.stdout)
    assert numbers["protocol"]["ramp"] == 10.0 and numbers["protocol"]["run"] == 20.0
    short, long = (case["questions"] for case in numbers["cases"])
    cold, steady = short["comes_round_cold"], short["interface_steady"]
    assert cold["rise"] == pytest.approx(0.082, rel=0.05) and cold["answer"] is False
    assert cold["shortest_belt"] == pytest.approx(1.2, rel=0.05)
    assert steady["rise_at_constant_speed"] > steady["endless_belt"] > 0.0
    assert steady["answer"] is False and long["comes_round_cold"]["answer"] is True
    expected = drift(replace(Case(1.0, 0.15), h=15.0))
    assert steady["rise"] == pytest.approx(expected.interface_run, rel=1e-6)
    assert numbers["cases"][0]["wait"]["begin"] > 1.0
    assert len(numbers["cases"][0]["changes"]) > 10
