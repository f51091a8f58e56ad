"""What of Python does not become C, and how whoever wrote it is told."""

import pytest
from refusals import one_line
from stickslip.generation.c import c_header, c_source

REFUSED = {
    "return [a]": "`[a]`: not in the subset",
    "return foo(a)": "`foo(a)`: foo is unknown",
    "return sin(a)": "`sin(a)`: sin is unknown",
    "return round(a)": "`round(a)`: round is unknown",
    "return b": "`b`: a name that stands for no number",
    "return w": "`w`: an array as a whole",
    "return w[1:]": "`1:`: not in the subset",
    "return w[-1]": "`-1`: an index from an array's end",
    "return w[a]": "`a`: float where int is wanted",
    "return a[0]": "`a[0]`: a is no array",
    "return 2 ** i": "`2 ** i`: int ** int, which is int or float: write float(...)",
    "return a < 1.0": "`a < 1.0`: bool where float is wanted",
    "return a + True": "`True`: bool where a number is wanted",
    "return a and 1.0": "`a`: float where bool is wanted",
    "return f(w, a)": "`f(w, a)`: 2 arguments instead of 3",
    "return f(w, a, i=1)": "`f(w, a, i=1)`: not in the subset",
    "return f(a, a, 1)": "`a`: no array as a whole",
    "return abs(a, a)": "`abs(a, a)`: 2 arguments",
    "return max(a)": "`a`: max of a single value",
    "return": "`return`: the function gives float, as its head says",
    "if a > 0.0:\n        return a": "`if a > 0.0:`: the function can end here without a value",
    "i = a\n    return a": "`a`: float where int is wanted",
    "x = a < 1.0\n    x = 2.0\n    return a": "bool and float in one place",
    "x = y\n    return x": "`y`: a name that stands for no number",
    "for x in w:\n        a += x\n    return a": "`for x in w:`: loops go over range()",
    "for j in range(0, 9, i):\n        a += 1.0\n    return a": "a range is a whole constant",
    "while a < 1.0:\n        a += 1.0\n    else:\n        a = 0.0": "`while a < 1.0:`: not in the",
    "x = [1.0]\n    return a": "`[1.0]`: not in the subset",
    "w = a\n    return a": "assigned to what is neither a variable nor an element",
    "import os\n    return a": "`import os`: not in the subset",
    "assert a > 0.0\n    return a": "`assert a > 0.0`: not in the subset",
    "with a:\n        return a": "`with a:`: not in the subset",
    "while w[0] < push(w):\n        a = 0.0\n    return a": "give it a statement of its own",
    "return push(w) - push(w) * w[1]": "give it a statement of its own",
    "return max(w[2], push(w))": "give it a statement of its own",
    "w[i] += push(w)\n    return a": "give it a statement of its own",
    "w[int(push(w))] = w[3]\n    return a": "give it a statement of its own",
    "w[5], w[6] = push(w), push(w)\n    return a": "give it a statement of its own",
    "return a if a > w[0] > push(w) else 0.0": "a chain of comparisons with a call that writes",
    "return 0.0 if a > 0.0 and w[0] < push(w) else 1.0": "give it a statement of its own",
    "return µ": "a name that stands for no number",
}
PUSH = 'def push(w: "float[:]") -> float:\n    w[0] += 1.0\n    return w[0]\n\n'


@pytest.mark.parametrize("body", REFUSED)
def test_what_c_cannot_do_is_said_to_whoever_wrote_it(body):
    text = f'{PUSH}def f(w: "float[:]", a: float, i: int) -> float:\n    {body}\n'
    said = one_line(ValueError, c_source, text)
    assert REFUSED[body] in said
    assert said.startswith("kernel function f, line ")
    assert "not in the subset that becomes C (allowed: numbers; arguments that are float" in said


@pytest.mark.parametrize(("text", "why"), [
    ("def f(a) -> float:\n    return 1.0", "a type that is none of float, int, bool"),
    ("def f(a: str) -> float:\n    return 1.0", "a type that is none of float, int, bool"),
    ("def f(a: float = 1.0) -> float:\n    return a", "without defaults"),
    ("def f(*a: float) -> float:\n    return 1.0", "without defaults"),
    ("@f\ndef f() -> float:\n    return 1.0", "a decorator"),
    ("def f(a: float):\n    return a", "the function gives none"),
    ("def f(µ: float) -> float:\n    return µ", "other letters than a to z"),
    ("import math", "neither a function nor a constant"),
    ("from math import gamma", "no gamma there"),
    ("from math import sin as s", "no sin as s there"),
    ("A = 2 * 3", "neither a finite number nor a tuple of such"),
    ("A = 1e999", "neither a finite number nor a tuple of such"),
    ("A = 'x'", "neither a finite number nor a tuple of such"),
    ("A = 1\nA = 2", "A has been given before"),
    ("class A:\n    pass", "neither a function nor a constant"),
])  # fmt: skip
def test_what_no_text_of_a_kernel_has_is_refused(text, why):
    said = one_line(ValueError, c_source, text)
    assert "not in the subset" in said and why in said


def test_a_constant_takes_no_name_of_c():
    with pytest.raises(ValueError, match="a constant of a name that C has for something else"):
        c_header("NAN = 1.0")
