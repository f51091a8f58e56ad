"""Each means of the kernel's text as C, against the text interpreted."""

from itertools import product

import pytest
from c_library import compiler, library, warnings
from c_snippets import CALLED, HEAD, SNIPPETS
from same_as_c import compare, interpreted
from stickslip.generation.c import c_header
from stickslip.generation.source import kernel_source

needs_compiler = pytest.mark.skipif(not compiler(), reason="no C compiler")


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
