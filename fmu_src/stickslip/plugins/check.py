"""Whether the terms of a file can become C, and if not, at which of its lines."""

import ast
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NoReturn

from ..effects.effect import Effect
from ..generation.c import c_source
from ..generation.c_program import BUILTINS, MATH, MATH_NUMBERS
from ..generation.functions import NAMES, named_numbers, names_in
from ..generation.slots import functions_in_kernel, packed_terms
from .errors import PluginError

ALLOWED = (
    "numbers, arguments and variables that are float; if, while, for ... in range(); "
    f"+ - * / // % **, comparisons, and, or, not; {', '.join(BUILTINS)}; numbers and functions of "
    f"this file; `from math import` of {', '.join(sorted([*MATH, *MATH_NUMBERS]))}"
)
#: As the translator says where it stopped.
_REFUSED = re.compile(r"kernel(?: function \w+)?, line (\d+): (.*?)(?:: )?not in the subset .*")


def check_translatable(effect: Effect, file: Path, text: str) -> None:
    """That the kernel can call all terms of an effect in every way it runs; else PluginError.

    text : of the file. The translator itself has the last word, on the file's own lines.
    """
    tree = ast.parse(text)
    defined = {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}
    numbers = set(named_numbers(tree))
    imported = set(_imported(tree, file))
    wanted = [_name(function, defined, file) for function in _called_by_kernel(effect)]
    wanted = list(dict.fromkeys(wanted))
    for name in wanted:  # grows as it goes
        for node in names_in(defined[name]):
            if node.id in defined:
                wanted += [] if node.id in wanted else [node.id]
            elif node.id not in {*numbers, *imported, *NAMES}:
                _refuse(file, node, f"{name} uses `{node.id}`")
    for name in wanted:
        _check_signature(defined[name], file)
    kept: list[ast.stmt] = [defined[name] for name in wanted]
    kept += [node for node in tree.body if _is_kept(node, numbers)]
    try:
        c_source(_only(text, kept))
    except ValueError as error:
        _translate(error, file)


def _called_by_kernel(effect: Effect) -> list[Callable[..., float]]:
    return [*functions_in_kernel(effect), *effect.derived, *packed_terms(effect)]


def _refuse(file: Path, node: ast.AST, what: str) -> NoReturn:
    raise PluginError(
        f"{file}, line {getattr(node, 'lineno', 1)}: {what}, which the kernel cannot have; allowed "
        f"in a term: {ALLOWED}"
    )


def _translate(error: ValueError, file: Path) -> NoReturn:
    """The translator's words, in those of whoever wrote the file."""
    said = _REFUSED.fullmatch(" ".join(str(error).split()))
    if said is None:
        raise PluginError(f"{file}: {error}") from None
    _refuse(file, ast.Pass(lineno=int(said[1])), said[2])


def _name(function: Callable[..., float], defined: dict[str, Any], file: Path) -> str:
    name = getattr(function, "__name__", "")
    if name not in defined:
        raise PluginError(f"{file}: {name or function!r} is no function at the top of this file")
    return name


def _check_signature(node: ast.FunctionDef, file: Path) -> None:
    if node.args.vararg or node.args.kwarg or node.args.kwonlyargs or node.args.defaults:
        _refuse(file, node, f"{node.name} has arguments with defaults, * or **")
    for part in (*node.args.args, None):
        spelled = node.returns if part is None else part.annotation
        if spelled is None or ast.unparse(spelled) != "float":
            what = f"what {node.name} returns" if part is None else f"{part.arg} of {node.name}"
            _refuse(file, part or node, f"{what} is not declared as float")


def _imported(tree: ast.Module, file: Path) -> Iterator[str]:
    for node in tree.body:
        if isinstance(node, ast.ImportFrom) and node.module == "math":
            for alias in node.names:
                if alias.asname:
                    _refuse(file, node, f"{alias.name} of math has another name here")
                yield alias.name


def _is_kept(node: ast.stmt, numbers: set[str]) -> bool:
    """Whether a statement belongs to what is translated: a number, what is of `math`."""
    if isinstance(node, ast.ImportFrom):
        return node.module == "math"
    return (
        isinstance(node, ast.Assign)
        and isinstance(node.targets[0], ast.Name)
        and node.targets[0].id in numbers
    )


def _only(text: str, nodes: list[Any]) -> str:
    """The text with these statements alone, each at its line."""
    lines = text.splitlines()
    kept = [""] * len(lines)
    for node in nodes:
        first = min([node.lineno, *(each.lineno for each in getattr(node, "decorator_list", []))])
        kept[first - 1 : node.end_lineno] = lines[first - 1 : node.end_lineno]
    return "\n".join(kept) + "\n"
