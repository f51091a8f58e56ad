"""What of the text becomes C: constants, functions, what is assigned to variables; and refusals."""

import ast
import math
from collections.abc import Iterator
from functools import cached_property
from typing import NamedTuple, NoReturn

#: How the text spells types -> what they are here.
_SPELLED = {"float": "float", "int": "int", "bool": "bool", "float[:]": "array", "None": "none"}
#: Type -> what C calls it. An int is as wide as a float's integers need it.
C_TYPES = {
    **{"float": "double", "int": "int64_t", "bool": "bool", "none": "void"},
    **{"array": "double *", "constant array": "const double *"},
}


class MathFunction(NamedTuple):
    """A function of `math`: its result's type, the number of its arguments, and C for them."""

    returns: str
    arguments: int
    form: str


def _plain(names: str, arguments: int, returns: str = "float") -> dict[str, MathFunction]:
    given = ", ".join("{}" for _ in range(arguments))
    return {name: MathFunction(returns, arguments, f"{name}({given})") for name in names.split()}


_ONE = "acos asin atan cos cosh exp expm1 fabs log log10 log1p sin sinh sqrt tan tanh"
MATH = {
    **_plain(_ONE, 1),
    **_plain("atan2 copysign fmod hypot pow", 2),
    **_plain("isfinite isinf isnan", 1, "bool"),
    "ceil": MathFunction("int", 1, "(int64_t)ceil({})"),
    "floor": MathFunction("int", 1, "(int64_t)floor({})"),
    "radians": MathFunction("float", 1, "radians({})"),
}
MATH_NUMBERS = {"pi": math.pi, "e": math.e, "tau": math.tau}
BUILTINS = ("abs", "bool", "float", "int", "max", "min")

#: What C or its mathematics gives a meaning to: a variable of such a name gets another.
RESERVED = {
    *"auto bool break case char const continue default do double else enum extern false".split(),
    *"float for goto if inline int int64_t long main register restrict return short".split(),
    *"signed sizeof static struct switch true typedef union unsigned void volatile while".split(),
    *"_Bool _Complex _Imaginary HUGE_VAL HUGE_VALF HUGE_VALL INFINITY M_E M_PI NAN".split(),
    *MATH,
}

ALLOWED = (
    "numbers; arguments that are float, int, bool or arrays 'float[:]', and their elements; "
    "if, while, for ... in range(); + - * / // % **, comparisons, and, or, not; "
    f"{', '.join(BUILTINS)}; functions of the kernel; from math: "
    f"{', '.join(sorted([*MATH, *MATH_NUMBERS]))}"
)


def refuse(where: str, node: ast.AST, why: str = "") -> NoReturn:
    """Say what cannot become C, where it stands, and what can."""
    code = ast.unparse(node).split("\n")[0]
    raise ValueError(
        f"{where}, line {getattr(node, 'lineno', 1)}: `{code}`: {why}{': ' if why else ''}"
        f"not in the subset that becomes C (allowed: {ALLOWED})"
    )


