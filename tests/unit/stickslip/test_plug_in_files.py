"""An effect from outside is a file: what is wrong with it is said in one line, with its place."""

import os
import subprocess
import sys

import pytest
from stickslip.plugins.errors import PluginError
from stickslip.plugins.load import TABLES, effect_in, source_of

from cosim.cli.authoring.effect import text_of
from cosim.scenario import Scenario

GOOD = text_of("brush")
TERM = "    return 1.0 - fall * speed * speed / (speed * speed + onset * onset)\n"


@pytest.fixture
def said(tmp_path):
    """Text of a file -> what is said of it, without the file's path."""

    def read(text):
        file = tmp_path / f"brush{len(list(tmp_path.iterdir()))}.py"
        file.write_text(text, encoding="utf-8")
        with pytest.raises(PluginError) as refusal:
            effect_in(source_of(file))
        message = str(refusal.value)
        assert message.startswith(str(file)) and "\n" not in message
        return message.removeprefix(str(file))

    return read


def line_of(text, part):
    return text[: text.index(part)].count("\n") + 1


def test_the_template_is_an_effect_of_the_file_s_name(tmp_path):
    file = tmp_path / "brush.py"
    file.write_text(GOOD, encoding="utf-8")
    effect = effect_in(source_of(file))
    assert (effect.id, effect.table.__name__) == ("brush", "Brush")
    assert "template" not in GOOD.lower()
    assert [path.name for path in tmp_path.iterdir()] == ["brush.py"]  # no __pycache__


@pytest.mark.parametrize(
    ("instead", "what"),
    [
        ("    return np.tanh(speed)\n", "`np`"),
        ("    return 1.0 if speed else 'a'\n", "'a'"),
        ("    return sum([speed, fall, onset])\n", "`sum`"),
        ("    return max(x for x in (speed, fall))\n", "max"),
        ("    parts = [speed]\n    return parts[0]\n", "[speed]"),
        ("    with speed:\n        return fall\n", "with speed"),
    ],
)
def test_a_term_keeps_to_what_becomes_c(said, instead, what):
    text = GOOD.replace(TERM, instead)
    line = line_of(text, instead)
    message = said(text)
    assert message.startswith(f", line {line}: "), message
    assert what in message and "allowed in a term: numbers" in message and "exp" in message


@pytest.mark.parametrize(
    ("instead", "what"),
    [
        ("    return dry_factor(speed, fall, onset)\n", "maximum recursion depth"),
        ("    return 1.0 - fall * onset / speed\n", "at speed = 0, fall = 0.3, onset = 0.05: "),
        ("    return 1.0 + (1e308 * 10.0 - 1e308 * 10.0) * fall\n", "is nan at speed = 0"),
        ("    return 1.0 - 20.0 * fall\n", "is -5 at speed = 0"),
    ],
)
def test_a_term_is_a_number_that_does_not_drive_the_block(said, instead, what):
    """Else the kernel's comparisons are all false, and a block sticks for ever in silence."""
    message = said(GOOD.replace(TERM, instead))
    assert message.startswith(f", line {line_of(GOOD, 'def dry_factor')}: dry_factor "), message
    assert what in message and "allowed is" in message


@pytest.mark.skipif(sys.gettrace() is not None, reason="another watches the lines")
def test_a_term_comes_to_its_end(said):
    endless = "    x = 1.0\n    while x > 0.0:\n        x = x + 1.0\n    return x\n"
    assert "no end after" in said(GOOD.replace(TERM, endless))


def test_a_term_s_numbers_are_declared(said):
    message = said(GOOD.replace("speed: float, fall", "speed, fall"))
    assert "speed of dry_factor is not declared as float" in message
    message = said(GOOD.replace(") -> float:", "):"))
    assert "what dry_factor returns is not declared as float" in message


