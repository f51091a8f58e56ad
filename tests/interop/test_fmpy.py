"""The FMU in fmpy: description, refusals, state, many instances, any communication step."""

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
from cosim.fmu import stickslip3dof as recipe
from cosim.fmu.stickslip3dof import sources

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
        self.references = {v.name: v.valueReference for v in description.modelVariables}

    def get(self, name):
        return self.slave.getReal([self.references[name]])[0]

    def set(self, name, value):
        self.slave.setReal([self.references[name]], [value])

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
        names = [v.name for v in self.description.modelVariables if v.type == "Real"]
        return [self.get(name).hex() for name in names]


@contextmanager
def instance(fmu, directory):
    directory.mkdir(exist_ok=True)
    description = fmpy.read_model_description(fmu)
    folder = fmpy.extract(fmu, unzipdir=directory)
    log = FmuLog()
    slave = FMU2Slave(
        guid=description.guid,
        unzipDirectory=str(folder),
        modelIdentifier=description.coSimulation.modelIdentifier,
    )
    slave.instantiate(callbacks=log.callbacks, loggingOn=True)
    try:
        yield Instance(description, slave, log)
    finally:
        slave.freeInstance()
        log.close()


@pytest.fixture
def block(fmu, tmp_path):
    with instance(fmu, tmp_path / "first") as one:
        yield one


def refused(call, *arguments):
    """The call must return fmi2Error."""
    with pytest.raises(FMICallException) as caught:
        call(*arguments)
    assert caught.value.status == fmi2Error


# --- description ---


