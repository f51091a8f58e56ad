"""A run that is killed, and resumed from its folder; what cannot be is refused."""

import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
import xarray as xr
from command_line import stickslip_here

from cosim.coupling.record.folder import load_checkpoint, save_checkpoint

#: Coarse, so that a run takes seconds; friction feels the temperature, so both sides matter.
SCENARIO = """
name = "killed"
belt = {{ cell_length = 5e-3, elements = 3 }}
ice.axial_elements = 4
temperature_dependence.sensitivity = 0.5
surface = {{ speed = 0.15, run_up_time = 1.0 }}
coupling.macro_step = 2e-3
[run]
duration = {duration}
output_interval = 0.01
snapshot_interval = 0.25
checkpoint_steps = {every}
checkpoint_seconds = 0
"""
#: Differ from run to run in any case: times, and that of each participant.
OF_THE_MAKING = {"created", "versions", "wall_time", "coupling"}
#: The record's name of a row's value -> that of result.nc.
COMPARED = {
    "time": "time", "mechanics.x": "x", "mechanics.heat": "heat",
    "thermal.interface_temperature": "interface_temperature",
}  # fmt: skip


def begin(*arguments):
    """A command that goes on while this process does."""
    command = [sys.executable, "-m", "cosim", "run", *map(str, arguments)]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def rows_of(results):
    """So far, read with numpy alone."""
    try:
        return np.load(results / "unfinished" / "record.npy", mmap_mode="r")
    except (FileNotFoundError, ValueError, EOFError):
        return []  # not there yet, or just being made


def killed_when(process, is_time):
    """SIGKILL at that moment."""
    while process.poll() is None and not is_time():
        time.sleep(1e-3)
    assert process.poll() is None, process.communicate()[1]
    os.kill(process.pid, signal.SIGKILL)
    process.communicate()


def check_record(results, whole):
    """The rows on disk are those of the run, less the last, which may be between two."""
    rows = rows_of(results)
    columns = json.loads((results / "unfinished" / "record.json").read_text(encoding="utf-8"))
    names = [column["name"] for column in columns["columns"]]
    for name, variable in COMPARED.items():
        found = np.array(rows[:-1, names.index(name)])
        np.testing.assert_array_equal(found, whole[variable].values[: found.size], err_msg=name)
    return len(rows)


def refused(*arguments):
    """Its one line, behind a note on how long a run takes."""
    done = stickslip_here(".", *arguments)
    assert done.returncode == 2, done.stderr
    *notes, line = done.stderr.splitlines()
    assert all(note.startswith("note: ") for note in notes)
    return line


@pytest.fixture(scope="module")
def killed(tmp_path_factory):
    """The folder of a run that was killed after 1.5 of 4 s."""
    folder = tmp_path_factory.mktemp("killed")
    (folder / "killed.toml").write_text(SCENARIO.format(duration=4.0, every=50))
    results = folder / "results"
    process = begin(folder / "killed.toml", "--fields", "-o", results)
    killed_when(process, lambda: len(rows_of(results)) >= 150)
    return results


@pytest.fixture
def copy(killed, tmp_path):
    return shutil.copytree(killed, tmp_path / "copy")


def test_killed_twice_and_resumed_it_is_the_run_left_alone(killed, copy, tmp_path):
    """To the last bit, fields and all: killed as it runs, and once more as it draws."""
    whole = tmp_path / "whole"
    done = stickslip_here(".", "run", killed.parent / "killed.toml", "--fields", "-o", whole)
    assert done.returncode == 0, done.stderr
    expected = xr.load_dataset(whole / "result.nc")
    assert check_record(copy, expected) >= 150
    killed_when(begin("--resume", copy), (copy / "result.nc").exists)
    done = stickslip_here(".", "run", "--resume", copy)
    assert done.returncode == 0, done.stderr
    found = xr.load_dataset(copy / "result.nc")
    assert list(found.variables) == list(expected.variables)
    for name in expected.variables:
        assert found[name].values.tobytes() == expected[name].values.tobytes(), name
    for key in expected.attrs.keys() - OF_THE_MAKING:
        assert found.attrs[key] == expected.attrs[key], key
    files = [path.relative_to(whole) for path in (whole / "fields").iterdir()]
    for name in (*files, "result.csv"):
        assert (copy / name).read_bytes() == (whole / name).read_bytes(), name
    assert len(files) == len(list((copy / "fields").iterdir())) > 10
    assert not (copy / "unfinished").exists()


@pytest.mark.parametrize("key, was", [("stickslip", "0.0.1"), ("GUID of mechanics", "{another}")])
def test_another_version_or_unit_is_refused(copy, key, was):
    path = copy / "unfinished" / "checkpoint.zip"
    old = load_checkpoint(path)
    setup = dict(old.setup) | {key: was}
    save_checkpoint(path, type(old)(old.time, setup, old.master, old.states, old.record))
    assert f'{key}: was "{was}", is ' in refused("run", "--resume", copy)


def test_another_case_is_refused(copy):
    path = copy / "unfinished" / "scenario.toml"
    path.write_text(path.read_text().replace("mass = 0.67", "mass = 0.7"))
    assert "rig.mass: was 0.67, is 0.7" in refused("run", "--resume", copy)


@pytest.mark.parametrize(
    "further", [["slab"], ["-o", "x"], ["--fmu", "x"], ["--animation"], ["--force"]], ids=str
)
def test_a_run_that_goes_on_takes_nothing_else(copy, further):
    assert "as it was begun" in refused("run", "--resume", copy, *further)


def test_ctrl_c_leaves_results_and_what_goes_on(tmp_path):
    (tmp_path / "case.toml").write_text(SCENARIO.format(duration=1000.0, every=10**9))
    results = tmp_path / "results"
    process = begin(tmp_path / "case.toml", "-o", results)
    while len(rows_of(results)) < 100:
        time.sleep(0.01)
    for other in (("run", tmp_path / "case.toml", "-o", results), ("run", "--resume", results)):
        assert "another process is at work" in refused(*other)
    os.kill(process.pid, signal.SIGINT)
    _, said = process.communicate(timeout=600)
    assert process.returncode == 1
    *others, line = said.splitlines()
    # a run of more than a minute says so first; a block that has left its belt is told of
    assert all(other.startswith(("note: ", "warning: ")) for other in others), said
    assert re.fullmatch(
        rf"error: interrupted at t = [\d.]+( s)?; what was computed is in {results}"
        rf", and this goes on from there: stickslip run --resume {results}",
        line,
    )
    made = json.loads((results / "made_by.json").read_text())
    assert made["status"] == "incomplete" and "duration = 1000.0" in made["scenario"]
    for command in ("run", "simulate"):
        line = refused(command, tmp_path / "case.toml", "-o", results)
        assert f"go on with it: stickslip run --resume {results}" in line and "--force" in line
    summary = json.loads((results / "summary.json").read_text())
    checkpoint = load_checkpoint(results / "unfinished" / "checkpoint.zip")
    assert checkpoint.time == summary["time_reached"] > 0.9
    with xr.open_dataset(results / "result.nc") as dataset:
        assert check_record(results, dataset) == dataset.sizes["time"]
