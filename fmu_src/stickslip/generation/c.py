"""The kernel's text as C99: what runs where there is no Python.

The text keeps to few means (`c_program.ALLOWED`), each of which C has too, and what is made of it
gives the same to the last bit: operations in Python's order and association, `**` as `pow`, no
contraction or reordering if the compiler is told so (``-ffp-contract=off``). No function keeps
anything between calls or asks for memory. What C leaves open where Python raises an error, it
leaves open here too: a division of ints by zero, an int beyond 64 bits, an index beyond an array;
with floats such a place gives inf or nan. A variable that Python has as int at one time and as
float at another is a float throughout.
"""

import ast
from inspect import cleandoc

from .c_expressions import HELPERS, number_text
from .c_program import RESERVED, Program, refuse
from .c_statements import Statements, comment, folded


def c_header(text: str) -> str:
    """``kernel.h``: the constants, and prototypes of all functions."""
    program = Program(text)
    heads = [
        folded(f"{Statements(program, function, set()).head};")
        for function in program.functions.values()
    ]
    parts = [
        "#ifndef STICKSLIP_KERNEL_H\n#define STICKSLIP_KERNEL_H",
        "#include <stdbool.h>\n#include <stdint.h>",
        _constants(program),
        "\n".join(heads),
        "#endif",
    ]
    return "\n\n".join(filter(None, parts)) + "\n"


def c_source(text: str) -> str:
    """``kernel.c``, beside ``kernel.h``: the functions, in the text's order under its headings."""
    program = Program(text)
    helpers: set[str] = set()
    parts = []
    for node in program.body:
        match node:
            case ast.FunctionDef(name=name):
                parts.append(Statements(program, program.functions[name], helpers).text())
            case ast.Expr(value=ast.Constant(value=str(said))):
                parts.append("\n".join(comment(cleandoc(said))))
    includes = '#include "kernel.h"\n\n#include <math.h>'
    helped = [HELPERS[name] for name in HELPERS if name in helpers]
    tables = _tables(program, "".join(parts))
    return "\n\n".join([includes, *tables, *helped, *parts]) + "\n"


def _constants(program: Program) -> str:
    """Whole numbers as an enumeration, which C can count array elements with; others typed."""
    whole, others = [], []
    for name, value in program.constants.items():
        if name in RESERVED or name in HELPERS:
            refuse("kernel", ast.Name(name), "a constant of a name that C has for something else")
        if isinstance(value, bool):
            others.append(f"static const bool {name} = {str(value).lower()};")
        elif isinstance(value, int) and number_text(value) == repr(value):
            whole.append(f"    {name} = {value},")
        elif isinstance(value, int):
            others.append(f"static const int64_t {name} = {number_text(value)};")
        elif isinstance(value, float):
            others.append(f"static const double {name} = {number_text(value)};")
    enumeration = ["enum {", *whole, "};"] if whole else []
    return "\n".join([*enumeration, *others])


def _tables(program: Program, code: str) -> list[str]:
    """Constants that are arrays, those that the functions read."""
    return [
        folded(f"static const double {name}[] = {{{', '.join(map(number_text, value))}}};")
        for name, value in program.constants.items()
        if isinstance(value, tuple) and f"{name}[" in code
    ]
