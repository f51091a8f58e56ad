"""Model exchange: a host's integrator and events against the model's own, which are exact.

A host's tolerance is that of one step, of each state by its nominal. Some hundred steps make a slip
and some ten slips a run, each of which begins and ends where the error of the one before has put
it: an event is late by about a thousand tolerances, in the time of the motion itself, 0.1 s and
more. That is what the bounds below say, with what the model itself leaves open where a contact
in the plane comes to rest (`rest_speed` over mu g, some 1e-7 s).
"""

import ctypes
import math
from contextlib import contextmanager

import fmpy
import numpy as np
import pytest
from fmpy import simulate_fmu
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Model, FMU2Slave, fmi2Error
from fmpy.validation import validate_fmu
from scipy.integrate import solve_ivp
from stickslip import Parameters, simulate

from cosim.coupling.fmu.log import FmuLog
from cosim.fmu.exchange import states, variables
from cosim.fmu.variables import variables as variables_without

SPEED = 0.15
SLOW = {"surface": {"speed": 0.03}, "initial": {"vx": 0.03}}
PLANE = {"lateral_friction": {"ratio": 1.0}}
CASES = {
    "line": {},
    "plane": {**PLANE, "initial": {"phi": 0.05, "y": 0.005}, "surface": {"speed": 0.05}},
    "slab": {**PLANE, "turning_surface": {"curvature": 1.0}},
    "static_strengthening": {"static_strengthening": {"rate": 0.02}},
    "thermal_weakening": {"thermal_weakening": {"per_joule": 0.4}},
    "damping and velocity_weakening": {
        "structural_damping": {"coefficient": 0.5},
        "velocity_weakening": {"linear": 0.3},
    },
    "stick_creep": {**SLOW, "friction": {"stick_creep": 4e-3}},
    "stick_creep in the plane": {
        **PLANE,
        "surface": {"speed": 0.03},
        "initial": {"vx": 0.03, "phi": 0.05, "y": 0.005},
        "friction": {"stick_creep": 4e-3},
    },
    "transition_speed": {"friction": {"transition_speed": 5e-3}},
    "bristles": {
        "surface": {"speed": 0.03},
        "friction": {"transition_speed": 5e-3, "presliding_distance": 1e-4},
    },
    "run-up": {"surface": {"speed": 0.05, "run_up_time": 0.9}},
    "speed_ripple": {"speed_ripple": {"amplitude": 0.05}},
}
TOLERANCES = (1e-4, 1e-6, 1e-8, 1e-10)
DURATION = 5.0  # s
EVENTS = 10  # that are compared
# Of the steepest cases the events move more: bristles give way the faster the faster they slide,
# and from mu_s a slip departs at a rate that grows from nothing.
SENSITIVE = {"bristles": 100.0, "transition_speed": 10.0}


def values(tables):
    """Start values by the FMU's names."""
    parameters = Parameters(**tables)
    return {**parameters.flat(), "surface_speed": parameters.surface.speed}


def exchanged(fmu, tables, tolerance, **more):
    options = {
        "stop_time": DURATION,
        "output_interval": 0.01,
        "record_events": True,
        "output": ["mode", "slip_count", "energy_residual", "x", "heat", "slip_time"],
    }
    return simulate_fmu(
        str(fmu),
        fmi_type="ModelExchange",
        relative_tolerance=tolerance,
        start_values=values(tables),
        **(options | more),
    )


def changes(result):
    """Times at which the mode changes, and the modes from there on."""
    at = np.flatnonzero(np.diff(result["mode"])) + 1
    return result["time"][at], result["mode"][at]


CREEPING = {
    "default": {"surface": {"speed": 0.05}},
    "slow and stiff": {
        "surface": {"speed": 1e-3},
        "initial": {"vx": 1e-3},
        "springs": {"stiffness": 300.0},
    },
    "plane": {**PLANE, "surface": {"speed": 0.05}, "initial": {"y": 0.005, "phi": 0.05}},
}


