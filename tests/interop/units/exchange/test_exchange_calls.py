"""Model exchange: states, rates, inputs and parameters, and what is refused."""

from ctypes import byref, c_double, c_uint

import fmpy
import numpy as np
import pytest
from c_unit import Unit
from fmpy import simulate_fmu
from fmpy.fmi2 import fmi2EventInfo
from plain_start import values
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


COUNT = len(states())


class Host:
    """An instance in event mode, and a host of the plainest kind."""

    def __init__(self, block, start=0.0, **starts):
        self.block, self.done = block, block.done
        block.begin(start, **starts)

    def update(self):
        """What there is to be told of the next event."""
        info = fmi2EventInfo()
        self.done("NewDiscreteStates", byref(info))
        return info

    def numbers(self, function):
        kept = (c_double * COUNT)()
        self.done(function, kept, COUNT)
        return np.array(kept)

    def x(self):
        return self.numbers("GetContinuousStates")

    def rates(self, time, x):
        self.done("SetTime", time)
        self.done("SetContinuousStates", (c_double * COUNT)(*x), COUNT)
        return self.numbers("GetDerivatives")

    def along(self, unknowns, knowns, seed):
        """The directional derivative of some variables."""
        places, found = self.block.unit.references, (c_double * len(unknowns))()
        of, to = ((c_uint * len(each))(*map(places.get, each)) for each in (unknowns, knowns))
        seed = (c_double * len(seed))(*seed)
        given = (of, len(unknowns), to, len(knowns), seed, found)
        self.done("GetDirectionalDerivative", *given)
        return list(found)


@pytest.fixture
def host(fmu, tmp_path):
    """Makes one, which is freed at the end of the test."""
    unit, made = Unit(fmu, tmp_path), []
    unit.references = {v.name: at for at, v in enumerate(variables()) if not v.is_boolean}

    def make(tables=None, start=0.0, **starts):
        made.append(unit.instance(exchanges=True))
        return Host(made[-1], start, **{**values(tables or {}), **starts})

    yield make
    for each in made:
        each.__exit__()


@pytest.fixture
def running(host):
    """In continuous-time mode."""
    one = host()
    one.update()
    one.done("EnterContinuousTimeMode")
    return one


def test_rates_are_those_of_the_variables(running):
    get = running.block.get
    for name in ("x", "omega", "heat", "slip_time", "thermal_weakening.recent_heat"):
        place = [each.name for each in states()].index(name)
        assert get(name) == running.x()[place]
        assert get(f"der({name})") == running.rates(0.0, running.x())[place]
    assert get("heat_flow") == get("der(heat)")


def test_within_a_step_too_rates_are_those_of_the_variables(host):
    """A stick follows a surface whose speed the host changes, before any step is accepted."""
    one = host(**{"surface_speed": 0.1, "initial.vx": 0.1})
    one.update()
    one.done("EnterContinuousTimeMode")
    place = [each.name for each in states()].index("vx")
    x = one.x()
    for time in (1e-3, 2e-3, 1.5e-3):
        one.done("SetTime", time)
        one.block.set("surface_speed", 0.1 + 0.3 * time + 20.0 * time**2)
        rate = one.rates(time, x)[place]
        assert one.block.get("mode") == 0 and one.block.get("der(vx)") == rate


def test_start_time_is_no_part_of_the_motion(host):
    told = []
    for start in (0.0, 100.0):
        one = host({"surface": {"run_up_time": 0.5}}, start)
        event = one.update().nextEventTime - start
        one.done("EnterContinuousTimeMode")
        told.append((event, *one.rates(start + 0.25, one.x())))
    assert told[0] == told[1] and told[0][0] == 0.5


def test_directional_derivatives_are_those_of_the_springs(running):
    """On a line in slip: springs for x, friction for nothing, and each force its mass."""
    knowns = ["x", "vx", "external_force_x"]
    unknowns = ["der(vx)", "der(x)", "x", "mode", "der(external_work)"]
    mass, vx = Parameters().rig.mass, running.block.get("vx")
    step, x = 1e-4, running.x()
    stiffness = [running.rates(0.0, x + sign * step * np.eye(COUNT)[0])[3] for sign in (1, -1)]
    running.rates(0.0, x)
    before = running.block.everything()
    along_x = running.along(unknowns, knowns, [1.0, 0.0, 0.0])
    assert along_x[0] == pytest.approx((stiffness[0] - stiffness[1]) / (2 * step), rel=1e-5)
    assert along_x[1:] == pytest.approx([0.0, 1.0, 0.0, 0.0], abs=1e-9)
    along_v = running.along(unknowns, knowns, [0.0, 2.0, 0.0])
    assert along_v[:3] == pytest.approx([0.0, 2.0, 0.0], abs=1e-8)
    along_force = running.along(unknowns, knowns, [0.0, 0.0, 1.0])
    assert along_force == pytest.approx([1.0 / mass, 0.0, 0.0, 0.0, vx], abs=1e-8)
    assert running.block.everything() == before
    with pytest.raises(AssertionError, match="with respect to states and inputs"):
        running.along(unknowns, ["rig.mass"], [1.0])


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
        str(fmu), fmi_type="ModelExchange", relative_tolerance=1e-8, stop_time=1.5,
        output_interval=0.01, start_values=at_rest, input=force, output=["mode", "external_work"],
    )  # fmt: skip
    first = int(np.flatnonzero(np.diff(result["mode"]))[0]) + 1
    assert result["mode"][first] == 1 and result["time"][first] == pytest.approx(1.0, abs=1e-9)


def test_a_tunable_parameter_changes_in_event_mode_only(host, running):
    refused = running.block.set_arguments("friction.mu_s", 0.01)
    assert "enter event mode" in running.block.reason(*refused)
    one = host({"surface": {"run_up_time": 0.0}, "initial": {"vx": 0.15}})
    one.update()
    assert one.block.get("mode") == 0
    for name, value in (("friction.mu_s", 1e-9), ("friction.mu_k", 1e-9), ("external_force_x", 1)):
        one.block.set(name, value)
    one.update()
    assert (one.block.get("mode"), one.block.get("slip_count")) == (1, 1)
