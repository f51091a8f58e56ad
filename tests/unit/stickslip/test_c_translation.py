"""Each means of the kernel's text as C, against the text interpreted."""

import random

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


class Expressions:
    """Random expressions of a, b (float), i, j (int) and the array w."""

    def __init__(self, seed):
        self.draw = random.Random(seed)

    def number(self, depth):
        if depth == 0:
            return self.draw.choice(["a", "b", "i", "2", "0.5", "-3.0", "w[1]", "peek(w, i)"])
        one, other = (self.number(depth - 1) for _ in range(2))
        forms = [
            *(f"{one} {sign} {other}" for sign in "+-*/"),
            *(f"{one} {sign} ({other})" for sign in ("+", "-", "*", "/", "//", "%")),
            *(f"({one}) {sign} {other}" for sign in ("-", "*", "/")),
            *(f"-{one}", f"-({one})", f"float({one}) ** 3", f"abs({one})", f"sin({one})"),
            *(f"max({one}, {other})", f"min({one}, {other}, a)", f"both({one}, {other})"),
            f"({one} if {self.question(depth - 1)} else {other})",
        ]
        return self.draw.choice(forms)

    def question(self, depth):
        one, other = (self.number(max(depth - 1, 0)) for _ in range(2))
        sign = self.draw.choice(["<", "<=", ">", ">=", "==", "!="])
        plain = f"{one} {sign} {other}"
        if depth < 2:
            return plain
        more = self.question(depth - 1)
        forms = [f"({plain}) and ({more})", f"({plain}) or {more}", f"not ({more})"]
        return self.draw.choice([plain, *forms, f"0.0 < a {sign} b"])


@needs_compiler
def test_random_expressions_give_the_same(tmp_path):
    """Precedence, association and types, in expressions nobody would write."""
    made, parts = Expressions("expressions"), [HEAD, CALLED]
    while len(parts) < 122:
        parts.append(
            f'def f{len(parts)}(w: "float[:]", a: float, b: float, i: int) -> float:\n'
            f"    x = {made.number(made.draw.randint(2, 4))}\n"
            f"    if {made.question(2)}:\n        x += {made.number(2)}\n    return x\n"
        )
    text = "\n".join(parts)
    made_of_them = library(text, tmp_path)
    functions = interpreted(text)
    compared = sum(
        compare(functions[name], getattr(made_of_them, name), 30, name)
        for name in functions
        if name.startswith("f")
    )
    assert compared > 1200


def test_what_is_read_only_is_constant():
    header = c_header(SNIPPETS)
    assert "double stickslip_two_arrays(const double *p, double *w);" in header
    assert "double stickslip_peek(const double *w, int64_t i);" in header
    assert "static const int64_t MANY = INT64_C(5000000000);" in header
    assert "#ifndef STICKSLIP_KERNEL_H" in header
