"""What is assigned to a function's variables, from which their types follow."""

import ast
from collections.abc import Iterator


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
