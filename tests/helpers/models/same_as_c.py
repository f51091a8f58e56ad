"""Functions of Python and what they became in C, called with the same arguments."""

import random
import struct
from math import inf, nan

import numpy as np

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
