"""The command line in this process: arguments, refusals, closing lines."""

import os
import shlex
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path

import pytest
from command_line import python, refusal

from cosim.cli import main, warnings_in_one_line
from cosim.cli.arguments import COMMANDS, command_module, parser

pytestmark = pytest.mark.usefixtures("elsewhere")


#: Commands that compute no figures.
NO_FIGURES = set("campaign build completion docs effect explore new plot schema".split())


@pytest.mark.parametrize("command", ["", *COMMANDS])
def test_help_has_an_example_and_what_all_commands_take(capsys, command):
    with pytest.raises(SystemExit) as stop:
        main([*command.split(), "--help"])
    out = " ".join(capsys.readouterr().out.split())
    assert stop.value.code == 0 and f"example: stickslip {command}" in out
    if command:
        assert "-q, --quiet" in out and "-v, --verbose" in out
        assert ("--json [FILE]" in out) == (command not in NO_FIGURES)


def test_version(capsys):
    with pytest.raises(SystemExit) as stop:
        main(["--version"])
    assert stop.value.code == 0
    assert capsys.readouterr().out == f"stickslip {version('stickslip')}\n"


@pytest.mark.parametrize("argv, line", [
    ([], "the following arguments are required: COMMAND"),
    (["rnu"], "invalid choice: 'rnu'"),
    (["run", "--out", "x"], "unrecognized arguments: --out"),
    (["build", "--native"], "unrecognized arguments: --native"),
    (["build", "StickSlip.fmu"], "argument UNIT: no unit is named 'StickSlip.fmu'; nearest: "),
    (["build", "--platforms", "x86"], "argument --platforms: no platform is named 'x86'"),
    (["run", "a.toml", "b.toml"], "unrecognized arguments: b.toml"),
])  # fmt: skip
def test_arguments_that_do_not_exist_are_refused(capsys, argv, line):
    assert line in refusal(capsys, *argv)


@pytest.mark.parametrize(
    "options", [["--fmu", "bad"], ["--fmu", "bad", "--fields"], ["--set", "ice.mesh=bad"]]
)
def test_a_run_refused_before_its_first_step_leaves_no_folder(capsys, elsewhere, options):
    Path("bad").write_text("of no kind")
    assert "bad" in refusal(capsys, "run", "-q", *options, "-o", "out")
    assert not Path("out").exists()


def test_rows_between_macro_steps_are_refused_for_run_only(capsys, tmp_path):
    (tmp_path / "case.toml").write_text("[run]\noutput_interval = 0.015")
    line = refusal(capsys, "run", "case.toml")
    assert line.startswith("case.toml: run.output_interval: 0.015 s does not fall on the macro")
    (tmp_path / "case.toml").write_text("[run]\nduration = 1.0\n[coupling]\nmacro_step = 1e-9")
    line = refusal(capsys, "run", "case.toml")
    assert line.startswith("case.toml: coupling.macro_step: 1e-09 s cuts run.duration = 1 s into")
    assert main(["simulate", "case.toml"]) == 0


def test_a_folder_that_cannot_be_written_is_refused_before_anything_is_computed(capsys, tmp_path):
    (tmp_path / "taken").write_text("a file")
    for command in ("run", "simulate"):
        for folder in ("taken", "taken/below"):
            line = refusal(capsys, command, "-o", folder)
            assert line.startswith(f"{folder}: cannot be written to (")
    assert refusal(capsys, "build", "-o", "taken").startswith("taken: cannot be written to")
    assert (tmp_path / "taken").read_text() == "a file"
    assert [path.name for path in tmp_path.iterdir()] == ["taken"]


def test_a_name_that_a_folder_has_taken_is_refused(capsys, tmp_path):
    (tmp_path / "out" / "result.nc").mkdir(parents=True)
    assert refusal(capsys, "simulate", "-o", "out").startswith("out/result.nc: is a folder")


def test_debug_shows_the_traceback_on_either_side_of_the_command(capsys):
    for argv in (["--debug", "run", "nix.toml"], ["run", "nix.toml", "--debug"]):
        assert main(argv) == 2
        err = capsys.readouterr().err
        assert "Traceback" in err and err.splitlines()[-1].startswith("error: nix.toml: no such")


def test_a_fault_of_ours_is_one_line_and_no_bad_input(capsys, monkeypatch):
    def broken(*_):
        raise RuntimeError("spring\nbroke")

    monkeypatch.setattr("cosim.cli.authoring.build.build_fmu", broken)
    assert main(["build"]) == 1
    assert capsys.readouterr().err == "error: spring broke (--debug shows where)\n"


def test_an_error_is_short_however_long_a_name_in_a_file_is(capsys, tmp_path):
    """Its beginning names the file, its end what is allowed."""
    (tmp_path / "long.toml").write_text(f"{'y' * 1_000_000} = 1\n", encoding="utf-8")
    line = refusal(capsys, "simulate", "long.toml")
    assert line.startswith("long.toml: yyy") and ": no such key, known: " in line
    assert len(line) < 2100


def test_our_warnings_are_one_line_each_and_come_once(capsys):
    import warnings

    with warnings_in_one_line():
        for _ in range(2):
            warnings.warn("mu_k exceeds\nmu_s", stacklevel=1)
            warnings.warn("of a library", DeprecationWarning, stacklevel=1)
    assert capsys.readouterr().err == "warning: mu_k exceeds mu_s\n"


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_has_the_same_shape(name):
    """Arguments, what it does, and an example that its own arguments allow."""
    words = shlex.split(COMMANDS[name]["example"])
    assert words[:2] == ["stickslip", name]
    assert parser(words).parse_args(words[1:]).command == name
    assert callable(command_module(name).execute)


def test_help_imports_nothing_that_computes():
    """It is there at once: what a command computes with takes a second or two to import."""
    program = (
        "import sys; from cosim.cli.arguments import parser\n"
        "heavy = {'scipy', 'pandas', 'xarray', 'matplotlib', 'fmpy', 'skfem', 'pydantic'}\n"
        "for name in sys.argv[1:]:\n"
        "    parser([name]).format_help()\n"
        "    print(name, *sorted(heavy & set(sys.modules)))"
    )
    names = ["", *sorted(COMMANDS)]
    assert [line.rstrip() for line in python(program, *names).splitlines()] == names


@pytest.mark.parametrize(("given", "used"), [({}, "1"), ({"OPENBLAS_NUM_THREADS": "3"}, "3")])
def test_runs_beside_each_other_do_not_wait_for_each_others_threads(given, used):
    """BLAS reads its number of threads when numpy is imported, which must come after."""
    environment = {k: v for k, v in os.environ.items() if k != "OPENBLAS_NUM_THREADS"} | given
    program = (
        "import os, sys; from cosim.cli import main; assert 'numpy' not in sys.modules;"
        "main(['simulate', 'nix.toml']); assert 'numpy' in sys.modules;"
        "print(os.environ['OPENBLAS_NUM_THREADS'])"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], env=environment, capture_output=True, text=True
    )
    assert done.stdout.strip() == used
    assert done.stderr.startswith("error: nix.toml: no such file") and done.stderr.count("\n") == 1
