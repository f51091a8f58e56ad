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
import re
from collections.abc import Callable
from inspect import cleandoc

from .c_expressions import HELPERS, Expressions, Made, function_name, number_text
from .c_program import C_TYPES, RESERVED, Function, Program, pairs, refuse

_WIDTH = 100
_TAB = "    "
_PLACES_TO_FOLD = re.compile(r"(?<=,) | (?=(?:[-+*/?:]|&&|\|\|) )")
_NOTHING = {"float": "0.0", "int": "0", "bool": "false"}


def prototype(program: Program, function: Function, spelled: Callable[[str], str]) -> str:
    """The head of a function, without what ends it."""
    given = []
    for name, kind in function.parameters.items():
        reads = kind == "array" and name not in program.written[function.name]
        kind = C_TYPES["constant array" if reads else kind]
        given.append(f"{kind}{'' if kind.endswith('*') else ' '}{spelled(name)}")
    head = f"{C_TYPES[function.returns]} {function_name(function.name)}"
    return f"{head}({', '.join(given) or 'void'})"


def folded(line: str) -> str:
    """A line of C in several where it is long, behind commas and before operators."""
    indent = line[: len(line) - len(line.lstrip())]
    parts = _PLACES_TO_FOLD.split(line.strip())
    lines = [indent + parts[0]]
    for part in parts[1:]:
        if len(lines[-1]) + 1 + len(part) <= _WIDTH:
            lines[-1] += f" {part}"
        else:
            lines.append(f"{indent}{2 * _TAB}{part}")
    return "\n".join(lines)


def comment(text: str) -> list[str]:
    """Lines of a comment that says a docstring."""
    lines = text.replace("*/", "* /").replace("/*", "/ *").split("\n")
    if len(lines) == 1:
        return [f"/* {lines[0]} */"]
    return [f"/* {lines[0]}", *(f" * {line}".rstrip() for line in lines[1:]), " */"]