@pytest.mark.parametrize("case", CREEPING)
@pytest.mark.parametrize("tolerance", [1e-4, 1e-6])
def test_a_slip_that_creeps_at_first_is_not_begun_again_at_every_step(fmu, case, tolerance):
    """Friction follows speed and age of the contact: a slip begins at speeds far below a coarse
    tolerance. What a host makes of them costs some events, and there is an end of them."""
    law = {"rate_and_state": {"direct": 0.01, "evolution": 0.03}}
    tables = {**law, **CREEPING[case]}
    own = simulate(Parameters(**tables), duration=DURATION).events
    found = exchanged(fmu, tables, tolerance, timeout=100.0)
    assert found["time"][-1] == DURATION
    assert found["slip_count"][-1] == np.count_nonzero(own[:, 1] == 1.0) > 0
    assert len(found) - DURATION / 0.01 < 2000


@pytest.mark.parametrize("case", CASES)
def test_events_converge_to_the_models_own(fmu, case):
    tables = CASES[case]
    tight = {**tables, "solver": {"tolerance": 1e-12}}
    own = simulate(Parameters(**tight), duration=DURATION)
    expected = own.events[:EVENTS]
    assert len(expected) >= 6
    print(f"\n{case}")
    for tolerance in TOLERANCES:
        result = exchanged(fmu, tables, tolerance)
        times, modes = changes(result)
        assert list(modes[: len(expected)]) == list(expected[:, 1])
        late = np.abs(times[: len(expected)] - expected[:, 0])
        residual = np.abs(result["energy_residual"]).max()
        print(
            f"{tolerance:7.0e} s: first {late[0]:.1e} last {late[-1]:.1e} most {late.max():.1e}, "
            f"residual {residual:.1e} J, slips {result['slip_count'][-1]}"
        )
        bound = 100.0 * SENSITIVE.get(case, 1.0) * tolerance + 5e-7
        assert late.max() < bound, tolerance
        assert residual < 500.0 * tolerance  # J; heat and works are some joules, of as many steps
    assert result["slip_count"][-1] == own["slip_count"][-1]
    assert result["slip_time"][-1] == pytest.approx(own["slip_time"][-1], abs=1e-6)
    assert result["x"][-1] == pytest.approx(own["x"][-1], abs=1e-6)


SLAB = {"lateral_friction.ratio": 1.0, "turning_surface.curvature": 0.3}
TURNED = {"lateral_friction.ratio": 1.0, "initial.phi": 0.1, "surface_speed": 0.05}
BESIDE = {
    "guided slab, never at rest": {**SLAB, "rig.free_y": 0, "rig.free_phi": 0},
    "guided across": {**TURNED, "initial.vx": 0.05, "rig.free_y": 0},
    "guided on a line": {**TURNED, "rig.free_y": 0, "rig.free_phi": 0},
    "stick_stiffness": {"stick_stiffness.ratio": 0.5},
    "no friction": {"friction.mu_s": 0.0, "friction.mu_k": 0.0, "initial.x": 0.05},
    "mu_k = mu_s": {**TURNED, "friction.mu_s": 0.05, "friction.mu_k": 0.05},
    "surface at rest": {"surface_speed": 0.0, "initial.vx": 0.1, "initial.x": 0.1},
}


@pytest.mark.parametrize("case", BESIDE)
def test_special_contacts_move_as_in_co_simulation(fmu, case):
    common = {
        "stop_time": 4.0,
        "output_interval": 0.01,
        "start_values": {**values({}), **BESIDE[case]},
        "output": ["x", "y", "phi", "slip_count", "slip_time"],
    }
    result = simulate_fmu(
        str(fmu), fmi_type="ModelExchange", relative_tolerance=1e-8, record_events=False, **common
    )
    own = simulate_fmu(str(fmu), fmi_type="CoSimulation", **common)
    for name in ("x", "y", "phi", "slip_time"):
        assert np.abs(result[name] - own[name]).max() < 5e-6, name
    assert (result["slip_count"] == own["slip_count"]).all()


