"""Expressions as C, evaluated in Python's order and with Python's results."""

import ast
from collections.abc import Callable, Sequence
from copy import copy
from importlib import resources
from itertools import combinations
from typing import NamedTuple

from .c_program import BUILTINS, C_TYPES, MATH, RESERVED, Function, Program, assignments, refuse

#: What binds how tightly in C; parentheses stand where less does within more.
ATOM, UNARY, PRODUCT, SUM, ORDER, EQUALITY, AND, OR, CHOICE = 9, 8, 7, 6, 5, 4, 3, 2, 1
_ARITHMETIC = {ast.Add: ("+", SUM), ast.Sub: ("-", SUM), ast.Mult: ("*", PRODUCT)}
_COMPARISONS = {
    **{ast.Lt: ("<", ORDER), ast.LtE: ("<=", ORDER), ast.Gt: (">", ORDER), ast.GtE: (">=", ORDER)},
    **{ast.Eq: ("==", EQUALITY), ast.NotEq: ("!=", EQUALITY)},
}
_HELPED = {ast.FloorDiv: "floor_divide", ast.Mod: "modulo"}

#: What C's own operators and functions do otherwise than Python's, by name, as C.
_TEXTS = (
    (resources.files(__package__) / "c_helpers.c").read_text("utf-8").rstrip().split("\n\n")[1:]
)
HELPERS = {text.split("(")[0].split()[-1]: text for text in _TEXTS}


class Made(NamedTuple):
    """An expression in C, its type, and how tightly it binds."""

    text: str
    type: str
    binds: int = ATOM

    def within(self, binds: int) -> str:
        """The text where what binds less needs parentheses."""
        return self.text if self.binds >= binds else f"({self.text})"