class Statements:
    """The statements of a function, line by line."""

    def __init__(self, program: Program, function: Function, helpers: set[str]) -> None:
        self.program, self.function, self.where = program, function, function.where
        self.made = Expressions(program, function, helpers)
        self.head = prototype(program, function, self.made.name)
        self.lines: list[str] = []
        self.depth = 0

    def text(self) -> str:
        """Comment, head and body of the function."""
        body = self.function.node.body
        said = ast.get_docstring(self.function.node)
        self.lines += comment(said) if said is not None else []
        self._line(f"{self.head} {{")
        self.depth += 1
        self._begin(body)
        for statement in body[said is not None :]:
            self._statement(statement)
        self.depth -= 1
        if self.function.returns != "none" and not _ends(body):
            refuse(self.where, body[-1], "the function can end here without a value")
        self._line("}")
        return "\n".join(self.lines)

    def _begin(self, body: list[ast.stmt]) -> None:
        """Declare the variables; say which arguments are for others."""
        for name, kind in self.made.of_names.items():
            spelled = self.made.name(name)
            if name in self.function.parameters:
                if not any(mentions(statement, name) for statement in body):
                    self._line(f"(void){spelled};")
            elif kind in _NOTHING and self._is_read(name):
                self._line(f"{C_TYPES[kind]} {spelled} = {_NOTHING[kind]};")

    def _line(self, text: str) -> None:
        self.lines.append(folded(_TAB * self.depth + text))

    def _block(self, body: list[ast.stmt]) -> None:
        self.depth += 1
        for statement in body:
            self._statement(statement)
        self.depth -= 1

    def _statement(self, node: ast.stmt) -> None:
        match node:
            case ast.Assign(targets=targets, value=value):
                self._assign(node, targets, value)
            case ast.AugAssign(target=target, op=op, value=value):
                whole = ast.copy_location(ast.BinOp(target, op, value), node)
                self._assign(node, [target], whole)
            case ast.If():
                self._if(node)
            case ast.While(test=test, body=body, orelse=[]):
                self._line(f"while ({self.made.condition(test).text}) {{")
                self._block(body)
                self._line("}")
            case ast.For(target=ast.Name(id=name), orelse=[]):
                self._for(node, name)
            case ast.Return(value=value):
                self._return(node, value)
            case ast.Expr(value=ast.Call() as call):
                self._line(f"{self.made.made(call).text};")
            case ast.Break():
                self._line("break;")
            case ast.Continue():
                self._line("continue;")
            case ast.Pass():
                pass
            case _:
                refuse(self.where, node)

    def _assign(self, node: ast.stmt, targets: list[ast.expr], value: ast.expr) -> None:
        """All that is given is evaluated before the first target gets any of it."""
        given = [pair for target in targets for pair in pairs(target, value)]
        if len(given) > 1 and len(targets) > 1 and isinstance(value, ast.Tuple):
            refuse(self.where, node, "several tuples")
        sources = list(dict.fromkeys(each for _, each in given))
        places = [target.slice for target, _ in given if isinstance(target, ast.Subscript)]
        values = dict(zip(sources, self.made.of_any_order([*sources, *places]), strict=False))
        if len(given) > 1:
            self._line("{")
            for number, (each, made) in enumerate(values.items()):
                self._line(f"{_TAB}const {C_TYPES[made.type]} value{number}_ = {made.text};")
                values[each] = Made(f"value{number}_", made.type)
        for target, each in given:
            place, kind = self._place(node, target)
            text = self.made.as_type(each, values[each], kind).text
            self._line(f"{_TAB * (len(given) > 1)}{place} = {text};")
        if len(given) > 1:
            self._line("}")

    def _place(self, node: ast.stmt, target: ast.expr) -> tuple[str, str]:
        """What is assigned to, in C, and its type."""
        match target:
            case ast.Name(id=name) if self.made.of_names[name] in _NOTHING:
                return self.made.name(name), self.made.of_names[name] or ""
            case ast.Subscript(value=ast.Name(id=name)):
                if self.made.of_names.get(name) == "array":
                    return self.made.made(target).text, "float"
        refuse(self.where, node, "assigned to what is neither a variable nor an element")

    def _if(self, node: ast.If, begin: str = "") -> None:
        test = self.made.condition(node.test).text
        self._line(f"{begin}if ({test}) {{")
        self._block(node.body)
        match node.orelse:
            case []:
                self._line("}")
            case [ast.If(test=other) as more] if not self.program.writes(other):
                self._if(more, "} else ")
            case more:
                self._line("} else {")
                self._block(more)
                self._line("}")

    def _is_read(self, name: str) -> bool:
        """Whether anything takes the value of a variable: a counter may only count."""
        return any(
            isinstance(each, ast.Name) and each.id == name and isinstance(each.ctx, ast.Load)
            for each in ast.walk(self.function.node)
        )

    def _for(self, node: ast.For, name: str) -> None:
        """Python's counter and bound are its own, whatever the loop makes of their variables."""
        start, stop, step = self._range(node)
        first, last = (self.made.typed(each, "int").text for each in (start, stop))
        at, end, sign = f"{name}_at_", f"{name}_end_", "<" if step > 0 else ">"
        begin = f"int64_t {at} = {first}, {end} = {last}"
        self._line(f"for ({begin}; {at} {sign} {end}; {at} += {step}) {{")
        if self._is_read(name):
            place, kind = self._place(node, node.target)
            now = self.made.as_type(node.target, Made(at, "int"), kind).text
            self._line(f"{_TAB}{place} = {now};")
        self._block(node.body)
        self._line("}")

    def _range(self, node: ast.For) -> tuple[ast.expr, ast.expr, int]:
        """Begin, end and step, a whole constant."""
        match node.iter:
            case ast.Call(func=ast.Name(id="range"), args=given, keywords=[]):
                if any(self.program.writes(each) for each in given):
                    refuse(self.where, node, "a range by what writes into an array")
                first, one = (ast.copy_location(ast.Constant(i), node) for i in (0, 1))
                match given:
                    case [stop]:
                        return first, stop, self._step(node, one)
                    case [start, stop, *step] if len(step) < 2:
                        return start, stop, self._step(node, *step or [one])
        refuse(self.where, node, "loops go over range()")

    def _step(self, node: ast.For, step: ast.expr) -> int:
        sign, size = 1, step
        if isinstance(step, ast.UnaryOp) and isinstance(step.op, ast.USub):
            sign, size = -1, step.operand
        value: object = size.value if isinstance(size, ast.Constant) else None
        if isinstance(size, ast.Name) and size.id not in self.made.of_names:
            value = self.program.constants.get(size.id)
        if not isinstance(value, int) or value == 0:
            refuse(self.where, node, "the step of a range is a whole constant")
        return sign * value

    def _return(self, node: ast.Return, value: ast.expr | None) -> None:
        kind = self.function.returns
        if value is None or kind == "none":
            if value is not None or kind != "none":
                refuse(self.where, node, f"the function gives {kind}, as its head says")
            self._line("return;")
            return
        text = self.made.typed(value, kind).text
        self._line(f"return {text};")


def mentions(node: ast.AST, name: str) -> bool:
    """Whether a variable is read or assigned to."""
    return any(isinstance(each, ast.Name) and each.id == name for each in ast.walk(node))


def _ends(block: list[ast.stmt]) -> bool:
    """Whether a block returns in any case."""
    match block[-1] if block else None:
        case ast.Return():
            return True
        case ast.If(body=body, orelse=orelse):
            return _ends(body) and _ends(orelse)
    return False


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