class Program:
    """The text, taken apart."""

    def __init__(self, text: str) -> None:
        self.body = ast.parse(text).body
        self.constants: dict[str, bool | int | float | tuple[float, ...]] = {}
        self.functions: dict[str, Function] = {}
        self.imported: set[str] = set()
        for node in self.body:
            self._take(node)

    def _take(self, node: ast.stmt) -> None:
        match node:
            case ast.FunctionDef(name=name):
                self._check_new(node, name)
                self.functions[name] = Function(node)
            case ast.Assign(targets=[ast.Name(id=name)], value=value):
                self._check_new(node, name)
                self.constants[name] = _constant(node, value)
            case ast.ImportFrom(module="math", names=names):
                for alias in names:
                    if alias.asname or alias.name not in {*MATH, *MATH_NUMBERS}:
                        refuse("kernel", node, f"no {ast.unparse(alias)} there")
                    self.imported.add(alias.name)
            case ast.Expr(value=ast.Constant(value=str())):
                pass
            case _:
                refuse("kernel", node, "neither a function nor a constant")

    def _check_new(self, node: ast.AST, name: str) -> None:
        if name in self.constants or name in self.functions:
            refuse("kernel", node, f"{name} has been given before")
        if not name.isascii():
            refuse("kernel", node, "a name with other letters than a to z")

    def number(self, name: str) -> bool | int | float | tuple[float, ...] | None:
        """The constant of a name, the text's own or one of `math`."""
        if name in self.constants:
            return self.constants[name]
        return MATH_NUMBERS.get(name) if name in self.imported else None

    @cached_property
    def written(self) -> dict[str, set[str]]:
        """Function -> those of its arrays that it, or what it calls, writes into."""
        found = {name: set(function.stored_arrays) for name, function in self.functions.items()}
        grows = True
        while grows:
            before = sum(map(len, found.values()))
            for name, function in self.functions.items():
                given = self._given(function.node)
                found[name] |= {own for callee, array, own in given if array in found[callee]}
            grows = sum(map(len, found.values())) > before
        return found

    def _given(self, node: ast.AST) -> Iterator[tuple[str, str, str]]:
        """Of calls: the function, a name of its head, and the variable that is given for it."""
        for each in ast.walk(node):
            match each:
                case ast.Call(func=ast.Name(id=callee), args=given) if callee in self.functions:
                    for own, one in zip(self.functions[callee].parameters, given, strict=False):
                        if isinstance(one, ast.Name):
                            yield callee, own, one.id

    def writes(self, node: ast.AST) -> set[str]:
        """Arrays that calls in an expression write into."""
        return {given for callee, own, given in self._given(node) if own in self.written[callee]}

    def order_matters(self, one: ast.AST, other: ast.AST) -> bool:
        """Whether two operands may give something else in another order; no two arrays are one."""
        pairs = ((one, other), (other, one))
        return any(self.writes(first) & self._touched(second) for first, second in pairs)

    def _touched(self, node: ast.AST) -> set[str]:
        """Variables that an expression takes elements of, or gives to functions."""
        read = (each.value for each in ast.walk(node) if isinstance(each, ast.Subscript))
        own = {array.id for array in read if isinstance(array, ast.Name)}
        return own | {given for _, _, given in self._given(node)}


def _constant(node: ast.stmt, value: ast.expr) -> bool | int | float | tuple[float, ...]:
    try:
        number = ast.literal_eval(value)
    except ValueError:
        number = None
    parts = number if isinstance(number, tuple) else (number,)
    if parts and all(isinstance(part, (int, float)) and math.isfinite(part) for part in parts):
        return tuple(map(float, parts)) if number is parts else number
    refuse("kernel", node, "neither a finite number nor a tuple of such")


class Function:
    """A function of the text: its name, and types of what it takes and gives."""

    def __init__(self, node: ast.FunctionDef) -> None:
        self.node, self.name = node, node.name
        self.where = f"kernel function {node.name}"
        taken = node.args
        if taken.defaults or taken.kwonlyargs or taken.vararg or taken.kwarg or taken.posonlyargs:
            refuse(self.where, node, "arguments are plain, without defaults")
        if node.decorator_list:
            refuse(self.where, node, "a decorator")
        self.parameters = {each.arg: self._type(each, each.annotation) for each in taken.args}
        self.returns = "none" if node.returns is None else self._type(node, node.returns)
        if self.returns == "array" or "none" in self.parameters.values():
            refuse(self.where, node, "takes None or gives an array")

    def _type(self, node: ast.AST, annotation: ast.expr | None) -> str:
        spelled = annotation and ast.unparse(annotation).strip("'\"")
        if spelled not in _SPELLED:
            refuse(self.where, node, "a type that is none of float, int, bool, 'float[:]'")
        return _SPELLED[spelled]

    @property
    def stored_arrays(self) -> Iterator[str]:
        """Arrays whose elements are assigned to."""
        for node in ast.walk(self.node):
            match node:
                case ast.Subscript(value=ast.Name(id=name), ctx=ast.Store()):
                    yield name


def assignments(function: ast.FunctionDef) -> Iterator[tuple[str, ast.expr]]:
    """Name of a variable, and what is assigned to it."""
    for node in ast.walk(function):
        match node:
            case ast.Assign(targets=targets, value=value):
                for target in targets:
                    for one, given in pairs(target, value):
                        if isinstance(one, ast.Name):
                            yield one.id, given
            case ast.AugAssign(target=ast.Name(id=name), op=op, value=value):
                yield name, ast.copy_location(ast.BinOp(ast.Name(name), op, value), node)
            case ast.For(target=ast.Name(id=name)):
                yield name, ast.copy_location(ast.Constant(0), node)


def pairs(target: ast.expr, value: ast.expr) -> list[tuple[ast.expr, ast.expr]]:
    """Targets with what each is given; those of a tuple one by one."""
    match target, value:
        case ast.Tuple(elts=targets), ast.Tuple(elts=values) if len(targets) == len(values):
            return list(zip(targets, values, strict=True))
    return [(target, value)]
