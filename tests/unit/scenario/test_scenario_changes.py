"""`--set key=value`: one way on every command that takes a scenario, checked as a file is."""

import copy
import json

import pytest
from command_line import refusal

from cosim.cli import main
from cosim.scenario import ScenarioError, read_scenario
from cosim.scenario.toml_file import changed_tables, changes_named, changes_of

#: Every command that takes a scenario, with what else it needs.
COMMANDS = {
    "run": (), "simulate": (), "stability": ("--grid", "0"), "friction-map": (), "belt-length": (),
    "sweep": ("--vary", "rig.mass=1,2"),
}  # fmt: skip


pytestmark = pytest.mark.usefixtures("elsewhere")


@pytest.mark.parametrize(("text", "value"), [
    ("1.5", 1.5),
    (" 2 ", 2),
    ("true", True),
    ("slab", "slab"),
    ("'slab'", "slab"),
    ("[160, 20]", [160, 20]),
    ("[{thickness = 1e-3}]", [{"thickness": 1e-3}]),
    ("[x, phi]", ["x", "phi"]),
    (".5", 0.5),
    ("a=b", "a=b"),
    ("1\nother = 2", "1\nother = 2"),
    ("[" * 5000, "[" * 5000),
    ("[" * 5000 + "x" + "]" * 5000, "[" * 5000 + "x" + "]" * 5000),
])  # fmt: skip
def test_a_value_is_as_toml_has_it_or_a_text(text, value):
    assert changes_of([f"rig.key={text}"]) == {"rig.key": value}


def test_the_last_of_a_key_counts_and_a_key_is_needed():
    assert changes_of(["rig.mass=1", "rig.mass=2"]) == {"rig.mass": 2}
    for text in ("rig.mass", "=1", " = 1"):
        with pytest.raises(ScenarioError, match="allowed is KEY=VALUE, as run.duration=10"):
            changes_of([text])


def test_tables_are_changed_and_not_those_that_were_given():
    """What is no table stays, and is said to be none."""
    tables = {"name": "a", "rig": {"mass": 1.0}, "run": 3, "of": {"belt": 4}}
    given = copy.deepcopy(tables)
    changed = changed_tables(
        tables,
        {"name": "b", "rig.mass": 2.0, "run.duration": 5.0, "coupling.of.a.port": 1e-9,
         "of.belt.length": 2.0},
    )  # fmt: skip
    assert changed == {
        "name": "b",
        "rig": {"mass": 2.0},
        "run": 3,
        "coupling": {"of": {"a.port": 1e-9}},
        "of": {"belt": 4},
    }
    assert tables == given


def test_a_key_that_is_set_hides_no_fault_of_the_file(tmp_path):
    (tmp_path / "case.toml").write_text("surface = 3\n")
    with pytest.raises(ScenarioError, match=r"surface: not a table \(3\)"):
        read_scenario("case.toml", {"surface.speed": 0.2})


def test_keywords_are_keys_or_tables_of_them():
    given = {"run_in_change": 0.1, "rig": {"mass": 1.2}, "run": {}, "name": "a"}
    named = {"run_in.change": 0.1, "rig.mass": 1.2, "run": {}, "name": "a"}
    assert changes_named(given, ["run", "run_in", "rig"]) == named


def test_a_change_comes_before_the_defaults(tmp_path):
    (tmp_path / "case.toml").write_text("")
    case = read_scenario("case.toml", {"rig.spring_length": 0.4, "lateral_friction.ratio": 0.5})
    assert case.rig.spring_natural_length == case.taken["rig.spring_natural_length"] == 0.34
    assert "lateral_friction.ratio" not in case.taken
    assert read_scenario("case.toml", {"defaults": "plain"}).taken == {}
    # of a packaged one, whose keys are all stated
    assert read_scenario("reference", {"rig.spring_length": 0.4}).rig.spring_natural_length == 0.17


def test_a_file_is_found_from_where_the_command_is(tmp_path):
    (tmp_path / "far").mkdir()
    (tmp_path / "far" / "case.toml").write_text("")
    (tmp_path / "mu.csv").write_text("v,mu\n0,0.2\n1,0.1\n")
    case = read_scenario("far/case.toml", {"friction.table": "mu.csv"})
    assert case.friction.table_mu == (0.2, 0.1)


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_refuses_what_a_file_may_not_hold(capsys, command):
    said = refusal(capsys, command, "reference", "--set", "rig.mas=1", *COMMANDS[command])
    known = "rig.mas: no such key, nearest known: rig.mass"
    assert said.startswith(f"reference with changes: {known}")


def test_what_is_wrong_in_the_file_is_not_laid_to_the_change(capsys, tmp_path):
    (tmp_path / "case.toml").write_text("[rig]\nmass = 0\n")
    line = refusal(capsys, "simulate", "case.toml", "--set", "run.duration=1")
    assert line.startswith("case.toml: rig.mass: out of range (0)")


def test_without_a_scenario_or_beside_resume_there_is_nothing_to_change(capsys, tmp_path):
    assert "a SCENARIO is needed" in refusal(capsys, "belt-length", "--set", "rig.mass=1")
    line = refusal(capsys, "run", "--resume", str(tmp_path), "--set", "rig.mass=1")
    assert "--set cannot be given" in line


def test_the_results_are_those_of_the_changed_scenario(capsys):
    settings = ("--set", "run.duration=0.5", "--set", "rig.mass = 2")
    assert main(["simulate", "study", *settings, "--json", "-o", "out"]) == 0
    numbers = json.loads(capsys.readouterr().out)
    assert (numbers["time_reached"], numbers["parameters"]["rig"]["mass"]) == (0.5, 2.0)
