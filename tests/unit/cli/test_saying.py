"""What is said beside the results: notes, more with -v, less with -q; and the numbers as JSON."""

import json
import logging
import sys
from pathlib import Path

import pytest
from command_line import refusal
from stickslip import Parameters, compiled, machine_code, simulate
from stickslip.catalogue import CATALOGUE

from cosim.cli import main
from cosim.cli.arguments import parser
from cosim.cli.bar import Bar
from cosim.cli.console import note, saying
from cosim.cli.scenarios import note_taken
from cosim.fmu.libraries import WAITING
from cosim.scenario import read_scenario

SHORT = "[run]\nduration = 0.5\n"


pytestmark = pytest.mark.usefixtures("elsewhere")


@pytest.fixture
def case(tmp_path):
    (tmp_path / "case.toml").write_text(SHORT)
    return "case.toml"


def test_quiet_leaves_results_and_warnings(case, capsys):
    assert main(["simulate", case, "-q", "--set", "friction.mu_k=0.5"]) == 0
    out, err = capsys.readouterr()
    assert out.startswith("case: 0.5 s") and "results" in out
    assert err.startswith("warning: friction.mu_k = 0.5 exceeds") and err.count("\n") == 1


def test_verbose_names_the_files_as_they_are_written(case, capsys):
    assert main(["simulate", case, "-v", "-o", "out"]) == 0
    said = capsys.readouterr().err.splitlines()
    assert [line for line in said if line.startswith("note: left to the defaults")]
    for name in ("result.nc", "summary.json", "report.html"):
        assert f"writing out/{name}" in said


@pytest.mark.parametrize(("text", "named"), [("", True), (SHORT, False)])
def test_a_file_that_sets_nothing_is_named(tmp_path, capsys, text, named):
    file = tmp_path / "case.toml"
    file.write_text(text)
    note_taken(read_scenario(file))
    err = capsys.readouterr().err
    assert err.startswith("note: case sets nothing beside the defaults; left to") is named
    assert "left to the defaults: rig.spring_natural_length" in err


def test_how_much_is_said_ends_with_the_command(capsys):
    with saying(quiet=True, verbose=False):
        note("nothing")
        assert Bar(total=1).disable
    note("something")
    assert capsys.readouterr().err == "note: something\n"
    assert not logging.getLogger("cosim").handlers


def test_without_a_terminal_a_bar_is_a_line_a_minute_with_its_end(capsys):
    with Bar(total=4, unit="step") as bar:
        begun = bar.start_t
        for seconds in (59.0, 61.0, 90.0, 130.0):
            bar._time = lambda now=begun + seconds: now
            bar.update()
    said = capsys.readouterr().err.splitlines()
    assert [line.split("|")[0] for line in said] == ["50%", "100%"]
    assert "2/4 [01:01<01:01" in said[0]


@pytest.fixture
def not_compiled(monkeypatch, tmp_path):
    monkeypatch.setattr(machine_code, "_folders", lambda: [tmp_path / "cache"])
    monkeypatch.setattr(machine_code, "PREBUILT", "none")
    monkeypatch.setattr(machine_code, "CALLED_BY_NAME", ("-O0", "-fvisibility=default"))  # quick
    vars(CATALOGUE).pop("compiled", None)
    yield
    vars(CATALOGUE).pop("compiled", None)


COMPILING = "compiling the mechanical model for this machine, once: a few seconds"


def test_what_compiles_says_so_before_it_begins(case, not_compiled, capsys, monkeypatch):
    """Also where stderr is no terminal, as in a log; once."""
    make, said = compiled.sources, []
    monkeypatch.setattr(
        compiled, "sources", lambda text: said.append(capsys.readouterr().err) or make(text)
    )
    assert main(["simulate", case]) == 0
    assert said[0].splitlines()[-1] == f"note: {COMPILING}"
    assert "compiling" not in capsys.readouterr().err
    vars(CATALOGUE).pop("compiled", None)
    assert main(["simulate", case, "-o", "again"]) == 0
    assert "compiling" not in capsys.readouterr().err


@pytest.mark.parametrize("watched", [True, False])
def test_what_a_terminal_waits_for_is_said_there_alone(watched, capsys, monkeypatch):
    monkeypatch.setattr(sys.stderr, "isatty", lambda: watched)
    with saying(quiet=False, verbose=False):
        logging.getLogger("cosim.fmu.libraries").log(WAITING, "compiling")
    assert capsys.readouterr().err == ("note: compiling\n" if watched else "")


def test_quiet_does_not_say_what_compiles_and_python_does(case, not_compiled, capsys, caplog):
    assert main(["simulate", case, "-q"]) == 0
    assert capsys.readouterr().err == ""
    for file in Path("cache").iterdir():
        file.unlink()
    vars(CATALOGUE).pop("compiled", None)
    caplog.clear()
    simulate(Parameters(), 0.01)
    (record,) = caplog.records
    assert record.levelname == "WARNING" and record.getMessage() == COMPILING


class TestJson:
    def test_in_a_file_it_is_beside_the_lines(self, case, capsys, tmp_path):
        for _ in range(2):  # an earlier one is overwritten
            assert main(["simulate", case, "--json", "deep/numbers.json"]) == 0
        assert "results" in capsys.readouterr().out
        assert json.loads((tmp_path / "deep" / "numbers.json").read_text())["name"] == "case"

    def test_a_file_of_somebody_else_stays(self, case, capsys, tmp_path):
        for content in ("mine", "[]", "{}", '[{"name": 1}]'):
            (tmp_path / "numbers.json").write_text(content)
            assert "is there and no result of this command" in refusal(
                capsys, "simulate", case, "--json", "numbers.json"
            )
            assert (tmp_path / "numbers.json").read_text() == content

    @pytest.mark.parametrize(
        "argv", [["simulate", "--json", "study"], ["effects", "--json", "film_drag"]]
    )
    def test_what_was_meant_to_be_computed_is_not_written_to(self, argv, capsys, tmp_path):
        with pytest.raises(SystemExit) as stop:
            parser(argv).parse_args(argv)
        assert stop.value.code == 2
        assert f"{argv[-1]} is no name of a file" in capsys.readouterr().err
        assert not list(tmp_path.iterdir())

    def test_the_catalogue_can_be_written_twice(self, capsys, tmp_path):
        for _ in range(2):
            assert main(["effects", "film_drag", "--json", "effects.json"]) == 0
        (entry,) = json.loads((tmp_path / "effects.json").read_text())
        assert entry["id"] == "film_drag"
