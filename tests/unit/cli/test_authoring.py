"""Writing a scenario: new, keys, schema, completion."""

import json
import subprocess
import tomllib
from pathlib import Path

import jsonschema
import pytest
from command_line import refusal

from cosim.cli import main
from cosim.cli.arguments import COMMANDS
from cosim.gap import read_campaign
from cosim.scenario import Scenario, packaged_scenarios, read_scenario
from cosim.scenario.keys import all_keys
from cosim.scenario.scenario import source_text
from cosim.scenario.validation import known_keys

pytestmark = pytest.mark.usefixtures("elsewhere")


def printed(capsys, *argv):
    assert main(argv) == 0
    return capsys.readouterr().out


@pytest.fixture
def schemas(capsys):
    """Kind -> what checks a file of it."""
    found = {
        kind: json.loads(printed(capsys, "schema", kind))
        for kind in COMMANDS["schema"]["arguments"]["kind"]["choices"]
    }
    for schema in found.values():
        jsonschema.Draft7Validator.check_schema(schema)
    return {kind: jsonschema.Draft7Validator(schema) for kind, schema in found.items()}


def test_a_new_scenario_is_as_one_that_says_nothing_on_a_belt_for_its_block(capsys):
    """The published belt is narrower than the published block."""
    assert (
        printed(capsys, "new", "cold room")
        == "cold room.toml: change it, then stickslip run 'cold room.toml'\n"
    )
    Path("bare.toml").write_text('name = "cold room"')
    case = read_scenario("cold room.toml")
    assert case == read_scenario("bare.toml", {"belt.width": 0.10})
    assert case.belt.width > 2.0 * case.rig.contact_radius


@pytest.mark.parametrize("source", packaged_scenarios())
def test_a_copy_is_the_same_under_its_own_name(capsys, source):
    assert main(["new", "deep/mine.toml", "--from", source]) == 0
    case = read_scenario("deep/mine.toml")
    assert case == read_scenario(source).changed({"name": "mine"}) and case.taken == {}
    comments = [line for line in source_text(source).splitlines() if line.startswith("#")]
    assert set(comments) <= set(Path("deep/mine.toml").read_text().splitlines())


def test_nothing_is_overwritten(capsys):
    Path("mine.toml").write_text("name = 'mine'")
    line = refusal(capsys, "new", "mine")
    assert line == "mine.toml: is there, allowed is another NAME, or --force to overwrite it"
    assert Path("mine.toml").read_text() == "name = 'mine'"
    assert main(["new", "mine", "--force"]) == 0 == main(["new", "other"])
    capsys.readouterr()
    Path("scenario.schema.json").write_text("{}")
    assert "scenario.schema.json: is there and no schema" in refusal(capsys, "new", "third")
    assert Path("scenario.schema.json").read_text() == "{}"


def test_what_would_be_no_scenario_is_not_written(capsys, tmp_path):
    Path("bad.toml").write_text("[rig]\nmass = 0\n")
    Path("far.toml").write_text("[friction]\ntable = 'mu.csv'\n")
    Path("mu.csv").write_text("v,mu\n0,0.2\n1,0.1\n")
    before = set(tmp_path.rglob("*"))
    assert "a:b.toml: name: not fit for the name" in refusal(capsys, "new", "a:b")
    assert "nix: no such file" in refusal(capsys, "new", "x", "--from", "nix")
    assert "x.toml: rig.mass: out of range" in refusal(capsys, "new", "x", "--from", "bad.toml")
    # a file that it names would not be found from there
    assert "deep/mu.csv" in refusal(capsys, "new", "deep/x", "--from", "far.toml")
    assert set(tmp_path.rglob("*")) == before


def test_keys_are_all_there_are_with_their_defaults(capsys):
    told = {entry["key"]: entry for entry in json.loads(printed(capsys, "keys", "--json"))}
    Path("bare.toml").write_text("")
    bare = read_scenario("bare.toml").to_tables()
    for key, field in known_keys(Scenario).items():
        table, _, entry = key.partition(".")
        if entry and (table, entry) != ("run", "output_interval"):
            own = bare["ice" if table == "block" else table]  # a block of ice is written as [ice]
            assert told[key]["default"] == json.loads(json.dumps(own[entry])), key
            assert told[key]["plain"] == json.loads(json.dumps(field.default)), key
            assert told[key]["description"] and told[key]["allowed"]
    assert {"belt.layers[].thickness", "name", "defaults"} <= set(told)


def test_a_new_scenario_is_found_without_its_suffix_by_a_hint(capsys):
    assert main(["new", "mine"]) == 0
    assert "(did you mean mine.toml?)" in refusal(capsys, "simulate", "mine")


def test_a_word_finds_keys_by_name_or_else_by_meaning(capsys):
    out = printed(capsys, "keys", "spring_natural")
    assert out.startswith("rig.spring_natural_length = 0.17 m (plain: 0.2), allowed is a number")
    assert "left out, 0.85 of rig.spring_length" in out
    assert "rig.spring_natural_length" in printed(capsys, "keys", "pretension")
    assert "belt.layers[].density (must be given)" in printed(capsys, "keys", "layers")
    assert "0 N s/m, allowed is a number at least 0 N s/m" in printed(capsys, "keys", "film_drag.c")
    assert "nearest: 'springs.stiffness'" in refusal(capsys, "keys", "springs.stifness")


def errors(validator, text):
    return [error.message for error in validator.iter_errors(tomllib.loads(text))]


