"""A command line, as its user gives it, or in this process, which is a second or two quicker.

A family of cases goes through a process of its own once, and through this one for the rest.
"""

import argparse
import contextlib
import io
import subprocess
import sys

from cosim.cli import main
from cosim.cli.arguments import add_arguments

#: A coupled case that takes next to no time.
SHORT_CASE = """
defaults = "plain"
surface.run_up_time = {run_up}
run = {{ duration = {duration}, snapshot_interval = {snapshots} }}
belt = {{ cell_length = 5e-3, elements = 3 }}
"""


def written(folder, text, name="case.toml"):
    """A file of a text, or of bytes."""
    path = folder / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def stickslip(folder, *arguments):
    """Of a process of its own, in a folder: exit status, what it printed."""
    return subprocess.run(
        [sys.executable, "-m", "cosim", *map(str, arguments)], cwd=folder, capture_output=True,
        text=True, timeout=900,
    )  # fmt: skip


def python(program, *arguments, **more):
    """What a program in Python prints, which ends well in a process of its own."""
    words = [sys.executable, "-P", "-c", program, *map(str, arguments)]
    done = subprocess.run(words, capture_output=True, text=True, **more)
    assert done.returncode == 0, done.stderr
    return done.stdout


def stickslip_here(folder, *arguments):
    """The same of this process."""
    words, out, err = [str(word) for word in arguments], io.StringIO(), io.StringIO()
    with contextlib.chdir(folder), contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            status = main(words)
        except SystemExit as stop:  # argparse ends the process
            status = stop.code
    return subprocess.CompletedProcess(words, status, out.getvalue(), err.getvalue())


def executed(command, *words):
    """Exit status of a command's module, given these words; what it refuses is raised."""
    parser = argparse.ArgumentParser()
    add_arguments(parser, command.__name__.rpartition(".")[2].replace("_", "-"))
    return command.execute(parser.parse_args([str(word) for word in words]))


def refusal(capsys, *argv):
    """Exit status 2 and one line on stderr, nothing on stdout; the line."""
    capsys.readouterr()
    try:
        status = main([str(word) for word in argv])
    except SystemExit as stop:  # argparse's way
        status = stop.code
    out, err = capsys.readouterr()
    assert (status, out) == (2, "")
    assert err.startswith("error: ") and err.count("\n") == 1
    return err.removeprefix("error: ").strip()
