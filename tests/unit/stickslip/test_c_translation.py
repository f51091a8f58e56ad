"""Each means of the kernel's text as C, against the text interpreted; and what is refused."""

import random
import struct
from math import inf, nan

import numpy as np
import pytest
from c_library import Library, compiler
from stickslip.generation.c import c_header, c_source

needs_compiler = pytest.mark.skipif(not compiler(), reason="no C compiler")

SNIPPETS = '''
"""A heading."""
from math import atan2, ceil, copysign, cos, floor, isfinite, isinf, isnan, log1p, pi, radians, sin

HALF = 0.5
THREE = 3
MANY = 5000000000
BACK = -2
ON = True
HUGE = 1e200
KNOTS = (0.25, -1.5, 3, 1e-300)

def association(a: float, b: float, c: float) -> float:
    return a - (b - c) + a * (b * c) - a / (b / c) - (a - b - c) / (a * b / c)

def signs(a: float, b: float) -> float:
    return -a ** 2 - -b + a * -b - -(-a) + (-a) ** 2 - 2.0 ** -b + +a

def powers(a: float, b: float) -> float:
    """Ends a comment */ and begins one /* too."""
    return a ** 2 + abs(a) ** b + a ** -1 + b ** 0.5 + a ** THREE

def division(a: float, i: int, j: int) -> float:
    return i / j + a / i + 1 / 3 + THREE / 2

def float_modulo(a: float, b: float) -> float:
    return a % b

def float_floor(a: float, b: float) -> float:
    return a // b

def int_modulo(i: int, j: int) -> int:
    return i % j

def int_floor(i: int, j: int) -> int:
    return i // j - 7 // -2 + MANY // 1000 + MANY * 3

def mixed_modulo(i: int, a: float) -> float:
    return i % a + a // i

def largest(a: float, b: float, c: float) -> float:
    return max(a, b, c)

def larger(a: float, b: float) -> float:
    return max(a, b)

def smaller(a: float, b: float) -> float:
    return min(a, b)

def whole_extremes(i: int, j: int) -> int:
    return max(i, j, 0) * 100 + min(i, j) + abs(i)

def mixed_extremes(i: int, a: float) -> float:
    return max(i, a) + min(a, 1)

def conversions(a: float, i: int) -> float:
    a = min(max(a, -1e9), 1e9)
    return int(a) + float(i) + int(a > 0.0) + float(bool(i)) + int(bool(a))

def functions(a: float, b: float) -> float:
    a = min(max(a, -1e9), 1e9)
    b = min(max(b, -1e9), 1e9)
    return radians(a) + atan2(a, b) + log1p(abs(a)) + copysign(a, b) + floor(a) + ceil(b) * pi

def finite(a: float) -> bool:
    return isfinite(a) and not (isnan(a) or isinf(a))

def chained(a: float, b: float, i: int) -> bool:
    return a < b <= 1.0 or not 0 <= i < 2 and a == b or a != a

def conditions(a: float, i: int) -> float:
    if a and not i:
        return 1.0
    elif i or a:
        return 2.0
    else:
        pass
    return 3.0 if a else 4

def choices(a: float, b: float) -> float:
    return (1.0 if a < b else 2.0) * (b if a > 0.0 else (a if b > 0.0 else 0.5)) + HALF

def compared(a: float, b: float) -> bool:
    return (a < b) == (b < 1.0)

def inferred(a: float, i: int) -> float:
    n = 1
    x = n
    x = x + a
    even = i % 2 == 0
    n += 2
    half = n
    half /= 2
    if even:
        late = a
    else:
        late = 2
    return x * half + late

def operators(a: float, i: int) -> float:
    x = a
    x += i
    x -= a - 1.0
    x *= a + 2
    x /= 3
    x %= 7.0
    x //= 2
    x **= 2
    k = i
    k *= i - 1
    k //= 3
    k %= 5
    return x + k

def several(a: float, b: float) -> float:
    a, b = b, a
    c, d = a + b, a - b
    c, d = d, c + d
    x = y = c * d
    return x - y * a + c / 3.0

def ranges(n: int, m: int) -> int:
    total = 0
    for i in range(n):
        total = total * 3 + i
    for i in range(m, n):
        total = total * 3 + i
    for i in range(n, m, -2):
        total += i
    for i in range(m, 20, THREE):
        total -= i
    return total

def range_bounds(w: "float[:]", n: int) -> int:
    count = 0
    for i in range(n):
        n = n - 1
        count += i
    w[0] = 5.0
    for _ in range(int(w[0])):
        w[0] = w[0] + 1.0
        count += 1
    return count

def counter(n: int) -> int:
    i = 7
    total = 0
    for i in range(n):
        total += i
        i = i * 2
        total += i
    for i in range(i, i + 3):
        for i in range(2):
            total += i
    return total * 100 + i

def counted(a: float, n: int) -> float:
    """"""
    x = a
    for x in range(n):
        a += 1.0
    return -x + a + HUGE

def leaving(w: "float[:]", n: int) -> float:
    i = 0
    while True:
        i += 1
        if i % 2 == 0:
            continue
        if i > n or w[i % 8] > 2.0:
            break
        w[i % 8] += i
    return w[0] + i

def tables(i: int) -> float:
    total = 0.0
    for j in range(4):
        total += KNOTS[j] * KNOTS[i % 4]
    return total + KNOTS[BACK + 3]

def named(double: float, short: int, log: float, y0: float) -> float:
    int64_t = double + short
    pow = log * y0
    return int64_t ** 2.0 + abs(pow)

def push(w: "float[:]", i: int) -> float:
    w[i % 8] = 2.0 * w[(i + 1) % 8] + w[i % 8] + 1.0
    return w[i % 8]

def peek(w: "float[:]", i: int) -> float:
    return w[i % 8]

def both(a: float, b: float) -> float:
    return 3.0 * a + b

def order(w: "float[:]", i: int) -> float:
    x = push(w, i) - push(w, i + 1) * w[1] + peek(w, i) / (push(w, i) + 5.0)
    y = both(w[0], push(w, 7)) + max(peek(w, 2), push(w, 1), w[2])
    w[int(push(w, 3)) % 8] = push(w, 3) + w[3]
    w[4] += push(w, 4)
    w[5], w[6] = push(w, 6), push(w, 5)
    w[0] = z = push(w, 2)
    if w[1] < push(w, 1):
        y += 1.0
    elif push(w, 2) * w[2] > 5.0:
        y -= 1.0
    return x + y + z if push(w, 1) > w[1] - 1.0 and push(w, 2) > 0.0 else push(w, 3)

def two_arrays(p: "float[:]", w: "float[:]") -> float:
    return push(w, 1) * p[1] + p[1] * push(p, 1)

def nothing(unused: float, w: "float[:]"):
    if w[0] > 0.0:
        return
    w[0] = -w[0]
'''
SPECIAL = (0.0, -0.0, 1.0, -1.0, 0.5, 2.0, 3.0, -7.5, 1e-300, 1e300, inf, -inf, nan)
#: What Python raises where C gives inf or nan, or leaves open what it does.
RAISED = (ZeroDivisionError, OverflowError, ValueError, TypeError)


