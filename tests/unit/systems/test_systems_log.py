"""What units say in a run of a system: in a file beside the results, on the terminal if asked."""

import json
import subprocess
import sys

import pytest
from c_units import made
from command_line import python, refusal

from cosim.cli import main

SEGFAULT, PRINTS, LOGS, LOGS_ERROR = 1, 6, 7, 8
SYSTEM = """
coupling.macro_step = 0.25
run = {{ stop = 1.0, checkpoint_seconds = 0 }}
[units]
calm.file = "faulty.fmu"
loud.file = "faulty.fmu"
loud.parameters.fault = {fault}
loud.parameters.at = 0.25
third = {{ file = "faulty.fmu", parameters = {{ fault = {other}, at = 0.5 }} }}
"""


@pytest.fixture
def system(tmp_path):
    """A file of three units, by the fault of the second from 0.25 s on, of the third from 0.5."""
    made("faulty", tmp_path)

    def write(fault, other=0, **replaced):
        text = SYSTEM.format(fault=fault, other=other)
        for old, new in replaced.values():
            assert old in text
            text = text.replace(old, new)
        (tmp_path / "system.toml").write_text(text)
        return str(tmp_path / "system.toml")

    return write


def rows(folder):
    lines = (folder / "messages.log").read_text(encoding="utf-8").splitlines()
    return [tuple(line.split("\t")[1:]) for line in lines if not line.startswith("#")]


WARNINGS = [(f"{time}", "loud", "warning", "heat", "warm") for time in (0.25, 0.5, 0.75)]


def test_messages_are_in_a_file_and_two_lines_say_so(system, tmp_path, capsys):
    folder = tmp_path / "out"
    assert main(["couple", system(LOGS), "-o", str(folder)]) == 0
    assert rows(folder) == WARNINGS
    said = capsys.readouterr()
    note = f"note: 3 messages (3 warnings) in {folder / 'messages.log'}\n"
    assert said.err == note + "warning: loud: t = 0.25 s: warm\n"
    assert "warm" not in said.out
    numbers = json.loads((folder / "summary.json").read_text())
    assert [each["messages"] for each in numbers["participants"].values()] == [0, 3, 0]
    assert 'href="messages.log"' in (folder / "report.html").read_text()


def test_a_text_is_set_as_it_is(system, tmp_path):
    told = ("at = 0.25\n", 'at = 2.0\nloud.parameters.text = "as it is"\n')
    assert main(["couple", system(LOGS, told=told), "-o", str(tmp_path / "out")]) == 0
    assert ("", "loud", "warning", "texts", "as it is") in rows(tmp_path / "out")


def test_verbose_shows_them_and_asks_for_more(system, tmp_path, capsys):
    assert main(["couple", system(LOGS), "-v", "--json", "-o", str(tmp_path / "out")]) == 0
    said = capsys.readouterr()
    assert said.err.splitlines()[:2] == [
        "loud: t = 0.25 s: ok [debug]: all is well",
        "loud: t = 0.25 s: warning [heat]: warm",
    ]
    (note,) = [line for line in said.err.splitlines() if line.startswith("note: ")]
    assert note.startswith("note: 6 messages (3 warnings) in ")
    assert f"writing {tmp_path / 'out' / 'summary.json'}" in said.err.splitlines()
    json.loads(said.out)


def test_what_an_isolated_unit_writes_is_in_it(system, tmp_path, capfd):
    alone = ("loud.file", "loud.isolate = true\nloud.file")
    folder = tmp_path / "out"
    assert main(["couple", system(PRINTS, alone=alone), "-o", str(folder)]) == 0
    assert {row[1:] for row in rows(folder)} == {
        ("loud", "output", "", "a line of the unit"),
        ("loud", "output", "", "another"),
    }
    assert capfd.readouterr().err == ""  # lines are no warnings


def test_a_run_that_fails_says_it_in_its_one_line(system, tmp_path, capsys):
    folder = tmp_path / "out"
    assert main(["couple", system(LOGS, LOGS_ERROR), "-o", str(folder)]) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("error: third: failed in the step from t = 0.5 s: too hot; what was ")
    assert line.endswith(f"in {folder}, 3 messages (2 warnings, 1 error) in {folder}/messages.log")


def test_after_a_crash_of_the_whole_process_it_is_there(system, tmp_path):
    command = [sys.executable, "-m", "cosim", "couple", system(LOGS, SEGFAULT)]
    done = subprocess.run([*command, "-o", str(tmp_path / "out")], capture_output=True)
    assert done.returncode < 0  # by a signal
    assert rows(tmp_path / "out") == WARNINGS[:2]


def test_a_system_runs_without_the_models_of_this_package(system, tmp_path):
    """They cost two seconds of processor, more than a small system's run."""
    program = (
        "import sys; from cosim.cli import main; code = main(sys.argv[1:]);"
        "heavy = {'stickslip.compiled', 'skfem', 'meshio', 'scipy.optimize'};"
        "print(sorted(heavy & set(sys.modules)), code)"
    )
    told = python(program, "couple", system(0), "--json", "-o", tmp_path / "out")
    assert told.splitlines()[-1] == "[] 0"


def test_a_log_of_somebody_else_is_left_alone(system, tmp_path, capsys):
    folder = tmp_path / "out"
    folder.mkdir()
    (folder / "messages.log").write_text("of somebody else")
    assert "messages.log" in refusal(capsys, "couple", system(0), "-o", folder)
    assert (folder / "messages.log").read_text() == "of somebody else"
