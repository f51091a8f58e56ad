"""The command as a user has it: a process of its own, real files, real Ctrl-C."""

import json
import os
import pty
import re
import signal
import subprocess
import sys
import termios
import time
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from command_line import SHORT_CASE, stickslip, stickslip_here

MODULE = [sys.executable, "-m", "cosim"]
SCRIPT = Path(sys.executable).with_name("stickslip")
SHORT = SHORT_CASE.format(run_up=0.5, duration=2.0, snapshots=0.5)
RESULTS = {"result.nc", "result.csv", "summary.json", "report.html"}


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """A folder like a checkout's, in which the short case was run once, from nothing."""
    folder = tmp_path_factory.mktemp("place")
    (folder / "build").mkdir()
    (folder / "build" / "units.py").touch()
    (folder / "short.toml").write_text(SHORT)
    done = stickslip(folder, "run", "short.toml", "--fields", "--figures")
    assert (done.returncode, done.stderr) == (0, "")
    return folder


def summary_in(folder):
    return json.loads((folder / "summary.json").read_text(encoding="utf-8"))


def check_readable(folder, status):
    """Data in all forms, of the same rows; the dataset."""
    with xr.open_dataset(folder / "result.nc") as dataset:
        dataset.load()
    # as text first: pandas 2 does not read every number to its last digit
    table = pd.read_csv(folder / "result.csv", usecols=["time", "x"], dtype=str).astype(float)
    assert dataset.attrs["status"] == summary_in(folder)["status"] == status
    np.testing.assert_array_equal(table["time"], dataset["time"])
    np.testing.assert_array_equal(table["x"], dataset["x"])
    assert not list(folder.rglob("*partial*"))
    return dataset


def test_run_leaves_everything_in_its_folder(place):
    results = place / "results" / "short"
    assert RESULTS <= {path.name for path in results.iterdir()}
    assert len(list(results.glob("*.png"))) >= 6
    assert (results / "fields" / "temperature.pvd").is_file()
    dataset = check_readable(results, "complete")
    assert dataset["interface_temperature"].attrs["units"] == "degC"
    assert dataset.sizes["snapshot_time"] == 5
    ledger = summary_in(results)["ledger"]
    assert ledger["mechanics"]["relative_residual"] < 1e-9
    assert ledger["heat"]["relative_residual"] < 1e-10
    assert "temperature.pvd" in (results / "report.html").read_text(encoding="utf-8")


def test_a_second_run_takes_the_fmu_as_it_is_and_repeats_the_first(place):
    fmu = place / "build" / "StickSlip3DOF.fmu"
    before = fmu.stat().st_mtime_ns
    words = [SCRIPT, "run", "short.toml", "-o", "again"]
    done = subprocess.run(words, cwd=place, capture_output=True, text=True, timeout=900)
    assert done.returncode == 0 and fmu.stat().st_mtime_ns == before
    assert 3 <= len(done.stdout.splitlines()) <= 7 and "again/report.html" in done.stdout
    first = pd.read_csv(place / "results" / "short" / "result.csv")
    pd.testing.assert_frame_equal(first, pd.read_csv(place / "again" / "result.csv"))


def test_simulate_needs_no_fmu_and_says_the_same_motion(place, tmp_path):
    (tmp_path / "short.toml").write_text(SHORT)
    done = stickslip_here(tmp_path, "simulate", "short.toml", "-o", "out")
    assert (done.returncode, done.stderr) == (0, "")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["out", "short.toml"]
    alone = check_readable(tmp_path / "out", "complete")
    coupled = check_readable(place / "results" / "short", "complete")
    np.testing.assert_allclose(alone["x"], coupled["x"], atol=1e-8)


@pytest.mark.parametrize("command", ["run", "simulate"])
def test_a_run_that_fails_keeps_what_it_had(place, command):
    """Springs so short and soft that the belt carries the block into one of them."""
    (place / "collapse.toml").write_text(
        SHORT + "[rig]\nspring_length = 0.05\nspring_natural_length = 0.05\n"
        "[springs]\nstiffness = 0.1\n"
    )
    done = stickslip_here(place, command, "collapse.toml", "-o", f"collapse-{command}")
    assert done.returncode == 1, done.stdout
    assert done.stderr.startswith("error: ") and done.stderr.count("\n") == 1
    assert f"what was computed is in collapse-{command}" in done.stderr
    dataset = check_readable(place / f"collapse-{command}", "failed")
    assert 0.1 < dataset["time"][-1] < 2.0


def test_a_refused_run_leaves_earlier_results_alone(place):
    results = place / "results" / "short"
    before = {path: path.stat().st_mtime_ns for path in results.rglob("*")}
    (place / "bad.toml").write_text("name = 'short'\n[rig]\nmass = nan\n")
    for command in ("run", "simulate"):
        assert stickslip_here(place, command, "bad.toml").returncode == 2
    assert {path: path.stat().st_mtime_ns for path in results.rglob("*")} == before


def test_nobody_listening_is_no_traceback(place):
    process = subprocess.Popen(
        [*MODULE, "keys"], cwd=place, stdout=subprocess.PIPE, stderr=subprocess.PIPE
    )
    process.stdout.close()
    assert process.stderr.read() == b"" and process.wait(60) == 1
    process.stderr.close()


class OnTerminal:
    """A command whose stderr is a terminal, so that it draws its progress bar."""

    def __init__(self, folder, *arguments):
        self.terminal, theirs = pty.openpty()
        termios.tcsetwinsize(theirs, (24, 100))  # a new one has no columns to draw in
        self.process = subprocess.Popen(
            [*MODULE, *arguments], cwd=folder, stdout=subprocess.PIPE, stderr=theirs
        )
        os.close(theirs)
        self.said = ""

    def read(self):
        """What came since the last call; "" at the end."""
        try:
            new = os.read(self.terminal, 4096).decode(errors="replace")
        except OSError:  # how Linux says that the other end is closed
            return ""
        self.said += new
        return new

    def wait_for(self, pattern, seconds=120.0):
        end = time.monotonic() + seconds
        while not re.search(pattern, self.said):
            assert self.read() and time.monotonic() < end, self.said

    def finish(self):
        """Exit status; the last line said."""
        while self.read():
            pass
        os.close(self.terminal)
        self.process.stdout.close()
        lines = [line for line in re.split(r"[\r\n]+", self.said) if line.strip()]
        return self.process.wait(60), lines[-1]


def test_a_signal_in_mid_run_keeps_what_was_computed(place):
    """What a batch system or `timeout` sends; of Ctrl-C and a coupled run see `test_resume.py`."""
    (place / "long.toml").write_text(
        'defaults = "plain"\n[run]\nduration = 1e5\noutput_interval = 0.1\n'
    )
    running = OnTerminal(place, "simulate", "long.toml", "-o", "long")
    running.wait_for(r"\| (?!0\.00/)\d+\.\d+/\d+ s")
    running.process.send_signal(signal.SIGTERM)
    status, line = running.finish()
    assert status == 1
    assert re.search(r"error: interrupted at t = [\d.]+( s)?; what was computed is in long$", line)
    dataset = check_readable(place / "long", "interrupted")
    assert 0.0 < summary_in(place / "long")["time_reached"] == dataset["time"][-1] < 1e5
    assert (place / "long" / "report.html").is_file()
