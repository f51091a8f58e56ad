"""Each means of the kernel's text as C, against the text interpreted."""

import random
import struct
from itertools import product
from math import inf, nan
from pathlib import Path

import numpy as np
import pytest
from c_library import compiler, library, warnings
from stickslip.generation.c import c_header
from stickslip.generation.source import kernel_source

#: Each means of the kernel's text; of it what stands before all functions, and those that random
#: expressions call.
SNIPPETS = Path(__file__).with_name("c_snippets.txt").read_text(encoding="utf-8")
HEAD = SNIPPETS[: SNIPPETS.index("def signs")]
CALLED = SNIPPETS[SNIPPETS.index("def push") : SNIPPETS.index("def order")]

needs_compiler = pytest.mark.skipif(not compiler(), reason="no C compiler")

SPECIAL = (0.0, -0.0, 1.0, -1.0, 0.5, 2.0, 3.0, -7.5, 1e-300, 1e300, inf, -inf, nan)
#: What Python raises where C gives inf or nan, or leaves open what it does.
RAISED = (ZeroDivisionError, OverflowError, ValueError, TypeError)


def interpreted(text):
    names = {}
    exec(text, names)
    return {
        name: value
        for name, value in names.items()
        if getattr(value, "__code__", None) and value.__code__.co_filename == "<string>"
    }


def bits(value):
    """What tells any two results apart, also zeros of different sign; all nan are one."""
    if value is None or isinstance(value, (bool, int)):
        return value
    return "nan" if value != value else struct.pack("d", value)


def drawn(function, draw):
    """Arguments of a function, by their annotations."""
    kinds = {
        "float": lambda: draw.choice([draw.choice(SPECIAL), draw.uniform(-10.0, 10.0)]),
        "int": lambda: draw.randint(-9, 9),
        "float[:]": lambda: [draw.uniform(-3.0, 3.0) for _ in range(8)],
    }
    annotations = {k: v for k, v in function.__annotations__.items() if k != "return"}
    return [kinds[getattr(kind, "__name__", kind)]() for kind in annotations.values()]


def results(function, given):
    """What a function gives, and its arrays after that, as what can be compared; else None."""
    try:
        value = function(*given)
    except RAISED:
        return None
    if function.__annotations__.get("return") is float and isinstance(value, int):
        value = float(value)
    return None if isinstance(value, complex) else [bits(value), *given_bits(given)]


def given_bits(given):
    return [[bits(float(x)) for x in each] for each in given if hasattr(each, "__len__")]


def compare(python, c, draws, seed):
    """Both give the same; how often there was something to compare."""
    draw, compared = random.Random(seed), 0
    for _ in range(draws):
        given = drawn(python, draw)
        arrays = [np.array(each) if isinstance(each, list) else each for each in given]
        said = str(given)
        expected = results(python, given)
        if expected is not None:
            assert [bits(c(*arrays)), *given_bits(arrays)] == expected, said
            compared += 1
    return compared


@pytest.fixture(scope="module")
def translated(tmp_path_factory):
    return library(SNIPPETS, tmp_path_factory.mktemp("snippets"))


@needs_compiler
@pytest.mark.parametrize("name", interpreted(SNIPPETS))
def test_what_becomes_c_gives_the_same(translated, name):
    python = interpreted(SNIPPETS)[name]
    assert compare(python, getattr(translated, name), 400, name) > 20


@needs_compiler
@pytest.mark.parametrize("text", (SNIPPETS, kernel_source()), ids=("snippets", "kernel"))
def test_the_compiler_has_nothing_to_say(text, tmp_path):
    assert warnings(text, tmp_path) == ""


OPERATORS = ("+", "-", "*", "/", "//", "%")
COMPARISONS = ("<", "<=", ">", ">=", "==", "!=")


def nested():
    """Every operator within every other one, on either side, with parentheses and without."""
    for one, other in product(OPERATORS, repeat=2):
        yield f"(a {one} b) {other} i"
        yield f"a {one} (b {other} i)"
        yield f"a {one} b {other} i"
    for sign in OPERATORS:
        yield f"-(a {sign} b) {sign} -i"
        yield f"(a if b < i else b) {sign} (i if not (a < b or b < i) else w[1])"
        yield f"float(a {sign} b) ** 3 {sign} both(a {sign} i, peek(w, i)) {sign} min(a, i, b)"
    for sign in COMPARISONS:
        yield f"1.0 if a {sign} b and (b < i or not i {sign} a) or not (a {sign} i) else 2.0"
        yield f"1.0 if 0.0 < a {sign} b else a if a + b {sign} b * i and (a or i) else -b"
        yield f"1.0 if (a if b < i else b) {sign} (i if a < b else 0.5) else 2.0"


@needs_compiler
def test_operators_within_operators_give_the_same(tmp_path):
    """Precedence, association and types."""
    made = [
        f'def f{n}(w: "float[:]", a: float, b: float, i: int) -> float:\n    return {each}\n'
        for n, each in enumerate(nested())
    ]
    text = "\n".join([HEAD, CALLED, *made])
    made_of_them = library(text, tmp_path)
    functions = interpreted(text)
    for name in (name for name in functions if name.startswith("f")):
        assert compare(functions[name], getattr(made_of_them, name), 80, name) > 20, name


def test_what_is_read_only_is_constant():
    header = c_header(SNIPPETS)
    assert "double stickslip_two_arrays(const double *p, double *w);" in header
    assert "double stickslip_peek(const double *w, int64_t i);" in header
    assert "static const int64_t MANY = INT64_C(5000000000);" in header
    assert "#ifndef STICKSLIP_KERNEL_H" in header
