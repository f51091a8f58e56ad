"""The units in fmpy: description, refusals, state, many instances, any communication step."""

import math
import os
import shutil
import signal
import subprocess
import sys
import threading
import time
import traceback
from contextlib import contextmanager
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave, fmi2Error
from fmpy.validation import validate_fmu

from cosim.coupling.fmu_unit import FmuLog
from cosim.fmu import python_unit

SPEED = 0.15
SLIDING = {"surface_speed": SPEED}
CREEPING = {"surface_speed": 0.03, "initial.vx": 0.03, "friction.stick_creep": 4e-3}
SHEARED = {
    "surface_speed": 0.03,
    "initial.vx": 0.03,
    "friction.transition_speed": 5e-3,
    "friction.presliding_distance": 1e-4,
}


class Instance:
    """One FMU instance, addressed by variable names."""

    def __init__(self, description, slave, log):
        self.description, self.slave, self.log = description, slave, log
        self.variables = {v.name: v for v in description.modelVariables}
        self.is_python = "pythonfmu" in description.generationTool

    def get(self, name):
        variable = self.variables[name]
        get = getattr(self.slave, f"get{variable.type}")
        return get([variable.valueReference])[0]

    def set(self, name, value):
        variable = self.variables[name]
        call = getattr(self.slave, f"set{variable.type}")
        call([variable.valueReference], [value])

    def initialise(self, start=0.0, tolerance=None, **values):
        for name, value in {**SLIDING, **values}.items():
            self.set(name, value)
        self.slave.setupExperiment(startTime=start, tolerance=tolerance)
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()

    def march(self, first, steps, size):
        for n in range(first, first + steps):
            self.slave.doStep(n * size, size)

    def everything(self):
        return [float(self.get(name)).hex() for name in self.variables]

    def refuses(self, call, *arguments, **values):
        """The call is refused; the reason, from the log.

        Of the Python unit's calls only a step returns an error. What another failed in, the next
        step says.
        """
        if self.is_python and call != self.slave.doStep:
            call(*arguments, **values)
        else:
            refused(call, *arguments, **values)
        return self.log.take_errors()


@contextmanager
def instance(fmu, directory, logging=True):
    directory.mkdir(exist_ok=True)
    description = fmpy.read_model_description(fmu)
    folder = fmpy.extract(fmu, unzipdir=directory)
    log = FmuLog()
    slave = FMU2Slave(
        guid=description.guid,
        unzipDirectory=str(folder),
        modelIdentifier=description.coSimulation.modelIdentifier,
    )
    slave.instantiate(callbacks=log.callbacks, loggingOn=logging)
    try:
        yield Instance(description, slave, log)
    finally:
        slave.freeInstance()
        log.close()


@pytest.fixture
def block(unit, tmp_path):
    with instance(unit, tmp_path / "first") as one:
        yield one


@pytest.fixture
def python_block(python_fmu, tmp_path):
    with instance(python_fmu, tmp_path / "first") as one:
        yield one


def refused(call, *arguments, **values):
    """The call must return fmi2Error."""
    with pytest.raises(FMICallException) as caught:
        call(*arguments, **values)
    assert caught.value.status == fmi2Error


# --- description ---


