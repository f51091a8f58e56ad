"""An effect from outside is a file: what is wrong with it is said in one line, with its place."""

import sys

import pytest
from stickslip.generation.terms import terms_source
from stickslip.plugins.errors import PluginError
from stickslip.plugins.load import TABLES, effect_in, source_of

from cosim.cli.authoring.effect import text_of
from cosim.scenario import Scenario

GOOD = text_of("brush")
TERM = "    return 1.0 - fall * speed * speed / (speed * speed + onset * onset)\n"
#: With a function that terms share, a derived number and a state.
MORE = '''
from math import exp

from stickslip.effects.effect import Case, Effect, State
from stickslip.quantity import Table, quantity

SHARE = 0.5


class Brush(Table):
    """Bristles bend."""

    much: float = quantity(0.0, "1", "how much", typical=(0.1, 1.0))
    over: float = quantity(1.0, "m/s", "over which speed", tried=(0.1, 1.0))


def half(value: float) -> float:
    """A share of it."""
    return SHARE * value


def over_two(over: float) -> float:
    """m/s"""
    return half(over)


def dry_factor(speed: float, much: float, over_two: float) -> float:
    """mu_k in proportion."""
    left = exp(-speed / over_two)
    return 1.0 + half(much) * max(left, 0.0)


def bend_rate(speed: float, bend: float, over: float) -> float:
    """Rate of the bend."""
    return speed - bend * over


EFFECT = Effect(
    id="brush",
    table=Brush,
    switch=("much",),
    enters="friction",
    source="nowhere",
    terms=(dry_factor,),
    derived=(over_two,),
    states=(State("bend", bend_rate),),
    case=Case({"much": 0.1}),
)
'''


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


@pytest.mark.parametrize(("instead", "what"), [
    ("    return np.tanh(speed)\n", "`np`"),
    ("    return 1.0 if speed else 'a'\n", "'a'"),
    ("    return sum([speed, fall, onset])\n", "`sum`"),
    ("    return max(x for x in (speed, fall))\n", "max"),
    ("    parts = [speed]\n    return parts[0]\n", "[speed]"),
    ("    with speed:\n        return fall\n", "with speed"),
])  # fmt: skip
def test_a_term_keeps_to_what_becomes_c(said, instead, what):
    text = GOOD.replace(TERM, instead)
    line = line_of(text, instead)
    message = said(text)
    assert message.startswith(f", line {line}: "), message
    assert what in message and "allowed in a term: numbers" in message and "exp" in message


@pytest.mark.parametrize(("instead", "what"), [
    ("    return dry_factor(speed, fall, onset)\n", "maximum recursion depth"),
    ("    return 1.0 - fall * onset / speed\n", "at speed = 0, fall = 0.3, onset = 0.05: "),
    ("    return 1.0 + (1e308 * 10.0 - 1e308 * 10.0) * fall\n", "is nan at speed = 0"),
    ("    return 1.0 - 20.0 * fall\n", "is -5 at speed = 0"),
])  # fmt: skip
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


@pytest.mark.parametrize(("old", "new", "what"), [
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
    ("    fall: float = quantity(\n        0.0,", "    fall: float = quantity(\n        ...,", "o"),
    ('"""Kinetic', '1 / 0\n"""Kinetic', "line 1: ZeroDivisionError"),
])  # fmt: skip
def test_what_is_wrong_with_a_file_is_said(said, old, new, what):
    assert old in GOOD
    text = GOOD.replace(old, new, 1)
    assert what in said(text)


def test_a_sound_one_becomes_text(tmp_path):
    (tmp_path / "brush.py").write_text(MORE, encoding="utf-8")
    text = terms_source([effect_in(source_of(tmp_path / "brush.py"))])
    assert "def brush_dry_factor(" in text and "0.5 * value" in text
    assert "from math import exp" in text
    assert text.count("def brush_half(") == 1  # which a term and a derived number call
    assert "p[P_BRUSH_OVER_TWO] = brush_over_two(v[V_BRUSH_OVER])" in text


SIGNATURE = "dry_factor(speed: float, much: float, over_two: float)"
#: What is replaced, two by two, and what is said.
DECLARED = [
    ('("much",)', '"much"', "switch is no tuple"),
    ('("much",)', "()", "no switch"),
    ('("much",)', '("mush",)', "switch 'mush' is no parameter; there are"),
    ("    case=", '    core={"mush": "M"},\n    case=', "core 'mush' is no param"),
    ("    case=", '    axis="colour",\n    case=', "axis 'colour' is none; there are"),
    ("(dry_factor,)", "dry_factor", "terms is no tuple"),
    ('quantity(0.0, "1"', 'quantity(0.0, ""', "much has no unit"),
    ('quantity(0.0, "1", "how much", typical=(0.1, 1.0))', "0.0", "much has no unit"),
    (", typical=(0.1, 1.0)", "", "much has neither a typical range nor a tried"),
    ("bend_rate)", 'bend_rate, start="ovre")', "bend starts from 'ovre', which is no parameter; t"),
    ("dry_factor", "dry_facter", "no place 'dry_facter' in the kernel; there are"),
    ("r(speed:", "r(sped:", "exp(-speed", "exp(-sped", "dry_factor takes 'sped'"),
    ("e(speed:", "e(sped:", "return speed", "return sped", "bend_rate takes 'sped'"),
    ("over_two(over:", "over_two(sped:", "half(over)", "half(sped)", "over_two takes 'sped'"),
    ("\nSHARE", "from random import Random\nSHARE", "half(over)", "Random(1)", "uses `Random`"),
    ("\nSHARE", "SCALES = (1.0, 2.0)\nSHARE", "left = exp(", "left = SCALES.index(", "`SCALES`"),
    ("\nSHARE", "from stickslip.effects.friction.run_in import kinetic_factor\nSHARE",
     "(dry_factor,)", "(kinetic_factor,)", "'kinetic_factor' is no function at the top of this"),
    *((SIGNATURE, f"contact_drag({word}: float)", "exp(-speed / over_two)", f"exp(-{word})",
       "half(much) * ", "", "(dry_factor,)", "(contact_drag,)",
       f"contact_drag takes '{word}': contact_drag knows nothing of the motion")
      for word in ("temperature", "travel", "bend")),
    # neither a parameter, nor a derived number, nor a state: the word would be taken instead
    *(("    over: float = q", f"    {word}: float = q", f"{word}: the kernel's own words")
      for word in ("speed", "hold", "time", "mu", "flooded", "extension", "travel")),
    ("def over_two(", "def mu(", "(over_two,)", "(mu,)", "mu: the kernel's own words"),
    ('State("bend"', 'State("travel"', "travel: the kernel's own words"),
]  # fmt: skip


@pytest.mark.parametrize("case", DECLARED, ids=lambda case: case[-1])
def test_what_is_wrong_with_a_declaration_is_said(said, case):
    *changes, what = case
    text = MORE
    for old, new in zip(changes[::2], changes[1::2], strict=True):
        assert old in text
        text = text.replace(old, new)
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


def test_a_unit_that_no_unit_has(said):
    text = GOOD.replace('"m/s"', '"furlong"')
    assert "onset is in 'furlong'" in said(text) and "m/s2" in said(text)