# --- other methods ---


class Host:
    """An instance for model exchange, and a host of the plainest kind."""

    def __init__(self, fmu, directory, log, **starts):
        self.description = fmpy.read_model_description(str(fmu))
        self.variables = {each.name: each for each in self.description.modelVariables}
        self.log = log
        self.unit = FMU2Model(
            guid=self.description.guid,
            unzipDirectory=str(fmpy.extract(str(fmu), unzipdir=str(directory))),
            modelIdentifier=self.description.modelExchange.modelIdentifier,
        )
        self.unit.instantiate(callbacks=log.callbacks, loggingOn=True)
        self.states = self.description.numberOfContinuousStates
        self.indicators = self.description.numberOfEventIndicators
        for name, value in starts.items():
            self.put(name, value)

    def initialise(self, start=0.0):
        self.unit.setupExperiment(startTime=start)
        self.unit.enterInitializationMode()
        self.unit.exitInitializationMode()

    def begin(self, start=0.0):
        self.initialise(start)
        told = self.unit.newDiscreteStates()
        self.unit.enterContinuousTimeMode()
        return told

    def put(self, name, value):
        each = self.variables[name]
        if each.type == "Real":
            self.unit.setReal([each.valueReference], [value])
        else:
            self.unit.setInteger([each.valueReference], [int(value)])

    def get(self, name):
        each = self.variables[name]
        read = self.unit.getReal if each.type == "Real" else self.unit.getInteger
        return read([each.valueReference])[0]

    def numbers(self, call, count):
        kept = (ctypes.c_double * count)()
        call(kept, count)
        return np.array(kept)

    def x(self):
        return self.numbers(self.unit.getContinuousStates, self.states)

    def be_at(self, time, x):
        self.unit.setTime(time)
        self.unit.setContinuousStates((ctypes.c_double * self.states)(*x), self.states)

    def rates(self, time, x):
        self.be_at(time, x)
        return self.numbers(self.unit.getDerivatives, self.states)

    def signs(self, time, x):
        self.be_at(time, x)
        return self.numbers(self.unit.getEventIndicators, self.indicators)

    def everything(self):
        return [
            self.get(name).hex() for name, each in self.variables.items() if each.type == "Real"
        ]

    def integrate(self, end, method, tolerance):
        """Times at which the mode changes, and the modes; by a method of scipy."""
        self.initialise()
        time, events, mode = 0.0, [], None
        nominals = self.numbers(self.unit.getNominalsOfContinuousStates, self.states)
        while True:
            told = self.unit.newDiscreteStates()
            known = told[5] if told[4] else math.inf
            if mode is not None and self.get("mode") != mode:
                events.append((time, self.get("mode")))
            mode = self.get("mode")
            self.unit.enterContinuousTimeMode()
            if time >= end:
                return np.array(events)
            crossings = [lambda t, x, i=i: self.signs(t, x)[i] for i in range(self.indicators)]
            for each in crossings:
                each.terminal, each.direction = True, -1
            done = solve_ivp(
                self.rates,
                (time, min(end, known)),
                self.x(),
                method=method,
                rtol=tolerance,
                atol=tolerance * nominals,
                events=crossings,
            )
            time = done.t[-1]
            self.be_at(time, done.y[:, -1])
            assert self.unit.completedIntegratorStep() == (0, 0)
            self.unit.enterEventMode()


@contextmanager
def hosted(fmu, directory, tables=None, **starts):
    log = FmuLog()
    host = Host(fmu, directory, log, **{**values(tables or {}), **starts})
    try:
        yield host
    finally:
        host.unit.freeInstance()
        log.close()


@pytest.fixture
def host(fmu, tmp_path):
    with hosted(fmu, tmp_path) as one:
        yield one


