"""What is wrong with an effect's declaration is said in one line that names the effect."""

import importlib.util
import sys

import pytest
from stickslip import effects
from stickslip.effects.effect import Effect
from stickslip.generation.places import PACKED
from stickslip.generation.terms import terms_source

FILE = '''
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
def declared(tmp_path, monkeypatch):
    """The effect of `FILE` with some of its text replaced."""

    def load(*changes: tuple[str, str]) -> Effect:
        text = FILE
        for old, new in changes:
            assert old in text
            text = text.replace(old, new)
        path = tmp_path / "brush.py"
        path.write_text(text, encoding="utf-8")
        spec = importlib.util.spec_from_file_location("brush", path)
        module = importlib.util.module_from_spec(spec)
        monkeypatch.setitem(sys.modules, "brush", module)
        spec.loader.exec_module(module)
        return module.EFFECT

    return load


def test_a_sound_one_becomes_text(declared):
    text = terms_source([declared()])
    assert "def brush_dry_factor(" in text and "0.5 * value" in text
    assert "from math import exp" in text
    assert text.count("def brush_half(") == 1  # which a term and a derived number call
    assert "p[P_BRUSH_OVER_TWO] = brush_over_two(v[V_BRUSH_OVER])" in text


@pytest.mark.parametrize(
    ("old", "new", "said"),
    {
        "switch, a word": ('("much",)', '"much"', "switch is no tuple"),
        "switch, none": ('("much",)', "()", "no switch"),
        "switch, unknown": ('("much",)', '("mush",)', "switch 'mush' is no parameter; there are"),
        "core, unknown": (
            "    case=",
            '    core={"mush": "M"},\n    case=',
            "core 'mush' is no param",
        ),
        "axis, unknown": (
            "    case=",
            '    axis="colour",\n    case=',
            "axis 'colour' is none; there are",
        ),
        "terms, a function": ("(dry_factor,)", "dry_factor", "terms is no tuple"),
        "no unit": ('quantity(0.0, "1"', 'quantity(0.0, ""', "much has no unit"),
        "no quantity": ('quantity(0.0, "1", "how much", typical=(0.1, 1.0))', "0.0", "no unit"),
        "no range": (", typical=(0.1, 1.0)", "", "much has neither a typical range nor a tried"),
    }.values(),
)
def test_what_a_declaration_lacks_is_said_at_once(declared, old, new, said):
    with pytest.raises(ValueError, match=rf"^effect brush: .*{said}[^\n]*$"):
        declared((old, new))


@pytest.mark.parametrize("word", ["speed", "hold", "time", "mu", "flooded", "extension", "travel"])
@pytest.mark.parametrize("name", ["over", "over_two", "bend"])
def test_a_word_of_the_kernel_names_no_number_of_an_effect(declared, name, word):
    """Neither a parameter, nor a derived number, nor a state: the word would be taken instead."""
    effect = declared(
        {
            "over": ("    over: float = q", f"    {word}: float = q"),
            "over_two": ("def over_two(", f"def {word}("),
            "bend": ('State("bend"', f'State("{word}"'),
        }[name],
        *([("derived=(over_two,)", f"derived=({word},)")] if name == "over_two" else []),
    )
    with pytest.raises(ValueError, match=f"^effect brush: {word}: the kernel's own words$"):
        terms_source([effect])


def test_a_state_starts_from_a_parameter(declared):
    effect = declared(('State("bend", bend_rate)', 'State("bend", bend_rate, start="ovre")'))
    with pytest.raises(ValueError, match="state bend starts from 'ovre'.*there are much, over"):
        terms_source([effect])


def test_an_unknown_place_is_refused_with_all_there_are(declared):
    effect = declared(("dry_factor", "dry_facter"))
    with pytest.raises(ValueError, match="^effect brush: no place 'dry_facter'") as caught:
        terms_source([effect])
    assert all(place.name in str(caught.value) for place in PACKED)


@pytest.mark.parametrize(
    ("function", "changes"),
    {
        "dry_factor": [("dry_factor(speed:", "dry_factor(sped:"), ("exp(-speed", "exp(-sped")],
        "bend_rate": [("bend_rate(speed:", "bend_rate(sped:"), ("return speed", "return sped")],
        "over_two": [("over_two(over:", "over_two(sped:"), ("half(over)", "half(sped)")],
    }.items(),
)
def test_a_misspelt_argument_is_named_with_its_function(declared, function, changes):
    effect = declared(*changes)
    with pytest.raises(ValueError, match=f"^effect brush: {function} takes 'sped'"):
        terms_source([effect])


@pytest.mark.parametrize("word", ["temperature", "travel", "bend"])
def test_a_place_without_the_motion_gives_none_of_it(declared, word):
    effect = declared(
        ("dry_factor", "contact_drag"),
        (
            "contact_drag(speed: float, much: float, over_two: float)",
            f"contact_drag({word}: float)",
        ),
        ("exp(-speed / over_two)", f"exp(-{word})"),
        ("half(much) * ", ""),
    )
    said = f"contact_drag takes '{word}': contact_drag knows nothing of the motion"
    with pytest.raises(ValueError, match=said):
        terms_source([effect])


@pytest.mark.parametrize(
    ("head", "call", "name"),
    [
        ("import numpy as np", "np.exp", "np"),
        ("from random import Random", "Random", "Random"),
        ("SCALES = (1.0, 2.0)", "SCALES.index", "SCALES"),
    ],
)
def test_a_term_uses_what_the_kernel_has(declared, head, call, name):
    effect = declared(("\nSHARE", f"{head}\nSHARE"), ("left = exp(", f"left = {call}("))
    said = (
        f"effect brush: term dry_factor uses {name}: a term may use numbers, functions of its "
        'file and "from math import ..."'
    )
    with pytest.raises(ValueError) as caught:
        terms_source([effect])
    assert str(caught.value) == said


def test_a_derived_number_uses_no_more_than_a_term(declared):
    head = ("\nSHARE", "from random import Random\nSHARE")
    effect = declared(head, ("return half(over)", "return Random(1).gauss(0.0, over)"))
    with pytest.raises(ValueError, match="over_two uses Random: a term may use numbers, functions"):
        terms_source([effect])


def test_a_term_from_another_file_is_refused(declared):
    head = ("\nSHARE", "from stickslip.effects.friction.run_in import kinetic_factor\nSHARE")
    effect = declared(head, ("terms=(dry_factor,)", "terms=(kinetic_factor,)"))
    with pytest.raises(ValueError, match="effect brush: kinetic_factor is no function of its file"):
        terms_source([effect])


def test_a_file_without_an_effect_and_an_effect_twice():
    with pytest.raises(ValueError, match=r"^effects/periodic.py declares no Effect named EFFECT$"):
        effects.declared(["periodic"])
    with pytest.raises(ValueError, match=r"^effect run_in: declared twice"):
        effects.declared(["friction.run_in", "friction.run_in"])