@pytest.mark.parametrize(
    ("old", "new", "what"),
    [
        ("EFFECT = Effect(", "EFFECTS = Effect(", "has no EFFECT"),
        ("EFFECT = Effect(", "EFFECT = dict(", "dict"),
        ("class Brush(Table):", "class Brush(Table:", "line "),
        ('switch=("fall",)', 'switch=("onset",)', "onset is not off at 0"),
        ('enters="friction"', 'enters="magic"', "enters 'magic', which is no part of the model"),
        ('0.05, "m/s"', '-0.05, "m/s"', "default of onset: Input should be greater than 0"),
        ("speed: float, fall", "speed: float, mood: float, fall", "'mood'"),
        ('{"fall": 0.3, "onset": 0.05}', '{"fall": 3.0}', "case: fall"),
        ('id="brush"', 'id="rig"', "'rig' cannot be the name of a table"),
        ('id="brush"', 'id="class"', "'class' cannot be the name of a table"),
        ('id="brush"', 'id="Brush"', "'Brush' cannot be the name of a table"),
        ('"brush.onset", s.speed', '"brush.start", s.speed', "brush.start is no parameter"),
        ("s.speed, 0.3", "s.mood, 0.3", "AttributeError"),
        ("import Candidate, Case", "import Candidates, Case", "Candidates"),
        (
            "    fall: float = quantity(\n        0.0,",
            "    fall: float = quantity(\n        ...,",
            "o",
        ),
        ('"""Kinetic', '1 / 0\n"""Kinetic', "line 1: ZeroDivisionError"),
    ],
)
def test_what_is_wrong_with_a_file_is_said(said, old, new, what):
    assert old in GOOD
    text = GOOD.replace(old, new, 1)
    assert what in said(text)


def test_a_table_without_words_is_none(said):
    head, _, rest = GOOD.partition("class Brush(Table):\n")
    text = head + "class Brush(Table):\n" + rest.partition("\n\n")[2]
    assert "Brush has no docstring" in said(text)


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(PluginError, match="No such file"):
        source_of(tmp_path / "none.py")
    (tmp_path / "latin.py").write_bytes(b"# \xff")
    (tmp_path / "binary.py").write_bytes(b"x = 1\x00")
    with pytest.raises(PluginError, match=r"binary\.py: .*null bytes"):
        effect_in(source_of(tmp_path / "binary.py"))
    with pytest.raises(PluginError, match="byte 3 is not UTF-8"):
        source_of(tmp_path / "latin.py")


def test_no_effect_is_called_as_a_table_of_a_scenario():
    blocks = {name for name in Scenario.model_fields if name not in catalogue_ids()}
    assert blocks <= set(TABLES)


def catalogue_ids():
    from stickslip import EFFECTS

    return {effect.id for effect in EFFECTS}


@pytest.fixture(scope="module")
def alone(tmp_path_factory):
    """A Python program and its arguments -> what it prints, in a process of its own."""
    folder = tmp_path_factory.mktemp("alone")
    (folder / "brush.py").write_text(GOOD, encoding="utf-8")

    def run(program, *arguments, **variables):
        done = subprocess.run(
            [sys.executable, "-c", program, *map(str, arguments)],
            capture_output=True, text=True, cwd=folder, env=os.environ | variables,
        )  # fmt: skip
        assert done.returncode == 0, done.stderr
        return done.stdout.split()

    return run


def test_a_unit_that_no_unit_has(said):
    text = GOOD.replace('"m/s"', '"furlong"')
    assert "onset is in 'furlong'" in said(text) and "m/s2" in said(text)


INSTALLED = """
from cosim import read_scenario
scenario = read_scenario("reference")
print(scenario.catalogue.effects[-1].id, scenario.grease.fall)
"""


def test_scenarios_have_an_installed_one_by_themselves(alone, tmp_path):
    (tmp_path / "grease.py").write_text(text_of("grease"), encoding="utf-8")
    info = tmp_path / "grease-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: grease\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text("[stickslip.effects]\ngrease = grease:EFFECT\n")
    path = os.pathsep.join([str(tmp_path), os.environ.get("PYTHONPATH", "")])
    assert alone(INSTALLED, PYTHONPATH=path) == ["grease", "0.0"]