@pytest.mark.parametrize(
    "case, method", [("line", "DOP853"), ("run-up", "DOP853"), ("slab", "Radau")]
)
def test_any_method_finds_the_same_events(fmu, tmp_path, case, method):
    tables = {**CASES[case], "solver": {"tolerance": 1e-12}}
    own = simulate(Parameters(**tables), duration=1.5).events
    with hosted(fmu, tmp_path, CASES[case]) as host:
        events = host.integrate(1.5, method, 1e-7)
    assert list(events[:, 1]) == list(own[:, 1])
    assert np.abs(events[:, 0] - own[:, 0]).max() < 1e-5


def test_forward_euler(fmu):
    """Of first order, and without a search for events: these are late by a step."""
    result = exchanged(
        fmu, {}, None, solver="Euler", step_size=1e-4, output_interval=1e-4, stop_time=1.0
    )
    own = simulate(Parameters(), duration=1.0)
    times, modes = changes(result)
    assert list(modes) == list(own.events[:, 1])
    assert np.abs(times - own.events[:, 0]).max() < 5e-3
    assert np.abs(result["energy_residual"]).max() < 1e-2


# --- states, rates, description ---


def test_description(fmu):
    assert validate_fmu(str(fmu)) == []
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


def test_rates_in_co_simulation(fmu):
    """They are the motion's own: differences of what they are the rates of say so."""
    names = ("x", "vx", "heat", "surface_travel", "sliding_distance")
    rates = [f"der({name})" for name in names]
    result = simulate_fmu(
        str(fmu),
        fmi_type="CoSimulation",
        stop_time=0.4,
        output_interval=1e-3,
        start_values=values({"initial": {"vx": 0.0}, "surface": {"run_up_time": 0.2}}),
        output=[*names, *rates, "mode"],
    )
    slipping = result["mode"] == 1
    inside = slipping[:-2] & slipping[1:-1] & slipping[2:]
    assert inside.sum() > 100
    at = result["time"][1:-1]
    inside &= abs(at - 0.2) > 2e-3  # the surface's acceleration jumps
    for name in names:
        found = (result[name][2:] - result[name][:-2]) / 2e-3
        size = np.abs(found).max()
        assert np.abs(found - result[f"der({name})"][1:-1])[inside].max() < 1e-3 * size, name


def test_saved_states_in_continuous_time(host):
    host.begin()
    x = host.x()
    for n in range(10):
        x = x + 1e-4 * host.rates(n * 1e-4, x)
    host.be_at(1e-3, x)
    host.unit.completedIntegratorStep()
    kept = host.unit.getFMUState()
    as_bytes = host.unit.serializeFMUState(kept)
    before, rates = host.everything(), host.rates(1e-3, x)
    host.rates(0.5, x + 1.0)
    host.unit.enterEventMode()
    for state in (kept, host.unit.deserializeFMUState(as_bytes)):
        host.unit.setFMUState(state)
        assert host.everything() == before
        assert (host.rates(1e-3, x) == rates).all()
        host.rates(0.6, x + 2.0)
    host.unit.freeFMUState(kept)


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


def test_inputs_change_at_events(fmu):
    step = np.array(
        [(0.0, 0.15, 0.0), (1.0, 0.15, 0.0), (1.0, 0.05, 1.0), (3.0, 0.05, 1.0)],
        dtype=[("time", float), ("surface_speed", float), ("external_force_x", float)],
    )
    common = {
        "stop_time": 3.0,
        "output_interval": 0.01,
        "input": step,
        "output": ["x", "slip_count"],
    }
    result = simulate_fmu(
        str(fmu),
        fmi_type="ModelExchange",
        relative_tolerance=1e-9,
        record_events=False,
        start_values=values({}),
        **common,
    )
    own = simulate_fmu(str(fmu), fmi_type="CoSimulation", start_values=values({}), **common)
    assert np.abs(result["x"] - own["x"]).max() < 1e-6
    assert (result["slip_count"] == own["slip_count"]).all()


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