def test_validation_finds_nothing(unit):
    assert validate_fmu(str(unit)) == []
    command = [sys.executable, "-m", "fmpy", "validate", str(unit)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stderr == "" and "No problems found" in done.stdout


def test_every_variable_says_what_it_is(unit):
    description = fmpy.read_model_description(unit, validate_model_structure=True)
    units = {each.name for each in description.unitDefinitions}
    for variable in description.modelVariables:
        assert variable.description, variable.name
        if variable.type == "Real":
            assert variable.unit in units, variable.name
        if variable.causality == "parameter":
            tunable = variable.name in ("friction.mu_s", "friction.mu_k")
            assert variable.variability == ("tunable" if tunable else "fixed")
            assert variable.initial == "exact"
            assert variable.start is not None and "." in variable.name
    assert description.coSimulation.canGetAndSetFMUstate
    assert description.coSimulation.canSerializeFMUstate


def test_every_output_is_in_the_model_structure(unit):
    description = fmpy.read_model_description(unit)
    outputs = {v.name for v in description.modelVariables if v.causality == "output"}
    assert {unknown.variable.name for unknown in description.outputs} == outputs
    assert {unknown.variable.name for unknown in description.initialUnknowns} >= outputs


def test_of_a_unit_for_co_simulation_no_output_depends_directly_on_an_input(python_fmu):
    description = fmpy.read_model_description(python_fmu)
    assert all(unknown.dependencies == [] for unknown in description.outputs)


# --- refusals: fmi2Error with a message, the process lives on, a state or a reset recovers ---


@pytest.mark.parametrize(
    "time, size, message",
    [
        (0.5, -0.01, "step size is -0.01 s; must be greater than 0"),
        (0.5, 0.0, "step size is 0 s"),
        (0.5, 1e4, "step size is 10000 s; must be at most 1000 s, as a step cannot be interrupted"),
        (0.5, math.nan, "of size nan: must be finite"),
        (math.inf, 0.01, "from t = inf"),
        (0.4, 0.01, "begins at t = 0.4 s, the last one ended at t = 0.5 s"),
        (0.6, 0.01, "begins at t = 0.6 s"),
    ],
)
def test_a_step_that_cannot_be_is_an_error(block, time, size, message):
    block.initialise()
    block.march(0, 50, 0.01)
    state, x = block.slave.getFMUState(), block.get("x")
    refused(block.slave.doStep, time, size)
    assert message in block.log.take_errors()
    assert block.get("x") == x
    refused(block.slave.doStep, 0.5, 0.01)
    assert "failed before" in block.log.take_errors()
    block.slave.setFMUState(state)
    block.slave.doStep(0.5, 0.01)
    assert block.log.take_errors() == ""
    block.slave.freeFMUState(state)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_an_input_that_is_no_number_is_refused(block, value):
    block.initialise()
    block.march(0, 10, 0.01)
    said = block.refuses(block.set, "surface_speed", value)
    assert said == f"surface_speed = {value}: must be a finite number"
    assert block.get("surface_speed") == SPEED
    refused(block.slave.doStep, 0.1, 0.01)


def test_an_input_out_of_range_is_refused(block):
    block.initialise()
    said = block.refuses(block.set, "interface_temperature", -300.0)
    assert said == "interface_temperature = -300: must lie in [-273.15, inf]"


def test_a_fixed_parameter_stays_after_initialisation(block):
    block.initialise()
    mass = block.get("rig.mass")
    said = block.refuses(block.set, "rig.mass", 2.0)
    assert said == "rig.mass is fixed and cannot be set after initialisation"
    assert block.get("rig.mass") == mass
    refused(block.slave.doStep, 0.0, 0.01)


def test_an_output_cannot_be_set(block):
    block.initialise()
    assert block.refuses(block.set, "x", 1.0) == "x is an output and cannot be set"


# --- calls out of turn, and of what there is not ---


@pytest.mark.parametrize(
    ("call", "arguments", "says"),
    [
        ("enterInitializationMode", (), "not allowed while the instance is stepping"),
        ("exitInitializationMode", (), "not allowed while the instance is stepping"),
        ("setupExperiment", (), "not allowed while the instance is stepping"),
        ("getReal", ([4711],), "value reference 4711: there is no such variable"),
        ("getReal", ([2**32 - 1],), "value reference 4294967295: there is no such variable"),
        ("setReal", ([4711], [1.0]), "value reference 4711: there is no such variable"),
        ("getInteger", ([0],), "surface_speed is a real number, not an integer"),
        ("setInteger", ([0], [1]), "surface_speed is a real number, not an integer"),
        ("getBoolean", ([0],), "fmi2GetBoolean: all variables are real or integer"),
        ("setBoolean", ([0], [True]), "fmi2SetBoolean: all variables are real or integer"),
        ("getString", ([0],), "fmi2GetString: all variables are real or integer"),
        ("setString", ([0], ["x"]), "fmi2SetString: all variables are real or integer"),
    ],
)
def test_a_call_that_makes_no_sense_is_refused(block, call, arguments, says):
    block.initialise()
    block.march(0, 10, 0.01)
    state = block.slave.getFMUState()
    said = block.refuses(getattr(block.slave, call), *arguments)
    assert said.endswith(says) and "\n" not in said
    refused(block.slave.doStep, 0.1, 0.01)
    assert "failed before" in block.log.take_errors()
    block.slave.setFMUState(state)
    block.slave.doStep(0.1, 0.01)
    block.slave.freeFMUState(state)


def test_an_integer_is_no_real_number(block):
    block.initialise()
    mode = block.variables["mode"].valueReference
    assert block.refuses(block.slave.getReal, [mode]) == "mode is an integer, not a real number"


def test_the_experiment_is_set_up_once_and_makes_sense(block):
    block.slave.setupExperiment()
    said = block.refuses(block.slave.setupExperiment)
    assert said == "the experiment has been set up before"
    for arguments, says in (
        ({"startTime": math.nan}, "start time is nan; must be a finite number of seconds"),
        ({"startTime": 5.0, "stopTime": 4.0}, "stop time is 4 s; must not be before the start"),
        ({"tolerance": -1.0}, "tolerance is -1; must be a finite number of at least 0"),
    ):
        block.slave.reset()
        assert block.refuses(block.slave.setupExperiment, **arguments).startswith(says)


def test_no_step_after_the_end_and_none_before_the_beginning(block):
    refused(block.slave.doStep, 0.0, 0.01)
    said = block.log.take_errors()
    assert said == "fmi2DoStep: not allowed while the instance is instantiated"
    block.slave.reset()
    block.initialise()
    block.slave.terminate()
    assert block.get("x") == 0.0
    refused(block.slave.doStep, 0.0, 0.01)
    said = block.log.take_errors()
    assert said == "fmi2DoStep: not allowed while the instance is terminated"


def test_an_output_is_there_from_the_initialisation_on(block):
    said = block.refuses(block.get, "x")
    assert said == "fmi2GetReal: not allowed while the instance is instantiated"


def test_half_a_state_is_refused(block):
    block.initialise()
    whole = block.slave.serializeFMUState(block.slave.getFMUState())
    half = whole[: len(whole) // 2]
    said = block.refuses(lambda: block.slave.setFMUState(block.slave.deserializeFMUState(half)))
    assert said == "the state is damaged, or was taken from another build of this unit"


def test_an_error_is_logged_where_the_host_wants_no_log(unit, tmp_path):
    with instance(unit, tmp_path / "silent", logging=False) as block:
        block.slave.fmi2SetDebugLogging(block.slave.component, False, 0, None)
        said = block.refuses(block.initialise, **{"rig.spring_natural_length": 1.0})
        assert said.startswith("rig.spring_natural_length = 1 m is more than twice")
        refused(block.slave.doStep, 0.0, 0.01)
        assert block.log.take_errors().startswith("fmi2DoStep: the instance has failed before")


def test_one_reason_is_told_once(python_block):
    """A host that sets a hundred parameters more does not hear of it a hundred times."""
    python_block.set("rig.mass", -1.0)
    python_block.initialise()
    assert math.isnan(python_block.get("x"))
    assert python_block.log.take_errors() == "rig.mass = -1: must lie in (0, inf]"
    refused(python_block.slave.doStep, 0.0, 0.01)
    assert "(rig.mass = -1: must lie in (0, inf])" in python_block.log.take_errors()


@pytest.mark.parametrize(
    ("name", "value", "range"),
    [("rig.mass", 0.0, "(0, inf]"), ("rig.mass", -1.0, "(0, inf]"), ("rig.free_y", 2, "[0, 1]")],
)
def test_a_parameter_out_of_range_is_refused(block, name, value, range):
    assert block.refuses(block.set, name, value) == f"{name} = {value:g}: must lie in {range}"


@pytest.mark.parametrize(
    ("values", "says"),
    [
        (
            {"friction.stick_creep": 1e-3, "rate_and_state.direct": 0.01},
            "friction.stick_creep = 0.001 m/s beside rate_and_state",
        ),
        (
            {
                "friction.table_speed[2]": 0.1,
                "friction.table_mu[1]": 0.2,
                "velocity_weakening.linear": 0.1,
            },
            "friction.table_speed beside an effect",
        ),
        (
            {"rig.free_y": 0, "initial.vy": 0.1},
            "initial.vy = 0.1 m/s in a rig that is guided in y (rig.free_y = 0)",
        ),
        (
            {"rig.free_phi": 0, "initial.omega": 1.0},
            "initial.omega = 1 rad/s in a rig that is guided in phi (rig.free_phi = 0)",
        ),
    ],
)
def test_parameters_that_cannot_stand_side_by_side_are_refused(block, values, says):
    said = block.refuses(block.initialise, **values)
    assert said.startswith(says)
    refused(block.slave.doStep, 0.0, 0.01)


def test_ctrl_c_inside_a_step_is_an_error_and_the_state_is_that_before(python_block, ctrl_c):
    """In a Python host the signal arrives in the slave's own code; there it may not escape."""
    block = python_block
    block.initialise()
    block.march(0, 10, 0.01)
    x = block.get("x")
    host = threading.get_ident()

    def interrupt():
        """Once the host is in the slave: before, it would be the host's own."""
        while "do_step" not in {
            frame.f_code.co_name for frame, _ in traceback.walk_stack(sys._current_frames()[host])
        }:
            time.sleep(0.01)
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=interrupt).start()
    refused(block.slave.doStep, 0.1, 1e3)
    assert "KeyboardInterrupt" in block.log.take_errors()
    assert block.get("x") == x


def test_a_reset_starts_all_over(block):
    block.initialise()
    block.march(0, 50, 0.01)
    once = block.everything()
    refused(block.slave.doStep, 0.0, 0.01)
    block.slave.reset()
    block.initialise()
    block.march(0, 50, 0.01)
    assert block.everything() == once


def test_a_damaged_state_is_refused(block):
    block.initialise()
    damaged = block.refuses(
        lambda: block.slave.setFMUState(block.slave.deserializeFMUState(b"{not a state"))
    )
    assert damaged == "the state is damaged, or was taken from another build of this unit"
    refused(block.slave.doStep, 0.0, 0.01)


# --- state ---


def test_a_state_continues_bit_for_bit(block):
    block.initialise()
    block.march(0, 137, 0.01)
    state = block.slave.getFMUState()
    then = block.everything()
    block.march(137, 200, 0.01)
    ahead = block.everything()
    block.set("surface_speed", 0.3)
    block.march(337, 10, 0.01)
    for _ in range(2):
        block.slave.setFMUState(state)
        assert block.everything() == then
        block.march(137, 200, 0.01)
        assert block.everything() == ahead
    block.slave.freeFMUState(state)


@pytest.mark.parametrize(("contact", "sliding"), [(CREEPING, 1e-3), (SHEARED, 1e-4)])
def test_a_state_of_a_stick_that_creeps_continues_bit_for_bit(block, contact, sliding):
    block.initialise(**contact)
    block.march(0, 40, 0.01)
    assert block.get("sliding_speed") > sliding  # half way to the break-away
    state = block.slave.getFMUState()
    block.march(40, 100, 0.01)
    ahead = block.everything()
    block.slave.setFMUState(state)
    block.march(40, 100, 0.01)
    assert block.everything() == ahead
    block.slave.freeFMUState(state)


def test_a_serialised_state_continues_in_another_process(unit, block, tmp_path):
    block.initialise(**{"lateral_friction.ratio": 1.0, "initial.x": 0.01})
    block.march(0, 137, 0.01)
    (tmp_path / "state").write_bytes(block.slave.serializeFMUState(block.slave.getFMUState()))
    block.march(137, 100, 0.01)
    program = (
        "import sys; from pathlib import Path; sys.path.insert(0, sys.argv[1]);"
        "from test_fmpy import instance; directory = Path(sys.argv[3])\n"
        "with instance(Path(sys.argv[2]), directory / 'other') as other:\n"
        "    other.initialise()\n"
        "    state = other.slave.deserializeFMUState((directory / 'state').read_bytes())\n"
        "    other.slave.setFMUState(state)\n"
        "    other.march(137, 100, 0.01)\n"
        "    print(*other.everything())\n"
    )
    command = [sys.executable, "-c", program, str(Path(__file__).parent), str(unit), str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout.split() == block.everything()


# --- more than one ---


def test_two_instances_do_not_know_each_other(unit, tmp_path):
    with instance(unit, tmp_path / "a") as a, instance(unit, tmp_path / "b") as b:
        a.initialise()
        b.initialise(surface_speed=0.3)
        for n in range(100):
            a.slave.doStep(n * 0.01, 0.01)
            b.slave.doStep(n * 0.01, 0.01)
        together = a.everything(), b.everything()
    for alone, speed in zip(together, (SPEED, 0.3), strict=True):
        with instance(unit, tmp_path / "c") as c:
            c.initialise(surface_speed=speed)
            c.march(0, 100, 0.01)
            assert c.everything() == alone


def test_a_process_outlives_many_instances_and_their_files(unit, tmp_path):
    path = sys.path.copy()
    for _ in range(100):
        with instance(unit, tmp_path / "once") as one:
            one.initialise()
            one.march(0, 2, 0.01)
        shutil.rmtree(tmp_path / "once")
    assert sys.path == path


def test_two_builds_run_side_by_side(python_fmu, tmp_path):
    """Doubled gravity in the second build; each keeps its own numbers in one process."""
    files = python_unit.sources()
    heavier = files["stickslip/kernel.py"].replace(b"GRAVITY = 9.81", b"GRAVITY = 19.62")
    assert heavier != files["stickslip/kernel.py"]
    changed = python_unit.build(tmp_path, files | {"stickslip/kernel.py": heavier})
    forces = []
    for path, folder in ((python_fmu, "a"), (changed, "b"), (python_fmu, "c")):
        with instance(path, tmp_path / folder) as one:
            one.initialise()
            one.march(0, 1, 0.001)
            forces.append(one.get("friction_force_x"))
    assert forces[1] == pytest.approx(2 * forces[0], rel=1e-12) and forces[2] == forces[0]


# --- motion ---


def trajectory(block, size, stop=3.0, **values):
    block.slave.reset()
    block.initialise(**values)
    x, count = [], round(stop / size)
    for n in range(count):
        block.slave.doStep(n * size, size)
        x.append(block.get("x"))
    return np.array(x)


@pytest.mark.parametrize("size", [0.001, 0.0025, 0.05, 0.5])
def test_the_communication_step_does_not_change_the_motion(block, size):
    often = trajectory(block, 0.0005)
    stride = round(size / 0.0005)
    np.testing.assert_allclose(
        trajectory(block, size), often[stride - 1 :: stride], rtol=0, atol=1e-10
    )


@pytest.mark.parametrize("contact", [CREEPING, SHEARED])
def test_the_communication_step_does_not_change_a_creep(block, contact):
    often = trajectory(block, 0.002, stop=5.0, **contact)
    (once,) = trajectory(block, 5.0, stop=5.0, **contact)
    assert once == pytest.approx(often[-1], abs=1e-10)
    assert block.get("slip_count") > 2


def test_heat_flow_is_the_difference_quotient_of_heat(block):
    block.initialise()
    before = 0.0
    for n in range(100):
        block.slave.doStep(n * 0.03125, 0.03125)
        heat = block.get("heat")
        assert block.get("heat_flow") == (heat - before) / 0.03125
        before = heat


RAMP_AND_RIPPLE = {
    "surface.run_up_time": 10.0,
    "speed_ripple.amplitude": 0.1,
    "speed_ripple.frequency": 3.0,
}


@pytest.mark.parametrize("start", [-5.0, 5.0, 1e6])
def test_the_time_at_which_a_run_starts_is_no_matter(block, start):
    """The ramp begins then, and the ripple."""
    names = ("x", "vx", "heat", "surface_speed_actual")
    runs = []
    for begin in (0.0, start):
        block.slave.reset()
        block.initialise(start=begin, **RAMP_AND_RIPPLE)
        rows = []
        for n in range(100):
            block.slave.doStep(begin + n * 0.03125, 0.03125)
            rows.append([block.get(name) for name in names])
        runs.append(rows)
    np.testing.assert_allclose(runs[1], runs[0], rtol=0, atol=1e-9)
    assert 0.0 < runs[0][-1][3] < SPEED


def test_friction_can_be_tuned_in_the_run(unit, tmp_path):
    """The ledger stays closed; a state from before brings the old friction back."""
    with instance(unit, tmp_path / "tuned") as block:
        block.initialise()
        block.march(0, 100, 0.01)
        state = block.slave.getFMUState()
        block.march(100, 50, 0.01)
        as_it_was = block.everything()
        for _ in range(2):
            block.slave.setFMUState(state)
            block.set("friction.mu_s", 0.4)
            block.set("friction.mu_k", 0.1)
            block.march(100, 50, 0.01)
            assert abs(block.get("energy_residual")) < 1e-9 and block.everything() != as_it_was
        block.slave.setFMUState(state)
        block.march(100, 50, 0.01)
        assert block.everything() == as_it_was
        block.slave.freeFMUState(state)


def test_the_ledger_is_closed_at_every_point_of_the_speed_ramp(block):
    """Also where an internal step of the kernel spans several of the host."""
    block.initialise(**RAMP_AND_RIPPLE)
    for n in range(100):
        block.slave.doStep(n * 0.01, 0.01)
        assert abs(block.get("energy_residual")) < 1e-10


@pytest.mark.parametrize("hold", [0, 1])
def test_the_units_move_alike_to_the_last_bit(fmu, python_fmu, tmp_path, hold):
    seen = []
    for path, folder in ((fmu, "native"), (python_fmu, "python")):
        with instance(path, tmp_path / folder) as block:
            values = {"lateral_friction.ratio": 1.0, "initial.x": 0.01, "input.hold": hold}
            block.initialise(**values)
            for n in range(200):
                block.set("surface_speed", SPEED * (1.0 + 0.1 * math.sin(0.2 * n)))
                if n == 100:
                    block.set("friction.mu_k", 0.1)
                    block.set("external_force_y", 0.2)
                block.slave.doStep(n * 0.01, 0.01)
            seen.append({name: float(block.get(name)).hex() for name in block.variables})
    native, python = seen
    assert {name: native[name] for name in python} == python


@pytest.mark.parametrize("tolerance, same", [(1e-3, True), (0.0, True), (1e-30, False)])
def test_a_host_s_tolerance_tightens_and_never_loosens(block, tolerance, same):
    own = trajectory(block, 0.25)[-1]
    block.slave.reset()
    block.initialise(tolerance=tolerance)
    block.march(0, 12, 0.25)
    assert bool(block.get("x") == own) is same
    assert block.get("x") == pytest.approx(own, abs=1e-9)


def test_simulate_fmu_runs_it(unit):
    result = fmpy.simulate_fmu(
        str(unit), stop_time=2.0, output_interval=0.01, start_values=SLIDING, output=["x", "heat"]
    )
    assert len(result) == 201 and result["heat"][-1] > 0


def test_a_host_without_numpy_runs_it(unit, tmp_path, block):
    description = fmpy.read_model_description(unit)
    folder = Path(fmpy.extract(unit, unzipdir=tmp_path / "bare"))
    slave = block.slave
    library = folder / Path(slave.dll._name).relative_to(tmp_path / "first")
    host = Path(__file__).with_name("bare_host.py")
    (x,) = (v.valueReference for v in description.modelVariables if v.name == "x")
    arguments = [str(folder), str(library), description.guid, str(x), "0.01", "100"]
    done = subprocess.run(
        [sys.executable, "-I", str(host), *arguments], capture_output=True, text=True, check=True
    )
    block.initialise()
    block.march(0, 100, 0.01)
    assert done.stdout.strip() == f"{block.get('x')!r} {{0}} False"
    assert done.stderr == ""


def test_a_surface_that_the_creep_keeps_up_with_is_warned_of_once(unit):
    """With logging on; the run goes on, and sticks for ever."""
    said = []
    found = fmpy.simulate_fmu(
        str(unit),
        stop_time=0.5,
        output_interval=0.05,
        output=["mode"],
        debug_logging=True,
        start_values={"surface_speed": 0.15, "friction.stick_creep": 0.2},
        logger=lambda component, name, status, category, message: said.append((status, message)),
    )
    ((status, message),) = said
    assert status == 1 and b"surface_speed = 0.15 m/s is not above friction.stick_creep" in message
    assert not found["mode"].any()
