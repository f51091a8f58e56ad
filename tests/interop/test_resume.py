"""A run that is killed, and resumed from its folder; what cannot be is refused."""

import json
import os
import shutil
import signal
import time

import pytest
import xarray as xr
from command_line import stickslip_here
from kill_and_resume import SCENARIO, at_rows, begin, check_record, kill_and_resume, kill_in

from cosim.coupling.record.checkpoint import load_checkpoint, save_checkpoint


def refused(*arguments):
    """Its one line."""
    done = stickslip_here(".", *arguments)
    assert done.returncode == 2, done.stderr
    (line,) = done.stderr.splitlines()
    return line


def test_killed_and_gone_on_with_it_is_the_run_left_alone(tmp_path):
    """Twice while it runs and once while it draws."""
    assert kill_and_resume(tmp_path, kills=3, seed=5, duration=3.0, every=40) == []


@pytest.fixture(scope="module")
def killed(tmp_path_factory):
    """The folder of a run that was killed after 1.5 of 4 s."""
    folder = tmp_path_factory.mktemp("killed")
    (folder / "killed.toml").write_text(SCENARIO.format(duration=4.0, every=50))
    results = folder / "results"
    assert kill_in(begin(folder / "killed.toml", results), at_rows(results, 150), 0.0)
    return results


@pytest.fixture
def copy(killed, tmp_path):
    return shutil.copytree(killed, tmp_path / "copy")


def change(folder, **changes):
    path = folder / "unfinished" / "checkpoint.zip"
    old = load_checkpoint(path)
    setup = dict(old.setup) | changes
    save_checkpoint(path, type(old)(old.time, setup, old.master, old.states, old.record))


def test_the_folder_says_that_its_run_is_not_complete(killed):
    said = (killed / "unfinished" / "README.txt").read_text(encoding="utf-8")
    assert f"stickslip run --resume {killed}" in said
    assert not (killed / "result.nc").exists()


@pytest.mark.parametrize("key, was", [("stickslip", "0.0.1"), ("GUID of mechanics", "{another}")])
def test_another_version_or_unit_is_refused(copy, key, was):
    change(copy, **{key: was})
    assert f'{key}: was "{was}", is ' in refused("run", "--resume", copy)


def test_another_case_is_refused(copy):
    path = copy / "unfinished" / "scenario.toml"
    path.write_text(path.read_text().replace("mass = 0.67", "mass = 0.7"))
    assert "rig.mass: was 0.67, is 0.7" in refused("run", "--resume", copy)


def test_a_record_that_is_gone_is_refused(copy):
    (copy / "unfinished" / "record.npy").unlink()
    assert "record.npy: " in refused("run", "--resume", copy)


def test_nothing_to_go_on_with_is_refused(tmp_path):
    assert "holds no unfinished run" in refused("run", "--resume", tmp_path)
    assert "no such folder" in refused("run", "--resume", tmp_path / "none")


@pytest.mark.parametrize(
    "further", [["slab"], ["-o", "x"], ["--fmu", "x"], ["--animation"], ["--force"]], ids=str
)
def test_a_run_that_goes_on_takes_nothing_else(copy, further):
    assert "as it was begun" in refused("run", "--resume", copy, *further)


def test_ctrl_c_leaves_results_and_what_goes_on(tmp_path):
    (tmp_path / "case.toml").write_text(SCENARIO.format(duration=1000.0, every=10**9))
    results = tmp_path / "results"
    process = begin(tmp_path / "case.toml", results)
    is_now = at_rows(results, 100)
    while not is_now():
        time.sleep(0.01)
    again = stickslip_here(tmp_path, "run", tmp_path / "case.toml", "-o", results)
    assert again.returncode == 2 and "another process is at work" in again.stderr
    os.kill(process.pid, signal.SIGINT)
    _, said = process.communicate(timeout=600)
    assert process.returncode == 1
    *others, line = said.splitlines()
    # a run of more than a minute says so first; a block that has left its belt is told of
    assert all(other.startswith(("note: ", "warning: ")) for other in others), said
    assert line.startswith("error: ") and f"stickslip run --resume {results}" in line
    made = json.loads((results / "made_by.json").read_text())
    assert made["status"] == "incomplete" and "duration = 1000.0" in made["scenario"]
    for command in ("run", "simulate"):
        again = stickslip_here(tmp_path, command, tmp_path / "case.toml", "-o", results)
        assert again.returncode == 2
        line = again.stderr.splitlines()[-1]  # behind the note on how long it takes
        assert f"go on with it: stickslip run --resume {results}" in line and "--force" in line
    summary = json.loads((results / "summary.json").read_text())
    checkpoint = load_checkpoint(results / "unfinished" / "checkpoint.zip")
    assert checkpoint.time == summary["time_reached"] > 0.9
    with xr.open_dataset(results / "result.nc") as dataset:
        assert check_record(results, dataset) == dataset.sizes["time"]