def test_calls_out_of_turn(host):
    unit, room = host.unit, (ctypes.c_double * host.states)()
    continuous = [
        (unit.completedIntegratorStep,),
        (unit.setContinuousStates, room, host.states),
    ]
    out_of_turn = {
        "instantiated": [(unit.newDiscreteStates,), (unit.setTime, 1.0), *continuous],
        "event": [*continuous, (host.put, "rig.mass", 1.0), (host.put, "x", 1.0)],
        "continuous": [
            (unit.newDiscreteStates,),
            (unit.enterContinuousTimeMode,),
            (unit.setContinuousStates, room, host.states - 1),
            (unit.setTime, math.nan),
            (unit.getDerivatives, room, host.states + 1),
            (host.put, "der(x)", 1.0),
        ],
    }
    reach = {"instantiated": lambda: None, "event": host.initialise, "continuous": host.begin}
    for phase, calls in out_of_turn.items():
        for call, *arguments in calls:
            unit.reset()
            reach[phase]()
            refused(call, *arguments)
            assert host.log.take_errors()
            refused(unit.enterEventMode)  # it has failed
            host.log.take_errors()


def test_rates_of_inputs_are_for_co_simulation(host):
    """In model exchange an input is what the host sets at each time."""
    reference = ctypes.byref(ctypes.c_uint(host.variables["surface_speed"].valueReference))
    order, rate = ctypes.byref(ctypes.c_int(1)), ctypes.byref(ctypes.c_double(0.1))
    function = host.unit.dll.fmi2SetRealInputDerivatives
    function.argtypes = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t, *[ctypes.c_void_p] * 2]
    host.begin()
    assert function(host.unit.component, reference, 1, order, rate) == fmi2Error
    assert "takes no derivative in model exchange" in str(host.log.take_errors())
    assert host.description.coSimulation.canInterpolateInputs


def test_one_interface_is_not_the_other(host):
    slave = FMU2Slave(
        guid=host.description.guid,
        unzipDirectory=host.unit.unzipDirectory,
        modelIdentifier=host.description.coSimulation.modelIdentifier,
    )
    slave.instantiate(callbacks=host.log.callbacks, loggingOn=True)
    slave.setupExperiment()
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    host.begin()
    refused(host.unit.setFMUState, slave.getFMUState())
    assert "co-simulation" in host.log.take_errors()
    host.unit.reset()
    host.begin()
    room = (ctypes.c_double * host.states)()
    refused(_rates_of, slave, room, host.states)
    slave.freeInstance()


def _rates_of(slave, room, count):
    """Ask an instance for co-simulation for its rates."""
    function = slave.dll.fmi2GetDerivatives
    function.argtypes = [ctypes.c_void_p, ctypes.POINTER(ctypes.c_double), ctypes.c_size_t]
    status = function(slave.component, room, count)
    if status:
        raise FMICallException("fmi2GetDerivatives", status)


def test_a_state_that_is_no_number_is_refused_at_the_step(host):
    host.begin()
    x = host.x()
    x[0] = math.nan
    host.be_at(0.1, x)
    refused(host.unit.completedIntegratorStep)
    assert "not a finite number" in host.log.take_errors()


def test_with_pretension_a_long_run_is_that_of_co_simulation(fmu):
    """As the documentation has it: without, both leave their line by rounding, each in its way."""

    def x(values, **options):
        result = simulate_fmu(
            str(fmu), stop_time=30.0, output_interval=0.01, start_values=values, **options
        )
        return np.interp(np.arange(0.0, 30.0, 0.01), result["time"], result["x"])

    exchange = {"fmi_type": "ModelExchange", "solver": "CVode", "relative_tolerance": 1e-9}
    apart = [
        np.abs(x(values) - x(values, **exchange))
        for values in ({"rig.spring_natural_length": 0.17}, {})
    ]
    assert apart[0].max() < 1e-6
    assert apart[1][:1000].max() < 1e-6 and apart[1][1500:].max() > 1e-4
