"""Model exchange: states, rates, inputs and parameters, and what is refused."""

import fmpy
import numpy as np
import pytest
from exchange_host import (
    SPEED,
    changes,
    hosted,
    values,
)
from fmpy import simulate_fmu
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2Error
from stickslip import Parameters

from cosim.fmu.exchange import states, variables
from cosim.fmu.variables import variables as variables_without

# --- states, rates, description ---


def test_description(fmu):
    description = fmpy.read_model_description(str(fmu), validate_model_structure=True)
    exchange = description.modelExchange
    assert exchange.modelIdentifier == description.coSimulation.modelIdentifier
    assert exchange.canGetAndSetFMUstate and exchange.canSerializeFMUstate
    assert exchange.needsCompletedIntegratorStep
    declared = description.modelVariables
    of_states = [each for each in declared if each.derivative is not None]
    assert [each.derivative.name for each in of_states] == [each.name for each in states()]
    assert [each.variable for each in description.derivatives] == of_states
    # what has been there before stands where it stood
    before = [each.name for each in variables_without()]
    assert [each.name for each in declared[: len(before)]] == before
    assert {each.causality for each in declared[len(before) :]} == {"local"}
    assert len(declared) == len(variables())


def test_rates_are_those_of_the_variables(host):
    host.begin()
    for name in ("x", "omega", "heat", "slip_time", "thermal_weakening.recent_heat"):
        place = [each.name for each in states()].index(name)
        assert host.get(name) == host.x()[place]
        assert host.get(f"der({name})") == host.rates(0.0, host.x())[place]
    assert host.get("heat_flow") == host.get("der(heat)")


def test_start_time_is_no_part_of_the_motion(fmu, tmp_path):
    tables = {"surface": {"run_up_time": 0.5}}
    told = []
    for start in (0.0, 100.0):
        with hosted(fmu, tmp_path, tables) as host:
            told.append((host.begin(start)[5] - start, *host.rates(start + 0.25, host.x())))
    assert told[0] == told[1] and told[0][0] == 0.5


def test_directional_derivatives_are_those_of_the_springs(host):
    """On a line in slip: springs for x, friction for nothing, and each force its mass."""
    host.begin()
    knowns = ["x", "vx", "external_force_x"]
    unknowns = ["der(vx)", "der(x)", "x", "mode", "der(external_work)"]
    places = [[host.variables[name].valueReference for name in of] for of in (unknowns, knowns)]
    parameters = Parameters()
    ask = host.unit.getDirectionalDerivative
    mass, vx = parameters.rig.mass, host.get("vx")
    step = 1e-4
    x = host.x()
    stiffness = [host.rates(0.0, x + sign * step * np.eye(len(x))[0])[3] for sign in (1, -1)]
    host.be_at(0.0, x)
    before = host.everything()
    along_x = ask(*places, [1.0, 0.0, 0.0])
    assert along_x[0] == pytest.approx((stiffness[0] - stiffness[1]) / (2 * step), rel=1e-5)
    assert along_x[1:] == pytest.approx([0.0, 1.0, 0.0, 0.0], abs=1e-9)
    assert ask(*places, [0.0, 2.0, 0.0])[:3] == pytest.approx([0.0, 2.0, 0.0], abs=1e-8)
    along_force = ask(*places, [0.0, 0.0, 1.0])
    assert along_force == pytest.approx([1.0 / mass, 0.0, 0.0, 0.0, vx], abs=1e-8)
    assert host.everything() == before
    refused(ask, *places[:1], [host.variables["rig.mass"].valueReference], [1.0])


# --- inputs and parameters ---


def test_a_force_that_grows_with_time_breaks_the_block_away(fmu):
    """Between events, too: the indicator follows the input of the moment."""
    at_rest = values({"surface": {"speed": 0.0}, "initial": {"vx": 0.0}})
    parameters = Parameters()
    limit = parameters.friction.mu_s * parameters.rig.mass * 9.81
    force = np.array(
        [(0.0, 0.0), (2.0, 2.0 * limit)], dtype=[("time", float), ("external_force_x", float)]
    )
    result = simulate_fmu(
        str(fmu),
        fmi_type="ModelExchange",
        relative_tolerance=1e-8,
        stop_time=1.5,
        output_interval=0.01,
        start_values=at_rest,
        input=force,
        output=["mode", "external_work"],
    )
    times, modes = changes(result)
    assert modes[0] == 1 and times[0] == pytest.approx(1.0, abs=1e-9)


def test_a_tunable_parameter_changes_in_event_mode_only(host):
    host.begin()
    refused(host.put, "friction.mu_s", 0.01)
    assert "enter event mode" in host.log.take_errors()
    host.unit.reset()
    host.put("surface_speed", SPEED)
    host.put("initial.vx", SPEED)
    host.put("surface.run_up_time", 0.0)
    host.initialise()
    host.unit.newDiscreteStates()
    assert host.get("mode") == 0
    host.put("friction.mu_s", 1e-9)
    host.put("friction.mu_k", 1e-9)
    host.put("external_force_x", 1.0)
    host.unit.newDiscreteStates()
    assert (host.get("mode"), host.get("slip_count")) == (1, 1)


# --- refusals ---


def refused(call, *arguments):
    """The call must return fmi2Error."""
    with pytest.raises(FMICallException) as caught:
        call(*arguments)
    assert caught.value.status == fmi2Error
