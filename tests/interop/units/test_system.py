"""Both native units as a system (SSP), in tools that run such: the same as the coupled case.

None of them steps the units one after the other, each with what those before it have reached, as
the coupled case does: heat and travel come to the heat model a step later. The mechanics, which
here does not feel the temperature, is the same.
"""

import importlib.util
import os
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import read_ssd, read_ssv
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimObserver import CosimObserver
from stickslip.generation.platforms import this_platform
from test_other_hosts import ecos_environment  # noqa: F401  (a fixture)

from cosim import read_scenario, run_scenario
from cosim.fmu.build import SYSTEM
from cosim.fmu.libraries import platforms_of
from cosim.fmu.thermal import structure
from cosim.systems import read_system, run_system

STEP, COUNT = 0.01, 600
SCRIPT = Path(__file__).with_name("hosts") / "system_in_ecospy.py"
#: K: the speed that the heat model is told is that of the end of a step, and the belt speeds up.
NEAR = 2e-5


@pytest.fixture(scope="module")
def system(once):
    return once(SYSTEM)


@pytest.fixture(scope="module")
def expected():
    """x at the communication points, and the temperature of the interface."""
    scenario = read_scenario("reference").changed({"run.duration": COUNT * STEP})
    result = run_scenario(scenario).result
    return result["mechanics.x"], result["thermal.interface_temperature"]


def agree(x, temperature, expected):
    """Of what a tool has found after each step."""
    np.testing.assert_allclose(x, expected[0][1 : len(x) + 1], rtol=0, atol=1e-10)
    np.testing.assert_allclose(temperature[1:], expected[1][1 : len(x)], rtol=0, atol=NEAR)
    assert np.ptp(expected[1]) > 500 * NEAR


def test_the_system_is_as_its_schema_wants_it(system):
    """fmpy checks it while it reads."""
    read = read_ssd(system)
    assert [each.name for each in read.system.elements] == ["mechanics", "thermal"]
    assert len(read.system.connections) == len(structure.CONNECTIONS) and not read.system.connectors
    assert platforms_of(system) == [this_platform().name]
    with zipfile.ZipFile(system) as archive:
        assert {"StickSlip3DOF.fmu", "BeltIceThermal.fmu"} <= {
            Path(name).name for name in archive.namelist()
        }


def test_in_fmpy(system, expected):
    chosen = read_ssv(system, resource=structure.SET_FILE)
    stop = (COUNT - 0.5) * STEP
    result = simulate_ssp(system, stop_time=stop, step_size=STEP, parameter_set=chosen)
    agree(result["mechanics.x"], result["thermal.interface_temperature"], expected)


def in_libcosim(system, tmp_path, step, count, *wanted):
    """Values of some variables, each (unit, name), after each step."""
    with zipfile.ZipFile(system) as archive:
        archive.extractall(tmp_path)
    places = {
        name: {
            each.name: each.valueReference
            for each in fmpy.read_model_description(tmp_path / "resources" / fmu).modelVariables
        }
        for name, fmu in (("mechanics", "StickSlip3DOF.fmu"), ("thermal", "BeltIceThermal.fmu"))
    }
    execution = CosimExecution.from_ssp_file(ssp_path=str(system), step_size=round(step * 1e9))
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer=observer)
    index = {each.name.decode(): each.index for each in execution.slave_infos()}

    def value(name, variable):
        return observer.last_real_values(index[name], [places[name][variable]])[0]

    rows = []
    for _ in range(count):
        assert execution.step()
        rows.append([value(*each) for each in wanted])
    return np.array(rows).T


def test_in_libcosim(system, expected, tmp_path):
    wanted = ("mechanics", "x"), ("thermal", "interface_temperature")
    agree(*in_libcosim(system, tmp_path, STEP, COUNT, *wanted), expected)


@pytest.mark.parametrize("step", [0.01, 0.05, 0.2, 0.5])
def test_every_tool_hands_over_the_joules_that_the_block_has_made(system, step, tmp_path):
    """Those that step both at once, at the next communication point; in turn, at once."""
    wanted = ("mechanics", "heat"), ("thermal", "heat_received")
    stop = 4.0
    count = round(stop / step)
    made, received = in_libcosim(system, tmp_path, step, count, *wanted)
    np.testing.assert_allclose(received[1:], made[:-1], rtol=0, atol=1e-12 * made[-1])
    chosen = read_ssv(system, resource=structure.SET_FILE)
    result = simulate_ssp(system, stop_time=stop, step_size=step, parameter_set=chosen)
    theirs, taken = result["mechanics.heat"], result["thermal.heat_received"]
    np.testing.assert_allclose(taken[1:], theirs[:-1], rtol=0, atol=1e-12 * theirs[-1])
    with read_system(system, {"coupling.macro_step": step, "run.stop": stop}) as read:
        run = run_system(read)
    ours = run.result["mechanics.heat"]
    (flow,) = run.result.ledger.flows
    assert ours[-1] > 0.1 and str(flow.connection) == "mechanics.heat -> thermal.heat"
    np.testing.assert_allclose(flow.taken, ours, rtol=0, atol=1e-12 * ours[-1])
    balance = [run.result[f"thermal.heat_{of}"] for of in ("received", "stored", "to_air")]
    np.testing.assert_allclose(balance[1] + balance[2], balance[0], rtol=0, atol=1e-12 * ours[-1])


def test_in_ecospy(system, expected, ecos_environment):  # noqa: F811
    assert importlib.util.find_spec("ecospy")
    command = [sys.executable, SCRIPT, system, STEP, COUNT]
    with tempfile.TemporaryDirectory() as scratch:
        done = subprocess.run(
            list(map(str, command)),
            cwd=scratch,
            capture_output=True,
            text=True,
            timeout=120,
            env=os.environ | ecos_environment,
        )
    assert done.returncode == 0, done.stderr
    rows = [line.split()[1:] for line in done.stdout.splitlines() if line.startswith("at ")]
    x, temperature = np.array(rows, dtype=float).T
    agree(x, temperature, expected)