class Expressions:
    """The expressions of a function.

    Python evaluates operands from left to right; C says nothing of their order. Where it matters,
    because one writes into an array, they are refused.

    of_names : type of each variable, "float", "int", "bool" or "array": what all that is assigned
        to it is; int and float together are float
    """

    def __init__(self, program: Program, function: Function, helpers: set[str]) -> None:
        self.program, self.where = program, function.where
        self.helpers = helpers
        given = [each for each in assignments(function.node) if each[0] not in function.parameters]
        self.of_names: dict[str, str | None] = {**function.parameters, **dict.fromkeys(dict(given))}
        self._find_types(given)

    def _find_types(self, given: Sequence[tuple[str, ast.expr]]) -> None:
        before = None
        while before != self.of_names:
            before = dict(self.of_names)
            for name, value in given:
                known, found = self.of_names[name], self._tried(value)
                if known and found and known != found and {known, found} != {"int", "float"}:
                    refuse(self.where, value, f"{known} and {found} in one place")
                self.of_names[name] = "float" if "float" in (known, found) else known or found

    def _tried(self, value: ast.expr) -> str | None:
        """Type of an expression; None as long as nothing is known of its variables."""
        trial = copy(self)
        trial.helpers = set()
        try:
            return trial.made(value).type
        except ValueError:  # which is what comes of it in the end, where it stays so
            return None

    def name(self, name: str) -> str:
        """How C spells a variable: with a line behind it where C has the name, or it has one.

        So no variable has a name with a single line behind it but those, and those made here.
        """
        if not name.isascii():
            refuse(self.where, ast.Name(name), "a name with other letters than a to z")
        return f"{name}_" if name in RESERVED | HELPERS.keys() or name.endswith("_") else name

    def made(self, node: ast.expr) -> Made:
        """An expression in C."""
        match node:
            case ast.Constant(value=bool() as value):
                return Made(str(value).lower(), "bool")
            case ast.Constant(value=int() | float() as value):
                return Made(number_text(value), type(value).__name__)
            case ast.Name(id=name):
                return self._made_name(node, name)
            case ast.Subscript(value=ast.Name(id=name), slice=index):
                return Made(f"{self._array(node, name)}[{self.index(index)}]", "float")
            case ast.BinOp():
                return self._made_operation(node)
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                return Made(f"!{self.condition(operand).within(ATOM)}", "bool", UNARY)
            case ast.UnaryOp(op=ast.USub() | ast.UAdd() as op, operand=operand):
                number = self._as_number(operand, self.made(operand))
                sign = "-" if isinstance(op, ast.USub) else "+"
                return Made(sign + number.within(ATOM), number.type, UNARY)
            case ast.BoolOp():
                return self._made_boolean(node, self._bool)
            case ast.Compare():
                return self._made_comparison(node)
            case ast.IfExp():
                return self._made_choice(node)
            case ast.Call(func=ast.Name(id=name), args=given, keywords=[]):
                return self._made_call(node, name, given)
        refuse(self.where, node)

    def condition(self, node: ast.expr) -> Made:
        """An expression as what `if` asks: a number counts where it is not zero."""
        if isinstance(node, ast.BoolOp):
            return self._made_boolean(node, self.condition)
        value = self.made(node)
        if value.type == "bool":
            return value
        return Made(f"{value.within(SUM)} != {self._zero(node, value)}", "bool", EQUALITY)

    def as_type(self, node: ast.expr, value: Made, wanted: str) -> Made:
        """An int as float; anything else must be what is wanted."""
        if value.type == wanted:
            return value
        if (value.type, wanted) != ("int", "float"):
            refuse(self.where, node, f"{value.type} where {wanted} is wanted")
        if value.text.lstrip("-").isdigit():
            return Made(repr(float(int(value.text))), "float", value.binds)
        return Made(f"(double){value.within(UNARY)}", "float", UNARY)

    def typed(self, node: ast.expr, wanted: str) -> Made:
        """An expression as something of a type."""
        return self.as_type(node, self.made(node), wanted)

    def index(self, node: ast.expr) -> str:
        """Where in an array; Python counts negative ones from its end, which C does not know."""
        if isinstance(node, ast.UnaryOp):
            refuse(self.where, node, "an index from an array's end")
        return self.typed(node, "int").text

    def of_any_order(self, nodes: Sequence[ast.expr]) -> list[Made]:
        """Operands, in whatever order C evaluates them."""
        for one, other in combinations(nodes, 2):
            if self.program.order_matters(one, other):
                refuse(
                    self.where,
                    one,
                    "what it is evaluated before, or after, writes into an array: "
                    "give it a statement of its own",
                )
        return [self.made(each) for each in nodes]

    def _bool(self, node: ast.expr) -> Made:
        return self.typed(node, "bool")

    def _as_number(self, node: ast.expr, value: Made) -> Made:
        if value.type not in ("int", "float"):
            refuse(self.where, node, f"{value.type} where a number is wanted")
        return value

    def _zero(self, node: ast.expr, value: Made) -> str:
        return "0" if self._as_number(node, value).type == "int" else "0.0"

    def _made_name(self, node: ast.expr, name: str) -> Made:
        if name in self.of_names:
            kind = self.of_names[name]
            if kind not in ("float", "int", "bool"):
                refuse(
                    self.where, node, "an array as a whole" if kind else "nothing is known of it"
                )
            return Made(self.name(name), kind)
        number = self.program.number(name)
        if number is None or isinstance(number, tuple):
            refuse(self.where, node, "a name that stands for no number")
        own = name in self.program.constants
        return Made(name if own else number_text(number), type(number).__name__)

    def _array(self, node: ast.AST, name: str) -> str:
        if self.of_names.get(name) == "array":
            return self.name(name)
        if name in self.of_names or not isinstance(self.program.number(name), tuple):
            refuse(self.where, node, f"{name} is no array")
        return name

    def _made_operation(self, node: ast.BinOp) -> Made:
        operands = [node.left, node.right]
        values = [
            self._as_number(each, value)
            for each, value in zip(operands, self.of_any_order(operands), strict=True)
        ]
        whole = all(value.type == "int" for value in values)
        if isinstance(node.op, ast.Pow) and whole:
            refuse(self.where, node, "int ** int, which is int or float: write float(...)")
        if not whole or isinstance(node.op, ast.Div):
            values = self._floats(operands, values)
        one, other = values
        kind = one.type
        if type(node.op) in _ARITHMETIC or isinstance(node.op, ast.Div):
            sign, binds = _ARITHMETIC.get(type(node.op), ("/", PRODUCT))
            return Made(f"{one.within(binds)} {sign} {other.within(binds + 1)}", kind, binds)
        if isinstance(node.op, ast.Pow):
            return Made(f"pow({one.text}, {other.text})", kind)
        if type(node.op) not in _HELPED:
            refuse(self.where, node)
        return self._helped(_HELPED[type(node.op)], values)

    def _floats(self, nodes: Sequence[ast.expr], values: Sequence[Made]) -> list[Made]:
        return [
            self.as_type(node, value, "float") for node, value in zip(nodes, values, strict=True)
        ]

    def _helped(self, name: str, values: Sequence[Made]) -> Made:
        """A call of a helper, of the one for int if all are."""
        kind = values[0].type
        name += "_int" if kind == "int" else ""
        self.helpers.add(name)
        return Made(f"{name}({', '.join(value.text for value in values)})", kind)

    def _made_boolean(self, node: ast.BoolOp, part: Callable[[ast.expr], Made]) -> Made:
        sign, binds = ("&&", AND) if isinstance(node.op, ast.And) else ("||", OR)
        texts = (part(each).within(EQUALITY) for each in node.values)
        return Made(f" {sign} ".join(texts), "bool", binds)

    def _made_comparison(self, node: ast.Compare) -> Made:
        operands = [node.left, *node.comparators]
        if len(operands) > 2 and any(self.program.writes(each) for each in operands):
            refuse(self.where, node, "a chain of comparisons with a call that writes into an array")
        values = self.of_any_order(operands)
        texts = []
        for i, op in enumerate(node.ops):
            if type(op) not in _COMPARISONS:
                refuse(self.where, node)
            sign, binds = _COMPARISONS[type(op)]
            one, other = self._alike(operands[i : i + 2], values[i : i + 2])
            texts.append(f"{one.within(SUM)} {sign} {other.within(SUM)}")
        return Made(" && ".join(texts), "bool", AND if len(texts) > 1 else binds)

    def _alike(self, nodes: Sequence[ast.expr], values: Sequence[Made]) -> Sequence[Made]:
        """Values of one type: all as float if any is."""
        if any(value.type == "float" for value in values):
            return self._floats(nodes, values)
        for node, value in zip(nodes, values, strict=True):
            self.as_type(node, value, values[0].type)
        return values

    def _made_choice(self, node: ast.IfExp) -> Made:
        test = self.condition(node.test).within(OR)
        branches = [node.body, node.orelse]
        one, other = self._alike(branches, [self.made(each) for each in branches])
        return Made(f"{test} ? {one.within(OR)} : {other.within(OR)}", one.type, CHOICE)

    def _made_call(self, node: ast.expr, name: str, given: list[ast.expr]) -> Made:
        if name in self.of_names:
            refuse(self.where, node, f"{name} is a variable")
        if name in self.program.functions:
            return self._made_kernel_call(node, self.program.functions[name], given)
        if name in self.program.imported and name in MATH:
            return self._made_math_call(node, name, given)
        if name not in BUILTINS:
            refuse(self.where, node, f"{name} is unknown")
        values = self.of_any_order(given)
        if name in ("max", "min") and len(values) > 1:
            return self._made_extreme(name, given, values)
        if len(values) != 1:
            refuse(self.where, node, f"{len(values)} arguments")
        return self._made_builtin(name, given[0], values[0])

    def _made_builtin(self, name: str, node: ast.expr, value: Made) -> Made:
        if name == "abs":
            if self._as_number(node, value).type == "int":
                return self._helped("absolute", [value])
            return Made(f"fabs({value.text})", "float")
        if name not in ("int", "float", "bool"):
            refuse(self.where, node, f"{name} of a single value")
        if value.type == name:
            return value
        if name == "bool":
            return Made(f"{value.within(SUM)} != {self._zero(node, value)}", "bool", EQUALITY)
        if name == "float" and value.type == "int":
            return self.as_type(node, value, "float")
        return Made(f"({C_TYPES[name]}){value.within(UNARY)}", name, UNARY)

    def _made_extreme(self, name: str, nodes: list[ast.expr], values: list[Made]) -> Made:
        values = [
            self._as_number(node, value)
            for node, value in zip(nodes, self._alike(nodes, values), strict=True)
        ]
        found = values[0]
        for value in values[1:]:
            found = self._helped("larger" if name == "max" else "smaller", [found, value])
        return found

    def _made_math_call(self, node: ast.expr, name: str, given: list[ast.expr]) -> Made:
        function = MATH[name]
        if len(given) != function.arguments:
            refuse(self.where, node, f"{len(given)} arguments instead of {function.arguments}")
        values = self._floats(given, self.of_any_order(given))
        if name in HELPERS:
            self.helpers.add(name)
        text = function.form.format(*(value.text for value in values))
        return Made(text, function.returns, UNARY if text.startswith("(") else ATOM)

    def _made_kernel_call(self, node: ast.expr, function: Function, given: list[ast.expr]) -> Made:
        if len(given) != len(function.parameters):
            refuse(
                self.where, node, f"{len(given)} arguments instead of {len(function.parameters)}"
            )
        kinds = list(function.parameters.values())
        scalars = [each for each, kind in zip(given, kinds, strict=True) if kind != "array"]
        made = iter(zip(scalars, self.of_any_order(scalars), strict=True))
        texts = []
        for each, kind in zip(given, kinds, strict=True):
            texts.append(
                self._whole_array(each) if kind == "array" else self.as_type(*next(made), kind).text
            )
        return Made(f"{function_name(function.name)}({', '.join(texts)})", function.returns)

    def _whole_array(self, node: ast.expr) -> str:
        if isinstance(node, ast.Name) and self.of_names.get(node.id) == "array":
            return self.name(node.id)
        refuse(self.where, node, "no array as a whole")


def number_text(number: int | float) -> str:
    """A number in C, the same to the last bit; a large int as one that can be multiplied."""
    if isinstance(number, int) and abs(number) >= 2**15:
        return f"INT64_C({number})"
    return repr(number).replace("inf", "INFINITY")


def function_name(name: str) -> str:
    """How C calls a function: libm and others in the process have theirs."""
    return f"stickslip_{name}"