@pytest.mark.parametrize("name", packaged_scenarios())
def test_packaged_scenarios_are_as_the_schema_has_it(schemas, name):
    assert errors(schemas["scenario"], source_text(name)) == []
    assert errors(schemas["scenario"], read_scenario(name).to_toml()) == []


BAD = [
    "mass = 1", "[rig]\nmas = 1", "[rig]\nmass = 0", "[rig]\nmass = '1'", "[rig]\nmass = true",
    "rig = 3", "[rig]\ninertia = 'disk'", "[rig]\nattachment_angles_deg = [1, 2, 3]",
    "[rig]\ndegrees_of_freedom = ['z']", "[belt]\nelements = 6.5",
    "[[belt.layers]]\nthickness = 1e-3", "[imperfections]\nmass = 0.2",
    "[coupling]\nabsolute_tolerances = {'a.b' = 'x'}", "name = '../up'", "defaults = 'none'",
]  # fmt: skip


@pytest.mark.parametrize("text", BAD)
def test_what_a_file_may_not_hold_is_not_as_the_schema_has_it(schemas, text, capsys):
    assert errors(schemas["scenario"], text)
    Path("bad.toml").write_text(text)
    assert refusal(capsys, "simulate", "bad.toml").startswith("bad.toml: ")


def test_the_schema_knows_every_key_with_the_default_of_a_file(schemas):
    schema = schemas["scenario"].schema
    for key in all_keys():
        table, _, entry = key.key.partition(".")
        if not entry or "[]" in key.key:
            continue
        owner = schema["$defs"][schema["properties"][table]["$ref"].rpartition("/")[2]]
        told = owner["properties"][entry]
        assert told["default"] == json.loads(json.dumps(key.default)), key.key
        assert key.unit == "1" or told["description"].endswith(f"[{key.unit}]")


def test_a_new_scenario_names_its_schema_in_its_first_line(schemas, capsys):
    assert main(["new", "mine"]) == 0
    first = Path("mine.toml").read_text().splitlines()[0]
    file = Path(first.removeprefix("#:schema "))
    assert json.loads(file.read_text()) == schemas["scenario"].schema
    assert errors(schemas["scenario"], Path("mine.toml").read_text()) == []


def test_campaigns_and_systems_have_schemas(schemas):
    assert main(["gap", "--write-example", "measured"]) == 0
    assert main(["plan", "--write-example", "planned"]) == 0
    for kind, folder in (("campaign", "measured"), ("plan", "planned")):
        text = Path(folder, "campaign.toml").read_text()
        assert errors(schemas[kind], text) == []
        assert errors(schemas[kind], text.replace("mass", "mas"))
    assert read_campaign("measured").runs
    assert errors(schemas["campaign"], "name = 'no runs'")
    system = '[units.a]\nfile = "a.fmu"\nparameters = {"spring.k" = 1.0}\n[run]\nstop = 1\n'
    assert errors(schemas["system"], system) == []
    assert errors(schemas["system"], "[[connections]]\nfrom = 'a.y'\nto = 'b.u'\n" + system) == []
    for text in ("[run]\nstop = 1", system + "stpo = 2", "[units.a]\nfile = 3"):
        assert errors(schemas["system"], text)


WORDS = {
    ("stickslip", "si"): {"simulate"}, ("stickslip", "simulate", "re"): {"reference"},
    ("stickslip", "run", "mi"): {"mine.toml"}, ("stickslip", "couple", "tw"): {"two.ssp"},
    ("stickslip", "simulate", "--js"): {"--json"},
    ("stickslip", "new", "x", "--from", "sl"): {"slab"},
    ("stickslip", "schema", "s"): {"scenario", "system"},
    ("stickslip", "run", "--set", "rig.ma"): {"rig.mass="},
    ("stickslip", "sweep", "slab", "--vary", "surface.sp"): {"surface.speed="},
    ("stickslip", "compare", "slab", "mi"): {"mine.toml"}, ("stickslip", ""): set(COMMANDS),
}  # fmt: skip


def test_bash_completes_commands_options_and_scenarios(capsys, tmp_path):
    (tmp_path / "complete.bash").write_text(printed(capsys, "completion", "bash"))
    for name in ("mine.toml", "two.ssp", "mine.csv"):
        (tmp_path / name).write_text("")
    for words, expected in WORDS.items():
        line = " ".join(f"'{word}'" for word in words)
        script = (
            f"source complete.bash; COMP_WORDS=({line}); COMP_CWORD={len(words) - 1}; "
            "compopt() { :; }; _stickslip_complete; printf '%s\\n' \"${COMPREPLY[@]}\""
        )
        done = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=True)
        found = {word for word in done.stdout.split() if not word.startswith("-") or "--js" in line}
        assert found == expected, words


@pytest.mark.parametrize(("shell", "begins"), [("zsh", "#compdef stickslip"), ("fish", "")])
def test_other_shells_get_every_command(capsys, shell, begins):
    script = printed(capsys, "completion", shell)
    assert script.startswith(begins)
    assert all(name in script for name in COMMANDS) and "reference" in script


def test_a_schema_goes_to_a_file_that_is_none_of_somebody_else(capsys):
    for _ in range(2):
        assert main(["schema", "campaign", "-o", "deep/campaign.schema.json"]) == 0
    Path("mine.json").write_text("{}")
    assert "mine.json: is there" in refusal(capsys, "schema", "-o", "mine.json")
