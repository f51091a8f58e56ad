"""`stickslip couple` on our own pair: as an SSP, as a TOML of the same, beside another master."""

import json
import zipfile

import numpy as np
import pytest

from cosim import read_scenario, run_scenario
from cosim.cli import main
from cosim.coupling.record import RunFolder
from cosim.coupling.record.checkpoint import CheckpointError
from cosim.fmu.build import SYSTEM
from cosim.fmu.thermal import structure
from cosim.systems import read_system, run_system

STEP, STOP = 0.01, 6.0
TEMPERATURE = "thermal.interface_temperature"


@pytest.fixture(scope="module")
def ssp(once):
    return once(SYSTEM)


def result_of(path, **changes):
    changes = {"coupling.macro_step": STEP, "run.stop": STOP} | changes
    with read_system(path, changes) as specification:
        done = run_system(specification)
    assert done.result.status == "complete", done.result.reason
    return done.result


@pytest.fixture(scope="module")
def in_turn(ssp):
    return result_of(ssp)


def test_it_is_the_coupled_case(in_turn):
    """To what the reduced heat model is off by, a part of the rise; see the units' own tests."""
    expected = run_scenario(read_scenario("reference").changed({"run.duration": STOP})).result
    np.testing.assert_allclose(in_turn["mechanics.x"], expected["mechanics.x"], rtol=0, atol=1e-10)
    rise = np.ptp(expected[TEMPERATURE])
    np.testing.assert_allclose(
        in_turn[TEMPERATURE], expected[TEMPERATURE], rtol=0, atol=5e-3 * rise
    )


def test_a_toml_file_of_the_pair_gives_the_same_numbers(ssp, in_turn, tmp_path):
    """To the last bit: the same units, values, connections and steps."""
    with zipfile.ZipFile(ssp) as archive:
        archive.extractall(tmp_path)
    with read_system(ssp, {"run.stop": STOP}) as system:
        lines = ['name = "the same"', f"coupling.macro_step = {STEP}", f"run.stop = {STOP}"]
        lines += [f'units.{unit.name}.file = "resources/{unit.file.name}"' for unit in system.units]
        lines += [
            f'units.{unit.name}.parameters."{key}" = {start.value!r}'
            for unit in system.units
            for key, start in unit.given.items()
        ]
        for link in system.links:
            lines += ["[[connections]]", f'from = "{link.source}"', f'to = "{link.sink}"']
    (tmp_path / "pair.toml").write_text("\n".join(lines), encoding="utf-8")
    again = result_of(tmp_path / "pair.toml")
    assert in_turn.values.keys() == again.values.keys()
    for name, values in in_turn.values.items():
        np.testing.assert_array_equal(again[name], values, err_msg=name)


def test_no_heat_is_lost_between_substeps(ssp, tmp_path):
    """Ten substeps of the block in each step, power handed over: that of all of them is given."""
    lines = [f"coupling.macro_step = {10 * STEP}", f"run.stop = {STOP}"]
    with read_system(ssp) as system:
        for unit in system.units:
            lines += [f'units.{unit.name}.file = "{unit.file}"']
            lines += [f"units.{unit.name}.substeps = 10"] * (unit.name == structure.MECHANICS)
            lines += [
                f'units.{unit.name}.parameters."{key}" = {start.value!r}'
                for key, start in unit.given.items()
            ]
        for link in system.links:
            ends = [
                f"{end}_flow" if end.endswith(".heat") else end for end in (link.source, link.sink)
            ]
            lines += ["[[connections]]", f'from = "{ends[0]}"', f'to = "{ends[1]}"']
        (tmp_path / "pair.toml").write_text("\n".join(lines), encoding="utf-8")
        assert main(["couple", str(tmp_path / "pair.toml"), "-o", str(tmp_path / "out")]) == 0
    (power,) = json.loads((tmp_path / "out/summary.json").read_text())["ledger"]["powers"]
    assert power["made"] > 0.01
    assert power["given"] == pytest.approx(power["made"], rel=1e-12)


def test_a_run_that_was_cut_off_goes_on_to_the_last_bit(ssp, in_turn, tmp_path):
    def stop(reached):
        if reached > 2.0:
            raise KeyboardInterrupt

    changes = {"coupling.macro_step": STEP, "run.stop": STOP, "run.checkpoint_steps": 70}
    with read_system(ssp, changes) as specification:
        folder = RunFolder.begun(tmp_path, {}, {})
        cut = run_system(specification, stop, folder)
        folder.release()
        assert cut.result.status == "interrupted" and 2.0 < cut.result.time[-1] < 2.1
        again = run_system(specification, folder=RunFolder.found(tmp_path))
    assert again.result.status == "complete" and again.steps.count == in_turn.steps
    np.testing.assert_array_equal(again.result.time, in_turn.time)
    for name, values in in_turn.values.items():
        np.testing.assert_array_equal(again.result[name], values, err_msg=name)
    with (
        read_system(ssp, changes | {"run.stop": 2.0 * STOP}) as other,
        pytest.raises(CheckpointError),
    ):
        run_system(other, folder=RunFolder.found(tmp_path))