def test_validation_finds_nothing(fmu):
    assert validate_fmu(str(fmu)) == []
    command = [sys.executable, "-m", "fmpy", "validate", str(fmu)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stderr == "" and "No problems found" in done.stdout


def test_every_variable_says_what_it_is(fmu):
    description = fmpy.read_model_description(fmu, validate_model_structure=True)
    units = {unit.name for unit in description.unitDefinitions}
    for variable in description.modelVariables:
        assert variable.description, variable.name
        if variable.type == "Real":
            assert variable.unit in units, variable.name
        if variable.causality == "parameter":
            assert (variable.variability, variable.initial) == ("fixed", "exact")
            assert variable.start is not None and "." in variable.name
    assert description.coSimulation.canGetAndSetFMUstate
    assert description.coSimulation.canSerializeFMUstate


def test_no_output_depends_directly_on_an_input(fmu):
    description = fmpy.read_model_description(fmu)
    outputs = {v.name for v in description.modelVariables if v.causality == "output"}
    assert {unknown.variable.name for unknown in description.outputs} == outputs
    assert all(unknown.dependencies == [] for unknown in description.outputs)
    assert {unknown.variable.name for unknown in description.initialUnknowns} == outputs


# --- refusals: fmi2Error with a message, the process lives on, a state or a reset recovers ---


@pytest.mark.parametrize(
    "time, size, message",
    [
        (0.5, -0.01, "step size is -0.01 s; must be greater than 0"),
        (0.5, 0.0, "step size is 0 s"),
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
def test_an_input_that_is_no_number_is_logged_and_the_next_step_an_error(block, value):
    block.initialise()
    block.march(0, 10, 0.01)
    block.set("surface_speed", value)
    assert f"surface_speed = {value}: must be a finite number" in block.log.take_errors()
    assert block.get("surface_speed") == SPEED
    refused(block.slave.doStep, 0.1, 0.01)


def test_a_fixed_parameter_stays_after_initialisation(block):
    block.initialise()
    mass = block.get("rig.mass")
    block.set("rig.mass", 2.0)
    assert "rig.mass is fixed and cannot be set after initialisation" in block.log.take_errors()
    assert block.get("rig.mass") == mass
    refused(block.slave.doStep, 0.0, 0.01)


def test_an_output_cannot_be_set(block):
    block.initialise()
    block.set("x", 1.0)
    assert "x is an output and cannot be set" in block.log.take_errors()


@pytest.mark.parametrize("name, value", [("rig.mass", 0.0), ("rig.mass", -1.0)])
def test_a_parameter_out_of_range_is_logged_and_no_step_is_made(block, name, value):
    block.initialise(**{name: value})
    assert f"{name} = {value:g}: must" in block.log.take_errors()
    refused(block.slave.doStep, 0.0, 0.01)


def test_two_laws_of_creep_are_refused(block):
    block.initialise(**{"friction.stick_creep": 1e-3, "rate_and_state.direct": 0.01})
    assert "friction.stick_creep = 0.001 m/s beside rate_and_state" in block.log.take_errors()
    refused(block.slave.doStep, 0.0, 0.01)


def test_a_table_beside_another_law_of_the_speed_is_refused(block):
    table = {"friction.table_speed[2]": 0.1, "friction.table_mu[1]": 0.2}
    block.initialise(**table, **{"velocity_weakening.linear": 0.1})
    assert "friction.table_speed beside an effect" in block.log.take_errors()


def test_ctrl_c_inside_a_step_is_an_error_and_the_state_is_that_before(block):
    """In a Python host the signal arrives in the slave's own code; there it may not escape."""
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
    refused(block.slave.doStep, 0.1, 1e5)
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
    block.slave.setFMUState(block.slave.deserializeFMUState(b"{not a state"))
    assert "damaged" in block.log.take_errors()
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


def test_a_serialised_state_continues_in_another_process(fmu, block, tmp_path):
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
    command = [sys.executable, "-c", program, str(Path(__file__).parent), str(fmu), str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout.split() == block.everything()


# --- more than one ---


def test_two_instances_do_not_know_each_other(fmu, tmp_path):
    with instance(fmu, tmp_path / "a") as a, instance(fmu, tmp_path / "b") as b:
        a.initialise()
        b.initialise(surface_speed=0.3)
        for n in range(100):
            a.slave.doStep(n * 0.01, 0.01)
            b.slave.doStep(n * 0.01, 0.01)
        together = a.everything(), b.everything()
    for alone, speed in zip(together, (SPEED, 0.3), strict=True):
        with instance(fmu, tmp_path / "c") as c:
            c.initialise(surface_speed=speed)
            c.march(0, 100, 0.01)
            assert c.everything() == alone


def test_a_process_outlives_many_instances_and_their_files(fmu, tmp_path):
    path = sys.path.copy()
    for _ in range(100):
        with instance(fmu, tmp_path / "once") as one:
            one.initialise()
            one.march(0, 2, 0.01)
        shutil.rmtree(tmp_path / "once")
    assert sys.path == path


def test_two_builds_run_side_by_side(fmu, tmp_path):
    """Doubled gravity in the second build; each keeps its own numbers in one process."""
    files = sources()
    heavier = files["stickslip/packing.py"].replace(b"GRAVITY = 9.81", b"GRAVITY = 19.62")
    assert heavier != files["stickslip/packing.py"]
    changed = recipe.build(tmp_path, files | {"stickslip/packing.py": heavier})
    forces = []
    for path, folder in ((fmu, "a"), (changed, "b"), (fmu, "c")):
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


def test_a_run_that_starts_late_is_the_same(block):
    block.initialise(start=100.0)
    for n in range(100):
        block.slave.doStep(100.0 + n * 0.03125, 0.03125)
    late = block.get("x")
    assert late == pytest.approx(trajectory(block, 0.03125, stop=3.125)[-1], abs=1e-9)


@pytest.mark.parametrize("tolerance, same", [(1e-3, True), (0.0, True), (1e-30, False)])
def test_a_host_s_tolerance_tightens_and_never_loosens(block, tolerance, same):
    own = trajectory(block, 0.25)[-1]
    block.slave.reset()
    block.initialise(tolerance=tolerance)
    block.march(0, 12, 0.25)
    assert bool(block.get("x") == own) is same
    assert block.get("x") == pytest.approx(own, abs=1e-9)


def test_simulate_fmu_runs_it(fmu):
    result = fmpy.simulate_fmu(
        str(fmu), stop_time=2.0, output_interval=0.01, start_values=SLIDING, output=["x", "heat"]
    )
    assert len(result) == 201 and result["heat"][-1] > 0


def test_a_host_without_numpy_runs_it(fmu, tmp_path, block):
    description = fmpy.read_model_description(fmu)
    folder = Path(fmpy.extract(fmu, unzipdir=tmp_path / "bare"))
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


def test_a_surface_that_the_creep_keeps_up_with_is_warned_of_once(fmu):
    """With logging on; the run goes on, and sticks for ever."""
    said = []
    found = fmpy.simulate_fmu(
        str(fmu),
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
