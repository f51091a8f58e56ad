"""Types of a function's variables, from what is assigned to them."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from .c_program import MATH, Function, Program, refuse


class Types:
    """Type of each variable and expression of a function: "float", "int", "bool" or "array".

    A variable is what all that is assigned to it is; int and float together are float.
    """

    def __init__(self, program: Program, function: Function) -> None:
        self.program, self.function = program, function
        self.of_names: dict[str, str | None] = dict(function.parameters)
        stored = [name for name, _ in self._assignments() if name not in function.parameters]
        self.of_names |= dict.fromkeys(stored)
        before = None
        while before != self.of_names:
            before = dict(self.of_names)
            for name, value in self._assignments():
                if name not in function.parameters:
                    known = self.of_names[name]
                    self.of_names[name] = self._join(value, known, self.of(value))

    def _assignments(self) -> Iterator[tuple[str, ast.expr]]:
        """Name of a variable, and what is assigned to it."""
        for node in ast.walk(self.function.node):
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

    def of(self, node: ast.expr) -> str | None:
        """Type of an expression; None as long as nothing is known of its variables."""
        match node:
            case ast.Constant(value=value):
                return type(value).__name__
            case ast.Name(id=name):
                return self._of_name(name)
            case ast.Compare() | ast.UnaryOp(op=ast.Not()):
                return "bool"
            case ast.BinOp(op=ast.Div() | ast.Pow()) | ast.Subscript():
                return "float"
            case ast.BinOp(left=one, right=other) | ast.IfExp(body=one, orelse=other):
                return self._join(node, self.of(one), self.of(other))
            case ast.UnaryOp(operand=operand):
                return self.of(operand)
            case ast.BoolOp(values=values):
                return self._of_all(node, values)
            case ast.Call(func=ast.Name(id=name), args=given):
                return self._of_call(node, name, given)
        return None

    def _of_name(self, name: str) -> str | None:
        if name in self.of_names:
            return self.of_names[name]
        number = self.program.number(name)
        return None if number is None else type(number).__name__

    def _of_call(self, node: ast.expr, name: str, given: list[ast.expr]) -> str | None:
        if name in self.program.functions:
            return self.program.functions[name].returns
        if name in ("float", "int", "bool"):
            return name
        return MATH[name].returns if name in MATH else self._of_all(node, given)

    def _of_all(self, node: ast.expr, parts: list[ast.expr]) -> str | None:
        found = None
        for part in parts:
            found = self._join(node, found, self.of(part))
        return found

    def _join(self, node: ast.AST, one: str | None, other: str | None) -> str | None:
        if one is None or other is None or one == other:
            return one or other
        if {one, other} == {"int", "float"}:
            return "float"
        refuse(self.function.where, node, f"{one} and {other} in one place")


def pairs(target: ast.expr, value: ast.expr) -> list[tuple[ast.expr, ast.expr]]:
    """Targets with what each is given; those of a tuple one by one."""
    match target, value:
        case ast.Tuple(elts=targets), ast.Tuple(elts=values) if len(targets) == len(values):
            return list(zip(targets, values, strict=True))
    return [(target, value)]
