"""Machine code is kept where nobody else can write, and is done without where nothing is kept."""

import logging
import os
import shutil
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
from stickslip import Parameters, compiled, machine_code, simulate
from stickslip.arrays import RunArrays, inputs
from stickslip.catalogue import CATALOGUE
from stickslip.generation.platforms import this_machine
from stickslip.kernel.layout import O_SIZE

TEXT = "def advance(x: float) -> float:\n    return x + 1.0\n"
#: Compiles a kernel of one line; prints what it gives, and whether it was there before.
PROGRAM = f"""
import logging
from stickslip import compiled, machine_code
told = []
machine_code.LOG.addFilter(lambda record: told.append(record.getMessage()))
advance = compiled.library({TEXT!r}).advance
print(advance(1.0), not any("compiling" in each for each in told))
"""
#: Number of somebody else.
NOBODY = 65534

posix = pytest.mark.skipif(not hasattr(os, "getuid"), reason="a folder has no owner")


def run(cache, scratch):
    """What PROGRAM prints in a process with these folders, which permissions bind, root's too."""
    bound = ["setpriv", "--bounding-set=-dac_override"] if os.getuid() == 0 else []
    env = os.environ | {"XDG_CACHE_HOME": str(cache), "TMPDIR": str(scratch)}
    words = [*bound, sys.executable, "-c", PROGRAM]
    done = subprocess.run(words, env=env, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


@pytest.mark.skipif(sys.platform != "linux", reason="needs setpriv where root runs it")
def test_a_cache_that_was_filled_and_can_only_be_read_is_used(tmp_path):
    """As in a container, or in continuous integration."""
    cache, scratch = tmp_path / "cache", tmp_path / "scratch"
    cache.mkdir()
    scratch.mkdir()
    assert run(cache, scratch) == ["2.0", "False"]
    filled = (cache / "stickslip", cache, scratch)
    for folder in filled:
        folder.chmod(0o555)
    try:
        assert run(cache, scratch) == ["2.0", "True"]
    finally:
        for folder in filled:
            folder.chmod(0o755)


@pytest.fixture
def keeps(tmp_path, monkeypatch):
    """The folder that a kernel is kept in, None for none, and what it may be."""
    monkeypatch.setattr(machine_code.platformdirs, "user_cache_path", lambda name: tmp_path / name)
    monkeypatch.setattr(machine_code.tempfile, "gettempdir", lambda: str(tmp_path))

    def keep():
        file = machine_code.keep("kernel", b"machine code")
        return None if file is None else file.parent

    return keep, tmp_path / "stickslip", tmp_path / f"stickslip-{os.getuid()}"


def test_where_nothing_can_be_kept_it_is_compiled_for_this_process(tmp_path, monkeypatch):
    (tmp_path / "file").touch()
    monkeypatch.setattr(machine_code, "_folders", lambda: [tmp_path / "file" / "x"])
    library = compiled.library(TEXT)
    assert isinstance(library, compiled.Library) and library.advance(1.0) == 2.0
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


@posix
def test_machine_code_is_not_kept_where_others_can_write(keeps, caplog):
    keep, mine, scratch = keeps
    assert keep() == mine and not scratch.exists()
    mine.chmod(0o777)
    with caplog.at_level(logging.WARNING):
        assert keep() == scratch
    assert f"chmod go-w {mine}" in caplog.text
    assert scratch.stat().st_mode & 0o777 == 0o700


@posix
@pytest.mark.skipif(not hasattr(os, "getuid") or os.getuid() != 0, reason="needs two users")
def test_a_folder_or_link_of_another_user_in_its_place_is_not_used(keeps):
    keep, mine, scratch = keeps
    mine.mkdir()
    os.chown(mine, NOBODY, NOBODY)
    elsewhere = mine.with_name("elsewhere")
    elsewhere.mkdir(mode=0o700)
    scratch.symlink_to(elsewhere)
    os.chown(scratch, NOBODY, NOBODY, follow_symlinks=False)
    assert keep() is None
    (mine / compiled.code(TEXT).file(this_machine())).write_bytes(b"somebody else's")
    assert compiled.library(TEXT).advance(1.0) == 2.0


@pytest.mark.parametrize("damage", [b"", b"\x7fELF and then nothing", None])
def test_a_damaged_library_is_compiled_again(tmp_path, monkeypatch, damage):
    """A process that loaded a shortened one would be ended by the system."""
    monkeypatch.setattr(machine_code, "_folders", lambda: [tmp_path])
    file = tmp_path / compiled.code(TEXT).file(this_machine())
    assert compiled.library(TEXT).advance(1.0) == 2.0
    whole = file.read_bytes()
    file.unlink()  # the loaded one stays as it is
    file.write_bytes(whole[: len(whole) // 2] if damage is None else damage)
    library = compiled.library(TEXT)
    assert isinstance(library, compiled.Library) and library.advance(2.0) == 3.0
    assert file.read_bytes() == whole


def test_without_a_compiler_it_runs_interpreted_and_says_so(tmp_path, monkeypatch, caplog):
    monkeypatch.setattr(machine_code, "_folders", lambda: [tmp_path])
    monkeypatch.setattr(machine_code, "PREBUILT", "none")  # an installed package has one
    monkeypatch.setattr(shutil, "which", lambda name: None)
    monkeypatch.setattr("stickslip.generation.compiler.has_zig", lambda: False)
    vars(CATALOGUE).pop("compiled", None)
    try:
        slow = simulate(Parameters(), 1.0)
    finally:
        vars(CATALOGUE).pop("compiled", None)
    assert "`pip install ziglang`" in caplog.text and "interpreted" in caplog.text
    monkeypatch.undo()
    np.testing.assert_array_equal(slow["x"], simulate(Parameters(), 1.0)["x"])


def test_a_package_brings_the_library_along(tmp_path, monkeypatch):
    compiled.code(TEXT).prebuild(tmp_path / machine_code.PREBUILT, [this_machine()])
    monkeypatch.setattr(machine_code, "__file__", str(tmp_path / "machine_code.py"))
    monkeypatch.setattr(machine_code, "compiled", None)  # nothing is compiled
    assert compiled.library(TEXT).advance(1.0) == 2.0


def test_threads_compute_at_the_same_time():
    """A call lets other threads go on: they count while one call simulates an hour."""
    parameters = Parameters()
    run = RunArrays.begin(parameters.pack(), inputs(parameters.surface.speed, -8.0))
    times, counted, ended = np.arange(0.0, 3000.0, 1.0), [0], threading.Event()
    o = np.zeros(O_SIZE * len(times))

    def record():
        run.kernel.record(*run.all, times, o, 0, len(times), True)
        ended.set()

    thread = threading.Thread(target=record)
    thread.start()
    while not ended.is_set():
        counted[0] += 1
        time.sleep(0.001)
    thread.join()
    assert counted[0] > 20
