"""What a scenario file leaves out: as of a rig, said, and taken or left by one line."""

import json

import pytest
from command_line import written

from cosim.cli import main
from cosim.scenario import Scenario, read_scenario
from cosim.scenario.defaults import IN_PROPORTION, stated
from cosim.scenario.validation import known_keys

THREE_LINES = "[rig]\nmass = 1.0\n[run]\nduration = 30.0\n"


def flat(scenario):
    return {
        f"{table}.{key}": value
        for table, entries in scenario.to_tables().items()
        if isinstance(entries, dict)
        for key, value in entries.items()
    }


def test_a_bare_file_is_the_reference_but_for_chance_and_moving_air(tmp_path):
    bare, reference = flat(read_scenario(written(tmp_path, ""))), flat(read_scenario("reference"))
    differ = {key for key in reference if bare.get(key) != reference[key]}
    # the output interval is the same, and only stated in the reference
    assert differ == {
        "imperfections.mass", "imperfections.spring_stiffness", "imperfections.anchor_position",
        "imperfections.start_position", "imperfections.start_angle_deg",
        "belt.still_air_speed", "run.output_interval",
    }  # fmt: skip


def test_plain_is_the_model_of_python(tmp_path):
    plain = read_scenario(written(tmp_path, 'defaults = "plain"', "unnamed.toml"))
    assert plain == Scenario() and plain.taken == {}
    assert plain.mechanics.flat() == Scenario().mechanics.flat()


def test_every_stated_default_is_a_key_that_is_not_plain_and_is_named_when_taken(tmp_path):
    case = read_scenario(written(tmp_path, ""))
    assert case.taken == stated()
    for key, value in stated().items():
        assert known_keys(Scenario)[key].default != value == flat(case)[key]
    for key, (other, usual) in IN_PROPORTION.items():
        assert key in stated() and known_keys(Scenario)[other].default == usual


def test_what_is_given_is_not_taken(tmp_path):
    case = read_scenario(written(tmp_path, "[lateral_friction]\nratio = 0.0\n"))
    assert case.lateral_friction.ratio == 0.0 and "lateral_friction.ratio" not in case.taken
    assert "rig.spring_natural_length" in case.taken
    less = case.changed({"rig.spring_natural_length": 0.19})
    assert set(less.taken) == set(case.taken) - {"rig.spring_natural_length"}


@pytest.mark.parametrize(("given", "key", "value"), [
    ("[rig]\nspring_length = 0.10", "rig.spring_natural_length", 0.085),
    ("[rig]\nspring_length = 3", "rig.spring_natural_length", 2.55),
    ("[run]\nduration = 6", "surface.run_up_time", 10.0),
])  # fmt: skip
def test_a_default_that_goes_with_a_size_goes_with_the_given_one(tmp_path, given, key, value):
    case = read_scenario(written(tmp_path, given))
    assert case.taken[key] == flat(case)[key] == value


def test_what_was_taken_is_not_part_of_what_a_scenario_is(tmp_path):
    """It is written out in full, and read again in whatever way is the same."""
    case = read_scenario(written(tmp_path, THREE_LINES))
    again = read_scenario(written(tmp_path, case.to_toml(), "again.toml"))
    assert again == case and again.taken == {} != case.taken


def test_the_command_says_what_was_taken(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    written(tmp_path, "[run]\nduration = 1.5\n")
    assert main(["simulate", "case.toml", "-o", "out"]) == 0
    err = capsys.readouterr().err
    assert err.startswith("note: left to the defaults: rig.spring_natural_length = 0.17 m, ")
    assert "surface.run_up_time = 10 s" in err and 'defaults = "plain" takes none' in err
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    assert summary["defaults"] == stated()
    page = (tmp_path / "out" / "report.html").read_text()
    assert "What the scenario left to the defaults: rig.spring_natural_length" in page
    assert main(["simulate", "case.toml", "-o", "out", "--set", "defaults=plain"]) == 0
    assert capsys.readouterr().err == ""
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["defaults"] == {}
    assert "left to the defaults" not in (tmp_path / "out" / "report.html").read_text()
