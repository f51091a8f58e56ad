"""Kind and size of a file are asked before it is read: what would take for ever is one line."""

import os
import time
import zipfile

import pytest
from command_line import refusal

from cosim.coupling.fmu.archive import DESCRIPTION, read_xml

MIB = 2**20


@pytest.fixture
def refused(capfd, tmp_path, monkeypatch):
    """Arguments -> the one line that they are refused with, soon."""
    monkeypatch.chdir(tmp_path)

    def refuse(*arguments):
        begun = time.process_time()
        line = refusal(capfd, *arguments)
        assert time.process_time() - begun < 10.0
        return line

    return refuse


def large(name, mib, text=""):
    with open(name, "wb") as file:
        file.write(text.encode())
        file.truncate(mib * MIB)
    return name


COMMANDS = ("simulate", "run", "couple", "gap", "plan")


@pytest.mark.parametrize("command", COMMANDS)
def test_a_toml_file_of_100_mib(command, refused):
    assert "100 MiB, allowed are 4 MiB" in refused(command, large("case.toml", 100))


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes")
@pytest.mark.parametrize("command", COMMANDS)
def test_a_named_pipe_that_nobody_writes_to(command, refused):
    os.mkfifo("case.toml")
    line = refused(command, "case.toml")
    assert "not a file" in line or "no regular file" in line


@pytest.mark.skipif(not os.path.exists("/dev/zero"), reason="no devices")
@pytest.mark.parametrize("text", [
    'effects = ["{0}"]', '[friction]\ntable = "{0}"', '[ice]\nmesh = "{0}"',
    '[units.a]\nfile = "{0}"\n[run]\nstop = 1.0\n',
    '[[run]]\nfile = "{0}"\nmass = 0.67\nstiffness = 20.17\nsurface_speed = 0.15\n',
])  # fmt: skip
@pytest.mark.parametrize("named", ["/dev/zero", "pipe", "large"])
def test_a_file_that_a_file_names(text, named, refused):
    os.mkfifo("pipe")
    large("large", 300, "t,x\n0,0\n")
    command = "couple" if "units" in text else "gap" if "[[run]]" in text else "run"
    open("case.toml", "w").write(text.format(named))
    line = refused(command, "case.toml")
    said = {"/dev/zero": "file", "pipe": "file", "large": "MiB, allowed"}[named]
    assert named in line and (said in line or "not an FMU" in line)


def test_a_shell_s_pipe_is_read(tmp_path, capsys):
    reads, writes = os.pipe()
    os.write(writes, b"[rig]\nmas = 1\n")
    os.close(writes)
    assert "rig.mas" in refusal(capsys, "simulate", f"/dev/fd/{reads}")


@pytest.mark.parametrize("text", [
    "name = " + 50_000 * "[" + 50_000 * "]",
    "name = " + 100 * "[" + 100 * "]",
    "a" + 50_000 * ".a" + " = 1",
    "[" + 50_000 * '"a" . ' + "a]",
    "a = " + 300 * "{a = " + "1" + 300 * "}",
], ids=["lists", "a few lists", "a key", "a table", "tables"])  # fmt: skip
@pytest.mark.parametrize("command", ["simulate", "couple"])
def test_a_toml_file_that_is_nested_deeply(text, command, refused):
    open("case.toml", "w").write(text)
    assert "nested too deeply, allowed are 64 levels" in refused(command, "case.toml")


def test_an_attribute_of_20_mb_is_looked_at_once(tmp_path):
    """It was begun anew with every piece of it that was read: minutes."""
    text = f'<?xml version="1.0"?><fmiModelDescription description="{20_000_000 * "a"}"/>'
    with zipfile.ZipFile(tmp_path / "unit.fmu", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(DESCRIPTION, text)
    begun = time.process_time()
    assert read_xml(tmp_path / "unit.fmu", DESCRIPTION) == text.encode()
    assert time.process_time() - begun < 5.0
