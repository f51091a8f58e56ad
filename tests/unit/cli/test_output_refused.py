"""Output that goes nowhere, and results that cannot be: a line, a status, nothing lost."""

import os
import subprocess
import sys

import pytest

import cosim.report.bounds
from cosim.cli import main
from cosim.cli.runs.run_io import going_on
from cosim.coupling.record import RunFolder
from cosim.files import OutputError

SHORT = ["--set", "run.duration=0.1", "--set", "surface.run_up_time=0"]

posix = pytest.mark.skipif(os.name == "nt", reason="needs a shell")


def shell(redirected, *arguments):
    words = [sys.executable, "-m", "cosim", *arguments]
    done = subprocess.run(
        ["sh", "-c", f'"$@" {redirected}', "sh", *words], capture_output=True, text=True
    )
    return done.returncode, done.stderr.splitlines()


@posix
def test_a_closed_standard_output_is_said_before_anything_is_computed(tmp_path):
    status, said = shell(">&-", "simulate", "reference", "-o", str(tmp_path / "out"))
    assert status == 2 and said == [
        "error: standard output: is closed, allowed is a file, a pipe, or >/dev/null for none"
    ]
    assert not (tmp_path / "out").exists()


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no such device")
def test_a_standard_output_that_is_full(tmp_path):
    status, said = shell(">/dev/full", "keys", "rig.mass")
    assert status == 1 and said == [
        "error: standard output: No space left on device; files that were written are whole"
    ]


def test_a_run_that_cannot_be_believed_has_failed(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(cosim.report.bounds, "LEDGER_LIMIT", 0.0)
    monkeypatch.setattr(cosim.report.bounds, "LEDGER_JOULES", 0.0)
    assert main(["simulate", "reference", *SHORT, "-o", str(tmp_path / "out")]) == 1
    assert "no number of this run can be believed" in capsys.readouterr().err
    assert (tmp_path / "out" / "result.csv").is_file()


def test_a_full_disk_names_the_command_that_goes_on(tmp_path):
    folder = RunFolder.begun(tmp_path, {}, {})
    for there, said in ((False, "x: no room"), (True, "x: no room; this goes on .*: stickslip r")):
        if there:
            folder.checkpoint.touch()
        with pytest.raises(OutputError, match=f"^{said}$"), going_on(folder, "stickslip r"):
            raise OutputError("x: no room")