@pytest.fixture(scope="module")
def translated(tmp_path_factory):
    return Library(SNIPPETS, tmp_path_factory.mktemp("snippets"))


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


@needs_compiler
@pytest.mark.parametrize("name", interpreted(SNIPPETS))
def test_what_becomes_c_gives_the_same(translated, name):
    python = interpreted(SNIPPETS)[name]
    assert compare(python, getattr(translated, name), 400, name) > 20


@needs_compiler
def test_two_arrays_may_be_one(translated):
    numbers, same = [0.5, -1.25, 3.0, *[0.75] * 5], np.array([0.5, -1.25, 3.0, *[0.75] * 5])
    expected = interpreted(SNIPPETS)["two_arrays"](numbers, numbers)
    assert translated.two_arrays(same, same) == expected
    assert same.tolist() == numbers


@needs_compiler
def test_the_compiler_has_nothing_to_say(translated):
    assert translated.said == ""


class Expressions:
    """Random expressions of a, b (float), i, j (int) and the array w."""

    def __init__(self, seed):
        self.draw = random.Random(seed)

    def number(self, depth):
        if depth == 0:
            return self.draw.choice(["a", "b", "i", "2", "0.5", "-3.0", "w[1]", "push(w, i)"])
        one, other = (self.number(depth - 1) for _ in range(2))
        forms = [
            *(f"{one} {sign} {other}" for sign in "+-*/"),
            *(f"{one} {sign} ({other})" for sign in ("+", "-", "*", "/", "//", "%")),
            *(f"({one}) {sign} {other}" for sign in ("-", "*", "/")),
            *(f"-{one}", f"-({one})", f"float({one}) ** 2", f"abs({one})", f"sin({one})"),
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


HEAD = SNIPPETS[: SNIPPETS.index("def association")]
CALLED = SNIPPETS[SNIPPETS.index("def push") : SNIPPETS.index("def order")]


@needs_compiler
def test_random_expressions_give_the_same(tmp_path):
    """Precedence, association, types and order of evaluation, in expressions nobody would write."""
    made, parts, refused = Expressions("expressions"), [HEAD, CALLED], 0
    while len(parts) < 302:
        text = (
            f'def f{len(parts)}(w: "float[:]", a: float, b: float, i: int) -> float:\n'
            f"    x = {made.number(made.draw.randint(2, 4))}\n"
            f"    if {made.question(2)}:\n        x += {made.number(2)}\n    return x\n"
        )
        try:
            c_source("\n".join([HEAD, CALLED, text]))
        except ValueError as error:  # a call that writes, where it may not be evaluated at all
            assert "writes into an array" in str(error)
            refused += 1
        else:
            parts.append(text)
    assert refused < 300
    text = "\n".join(parts)
    library = Library(text, tmp_path)
    functions = interpreted(text)
    compared = sum(
        compare(functions[name], getattr(library, name), 30, name)
        for name in functions
        if name.startswith("f")
    )
    assert compared > 3000


def test_what_is_read_only_is_constant():
    header = c_header(SNIPPETS)
    assert "double stickslip_two_arrays(double *p, double *w);" in header
    assert "double stickslip_peek(const double *w, int64_t i);" in header
    assert "static const int64_t MANY = INT64_C(5000000000);" in header
    assert "#ifndef STICKSLIP_KERNEL_H" in header


def test_it_reads_like_c_written_by_hand():
    text = '''
KNOTS = (0.5, 1.0)

def total(w: "float[:]", first: int) -> float:
    """Sum of some."""
    found = 0.0
    for i in range(2):
        found += KNOTS[i] * (w[first + i] - 1)
    return found
'''
    assert (
        c_source(text)
        == """\
#include "kernel.h"

#include <math.h>

static const double KNOTS[] = {0.5, 1.0};

/* Sum of some. */
double stickslip_total(const double *w, int64_t first) {
    double found = 0.0;
    for (int64_t i = 0; i < 2; i++) {
        found += KNOTS[i] * (w[first + i] - 1.0);
    }
    return found;
}
"""
    )


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
    "return a if a > w[0] > push(w) else 0.0": "a chain of comparisons with a call that writes",
    "return 0.0 if a > 0.0 and w[0] < push(w) else 1.0": "give it a statement of its own",
    "return µ": "a name that stands for no number",
}
PUSH = 'def push(w: "float[:]") -> float:\n    w[0] += 1.0\n    return w[0]\n\n'


@pytest.mark.parametrize("body", REFUSED)
def test_what_c_cannot_do_is_said_to_whoever_wrote_it(body):
    text = f'{PUSH}def f(w: "float[:]", a: float, i: int) -> float:\n    {body}\n'
    with pytest.raises(ValueError) as refusal:
        c_source(text)
    said = str(refusal.value)
    assert REFUSED[body] in said
    assert said.startswith("kernel function f, line ")
    assert "not in the subset that becomes C (allowed: numbers; arguments that are float" in said


@pytest.mark.parametrize(
    ("text", "why"),
    [
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
    ],
)
def test_what_no_text_of_a_kernel_has_is_refused(text, why):
    with pytest.raises(ValueError, match="not in the subset") as refusal:
        c_source(text)
    assert why in str(refusal.value)


def test_a_constant_takes_no_name_of_c():
    with pytest.raises(ValueError, match="a constant of a name that C has for something else"):
        c_header("NAN = 1.0")
