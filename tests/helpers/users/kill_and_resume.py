"""Kill `stickslip run` at random moments, go on each time, and compare with a run left alone.

Every number of result.nc, the table result.csv and the temperature fields are compared bit for bit;
after each kill the rows so far are read with numpy alone and compared with those of the run left
alone.
"""

from __future__ import annotations

import json
import os
import random
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
import xarray as xr

#: Coarse, so that a run takes seconds; friction feels the temperature, so both sides matter.
SCENARIO = """
name = "killed"
[belt]
cell_length = 5e-3
elements = 3
[ice]
axial_elements = 4
[temperature_dependence]
sensitivity = 0.5
[surface]
speed = 0.15
run_up_time = 1.0
[run]
duration = {duration}
output_interval = 0.01
snapshot_interval = 0.25
checkpoint_steps = {every}
checkpoint_seconds = 0
[coupling]
macro_step = 2e-3
"""
#: Differ from run to run in any case: times, and that of each participant.
OF_THE_MAKING = {"created", "versions", "wall_time", "coupling"}
#: The record's name of a row's value -> that of result.nc.
COMPARED = {
    "time": "time",
    "mechanics.x": "x",
    "mechanics.heat": "heat",
    "thermal.interface_temperature": "interface_temperature",
}


def begin(scenario: Path, results: Path) -> subprocess.Popen:
    """Start a run."""
    return _started("run", str(scenario), "--fields", "-o", str(results))


def resume(results: Path) -> subprocess.Popen:
    """Go on with one."""
    return _started("run", "--resume", str(results))


def _started(*arguments: str) -> subprocess.Popen:
    command = [sys.executable, "-m", "cosim", *arguments]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


#: Whether it is time; asked every millisecond.
Moment = Callable[[], bool]


def at_rows(results: Path, rows: int) -> Moment:
    """When the record has so many rows."""

    def is_now() -> bool:
        try:
            return len(np.load(results / "unfinished" / "record.npy", mmap_mode="r")) >= rows
        except (FileNotFoundError, ValueError, EOFError):
            return False  # not there yet, or just being made

    return is_now


def at_file(path: Path) -> Moment:
    """When a file is there."""
    return path.exists


def kill_in(process: subprocess.Popen, moment: Moment, later: float) -> bool:
    """SIGKILL some time (s) after a moment; False when the run ended first."""
    while process.poll() is None and not moment():
        time.sleep(1e-3)
    time.sleep(later)
    if process.poll() is not None:
        return False
    os.kill(process.pid, signal.SIGKILL)
    process.communicate()
    return True


def check_record(results: Path, whole: xr.Dataset) -> int:
    """The rows on disk are those of the run left alone, less the last, which may be between two.

    Returns how many there are.
    """
    unfinished = results / "unfinished"
    rows = np.load(unfinished / "record.npy", mmap_mode="r")
    columns = json.loads((unfinished / "record.json").read_text(encoding="utf-8"))["columns"]
    names = [column["name"] for column in columns]
    for name, variable in COMPARED.items():
        found = np.array(rows[:-1, names.index(name)])
        expected = whole[variable].values[: found.size]
        assert np.array_equal(found, expected), f"{name} of the record differs"
    return len(rows)


def differences(found: Path, expected: Path) -> list[str]:
    """What differs between the results of two runs."""
    differ = []
    one, other = (xr.load_dataset(folder / "result.nc") for folder in (found, expected))
    if list(one.variables) != list(other.variables):
        differ.append(f"variables: {set(one.variables) ^ set(other.variables)}")
    for name in other.variables:
        if one[name].values.tobytes() != other[name].values.tobytes():
            differ.append(f"result.nc: {name}")
    for key in (one.attrs.keys() | other.attrs.keys()) - OF_THE_MAKING:
        if one.attrs.get(key) != other.attrs.get(key):
            differ.append(f"result.nc: attribute {key}")
    names = {p.relative_to(root) for root in (found, expected) for p in (root / "fields").iterdir()}
    for name in sorted({Path("result.csv"), *names}):
        files = [root / name for root in (found, expected)]
        if not all(file.exists() for file in files):
            differ.append(f"{name}: not in both")
        elif files[0].read_bytes() != files[1].read_bytes():
            differ.append(str(name))
    if (found / "unfinished").exists():
        differ.append("the folder still says that the run is not complete")
    return differ


def kill_and_resume(
    folder: Path, kills: int, seed: int, duration: float = 6.0, every: int = 60
) -> list[str]:
    """Run once alone and once with kills, in a folder; what differs."""
    choice = random.Random(seed)
    scenario, whole, killed = folder / "killed.toml", folder / "whole", folder / "killed"
    scenario.write_text(SCENARIO.format(duration=duration, every=every), encoding="utf-8")
    _, said = (alone := begin(scenario, whole)).communicate()
    assert alone.returncode == 0, said
    expected = xr.load_dataset(whole / "result.nc")
    rows = expected.sizes["time"]
    parts = sorted(choice.uniform(0.02, 0.98) for _ in range(kills - 1))
    moments: list[Callable[[], Moment]] = [
        partial(at_rows, killed, int(part * rows)) for part in parts
    ]
    moments.append(partial(at_file, killed / "result.nc"))  # while it draws
    process = begin(scenario, killed)
    for moment in moments:
        if not kill_in(process, moment(), choice.uniform(0.0, 5e-3)):
            _, said = process.communicate()
            assert process.returncode == 0, said
            break
        has_rows = (killed / "unfinished" / "record.npy").exists()
        if has_rows:
            check_record(killed, expected)
        if (killed / "unfinished" / "checkpoint.zip").exists():
            process = resume(killed)
            continue
        refused = resume(killed)
        _, said = refused.communicate()
        assert refused.returncode == 2, said
        assert len(said.splitlines()) == 1, said
        process = begin(scenario, killed)
    _, said = process.communicate()
    assert process.returncode == 0, said
    return differences(killed, whole)
