"""The functions of an effect's file as text that stands by itself: prefixed, constants put in."""

import ast
import inspect
import linecache
import sys
from collections.abc import Callable, Iterable, Iterator
from copy import deepcopy
from functools import cache, cached_property
from typing import Any, NoReturn

from ..effects.effect import Effect

#: What a function may use that is not of its file: these names, and what it imports from `math`.
#: By which a module that is made of a text keeps it.
TEXT = "__text__"
NAMES = ("abs", "bool", "float", "int", "max", "min", "range")


def named_numbers(file: ast.Module) -> dict[str, float]:
    """Name -> number of what a file gives a name at its top, as it stands there."""
    found = {}
    for node in file.body:
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            try:
                value = ast.literal_eval(node.value)
            except ValueError:
                continue
            if isinstance(value, (int, float)):
                found[node.targets[0].id] = value
    return found


class EffectFunctions:
    """What an effect's file defines, by name.

    Each function becomes ``<id>_<name>``, together with the functions of the file that it calls;
    numbers that the file names are put in. Raises ValueError for a function that uses anything
    else.
    """

    def __init__(self, effect: Effect) -> None:
        self.effect = effect

    @cached_property
    def _file(self) -> ast.Module:
        """The effect's own, and behind it those that some of its functions come from."""
        functions = (*self.effect.terms, *self.effect.derived)
        files = [self.effect.table.__module__, *(each.__module__ for each in functions)]
        return ast.Module([node for file in dict.fromkeys(files) for node in _statements(file)], [])

    @cached_property
    def _defined(self) -> dict[str, ast.FunctionDef]:
        return {node.name: node for node in self._file.body if isinstance(node, ast.FunctionDef)}

    @cached_property
    def _numbers(self) -> dict[str, float]:
        return named_numbers(self._file)

    @cached_property
    def _imported(self) -> set[str]:
        """Names that come from `math`."""
        return {
            alias.name
            for node in self._file.body
            if isinstance(node, ast.ImportFrom) and node.module == "math" and not node.level
            for alias in node.names
        }

    def name(self, function: Callable[..., object]) -> str:
        """By which the text calls a function."""
        return f"{self.effect.id}_{function.__name__}"

    def wanted(self, functions: Iterable[Callable[..., object]]) -> dict[str, ast.FunctionDef]:
        """The functions with those that they call, which use nothing else than they may."""
        names = list(dict.fromkeys(getattr(each, "__name__", repr(each)) for each in functions))
        for name in names:  # grows as it goes
            if name not in self._defined:
                self.refuse(None, f"{name!r} is no function")
            for node in names_in(self._defined[name]):
                if node.id in self._defined:
                    names += [] if node.id in names else [node.id]
                elif node.id not in {*self._numbers, *self._imported, *NAMES}:
                    self.refuse(node, f"{name} uses `{node.id}`")
        return {name: self._defined[name] for name in names}

    def refuse(self, node: ast.AST | None, what: str) -> NoReturn:
        """A function uses what no text of a kernel has."""
        self.effect.refuse(
            f'{what}: a term may use numbers, functions of its file and "from math import ..."'
        )

    def text(self, functions: Iterable[Callable[..., object]]) -> tuple[str, set[str]]:
        """The functions with those that they call, in the file's order; and what of `math` they
        import."""
        wanted = self.wanted(functions)
        used = {node.id for function in wanted.values() for node in names_in(function)}
        parts = [self._renamed(node) for name, node in self._defined.items() if name in wanted]
        return "\n\n\n".join(parts), used & self._imported

    def _renamed(self, function: ast.FunctionDef) -> str:
        used = {node.id for node in names_in(function)}
        calls = {name for name in used if name in self._defined}
        numbers = {name: self._numbers[name] for name in used if name in self._numbers}

        class Rename(ast.NodeTransformer):
            def visit_Name(inner, node: ast.Name) -> ast.expr:
                if node.id in calls:
                    return ast.Name(f"{self.effect.id}_{node.id}", node.ctx)
                if node.id in numbers:
                    # not as a constant: a negative one is to bind like the number it is
                    return ast.parse(repr(numbers[node.id]), mode="eval").body
                return node

        renamed = deepcopy(function)
        renamed.body = [Rename().visit(part) for part in renamed.body]
        renamed.name = f"{self.effect.id}_{function.name}"
        return ast.unparse(ast.fix_missing_locations(renamed))


@cache
def _statements(module: str) -> list[ast.stmt]:
    # a custom effect's is the text that was executed, not what the file holds by now
    text = vars(sys.modules[module]).get(TEXT) or inspect.getsource(sys.modules[module])
    return ast.parse(text).body


def names_in(function: ast.FunctionDef) -> Iterator[ast.Name]:
    """Names of the file that a function uses; its own arguments and variables hide them."""
    own = {each.arg for each in function.args.args}
    inner = [node for part in function.body for node in ast.walk(part)]
    names = [node for node in inner if isinstance(node, ast.Name)]
    own |= {node.id for node in names if isinstance(node.ctx, ast.Store)}
    return (node for node in names if node.id not in own)


def arguments(function: Callable[..., object]) -> list[str]:
    """Names by which a term takes its numbers."""
    return list(_parameters(function))


@cache
def _parameters(function: Callable[..., object]) -> tuple[str, ...]:
    """A term is asked for them by every place that might call it."""
    return tuple(inspect.signature(function).parameters)


def define(text: str, name: str, namespace: dict[str, Any]) -> None:
    """Define what a made text defines; a traceback shows its lines under the name."""
    exec(compile(text, name, "exec"), namespace)
    linecache.cache[name] = (len(text), None, text.splitlines(keepends=True), name)
