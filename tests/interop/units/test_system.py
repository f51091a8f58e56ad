"""Both native units as a system (SSP), in tools that run such: the same as the coupled case.

`stickslip couple` steps one after the other, each with what those before it have reached, as the
coupled case does. The others do not: heat and travel come to the heat model a step later there. The
mechanics, which here does not feel the temperature, is the same.
"""

import json
import sys
import zipfile
from contextlib import contextmanager
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import read_ssd, read_ssv
from foreign_tools import ecos_environment
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimObserver import CosimObserver
from stickslip.generation.platforms import this_platform
from test_other_hosts import needs_ecospy, output

from cosim import read_scenario, read_system, run_scenario, run_system
from cosim.cli import main
from cosim.coupling.record import RunFolder
from cosim.coupling.record.folder import CheckpointError
from cosim.fmu.build import SYSTEM
from cosim.fmu.libraries import platforms_of
from cosim.fmu.thermal import structure

STEP, COUNT = 0.01, 600
TEMPERATURE = "thermal.interface_temperature"
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
    return result["mechanics.x"], result[TEMPERATURE]


def result_of(path, step=STEP, stop=COUNT * STEP):
    with read_system(path, {"coupling.macro_step": step, "run.stop": stop}) as specification:
        result = run_system(specification).result
    assert result.status == "complete", result.reason
    return result


@pytest.fixture(scope="module")
def in_turn(system):
    return result_of(system)


def agree(x, temperature, expected):
    """Of what a tool has found after each step."""
    np.testing.assert_allclose(x, expected[0][1 : len(x) + 1], rtol=0, atol=1e-10)
    np.testing.assert_allclose(temperature[1:], expected[1][1 : len(x)], rtol=0, atol=NEAR)
    assert np.ptp(expected[1]) > 500 * NEAR


def same(found, expected):
    """To the last bit."""
    assert found.values.keys() == expected.values.keys()
    np.testing.assert_array_equal(found.time, expected.time)
    for name, values in expected.values.items():
        np.testing.assert_array_equal(found[name], values, err_msg=name)


def test_in_turn_it_is_the_coupled_case(in_turn, expected):
    np.testing.assert_allclose(in_turn["mechanics.x"], expected[0], rtol=0, atol=1e-10)
    np.testing.assert_allclose(in_turn[TEMPERATURE], expected[1], rtol=0, atol=NEAR)


@contextmanager
def written(system, path, end=str, **of_units):
    """A TOML file of the same units, values and connections; end: of a connection's, what else."""
    with read_system(system) as read:
        lines = []
        for unit in read.units:
            given = {f'parameters."{key}"': start.value for key, start in unit.given.items()}
            told = {"file": str(unit.file)} | of_units.get(unit.name, {}) | given
            lines += [f"units.{unit.name}.{key} = {value!r}" for key, value in told.items()]
        for link in read.links:
            lines += ["[[connections]]", f'from = "{end(link.source)}"', f'to = "{end(link.sink)}"']
        path.write_text("\n".join(lines), encoding="utf-8")
        yield path


def test_a_toml_file_of_the_pair_gives_the_same_numbers(system, in_turn, tmp_path):
    with written(system, tmp_path / "pair.toml") as path:
        same(result_of(path), in_turn)


def test_no_heat_is_lost_between_substeps(system, tmp_path):
    """Ten substeps of the block in each step, power handed over: that of all of them is given."""
    settings = ["--set", f"coupling.macro_step={10 * STEP}", "--set", f"run.stop={COUNT * STEP}"]

    def end(port):
        return f"{port}_flow" if port.endswith(".heat") else port

    with written(system, tmp_path / "pair.toml", end, mechanics={"substeps": 10}) as path:
        assert main(["couple", str(path), *settings, "-o", str(tmp_path / "out")]) == 0
    (power,) = json.loads((tmp_path / "out/summary.json").read_text())["ledger"]["powers"]
    assert power["made"] > 0.01
    assert power["given"] == pytest.approx(power["made"], rel=1e-12)


def test_a_run_that_was_cut_off_goes_on_to_the_last_bit(system, in_turn, tmp_path):
    def stop(reached):
        if reached > 2.0:
            raise KeyboardInterrupt

    changes = {"coupling.macro_step": STEP, "run.stop": COUNT * STEP, "run.checkpoint_steps": 70}
    with read_system(system, changes) as specification:
        folder = RunFolder.begun(tmp_path, {}, {})
        cut = run_system(specification, stop, folder)
        folder.release()
        assert cut.result.status == "interrupted" and 2.0 < cut.result.time[-1] < 2.1
        again = run_system(specification, folder=RunFolder.found(tmp_path))
    assert again.result.status == "complete" and again.result.steps == in_turn.steps
    same(again.result, in_turn)
    with read_system(system, changes | {"run.stop": 12.0}) as other, pytest.raises(CheckpointError):
        run_system(other, folder=RunFolder.found(tmp_path))


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
    agree(result["mechanics.x"], result[TEMPERATURE], expected)


def in_libcosim(system, tmp_path, step, count, *wanted):
    """Values of some variables, each (unit, name), after each step."""
    with zipfile.ZipFile(system) as archive:
        archive.extractall(tmp_path)
    places = {}
    for name, fmu in (("mechanics", "StickSlip3DOF.fmu"), ("thermal", "BeltIceThermal.fmu")):
        variables = fmpy.read_model_description(tmp_path / "resources" / fmu).modelVariables
        places[name] = {each.name: each.valueReference for each in variables}
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


@pytest.mark.parametrize("step", [0.01, 0.5])
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
    run = result_of(system, step, stop)
    ours = run["mechanics.heat"]
    (flow,) = run.ledger.flows
    assert ours[-1] > 0.1 and str(flow.connection) == "mechanics.heat -> thermal.heat"
    np.testing.assert_allclose(flow.taken, ours, rtol=0, atol=1e-12 * ours[-1])
    balance = [run[f"thermal.heat_{of}"] for of in ("received", "stored", "to_air")]
    np.testing.assert_allclose(balance[1] + balance[2], balance[0], rtol=0, atol=1e-12 * ours[-1])


def test_in_ecospy(system, expected):
    needs_ecospy()
    said = output([sys.executable, SCRIPT, system, STEP, COUNT], env=ecos_environment())
    rows = [line.split()[1:] for line in said.splitlines() if line.startswith("at ")]
    agree(*np.array(rows, dtype=float).T, expected)
