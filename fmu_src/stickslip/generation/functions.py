"""The functions of an effect's file as text that stands by itself: prefixed, constants put in."""

from __future__ import annotations

import ast
import builtins
import inspect
import linecache
import sys
from collections.abc import Callable, Collection, Iterable
from functools import cached_property
from typing import Any, NamedTuple

from ..effects.effect import Effect


class Vocabulary(NamedTuple):
    """What functions may use that is not of their file: names, and names imported from modules.

    said: the same in words, for whoever used another.
    """

    names: Collection[str]
    modules: Collection[str]
    said: str


#: Of the text that is also compiled, by numba and as C.
IN_KERNEL = Vocabulary(
    ("abs", "bool", "float", "int", "max", "min", "range"), ("math",), '"from math import ..."'
)
#: Of the text that only Python runs, here and in an FMU.
WHEN_PACKED = Vocabulary(
    dir(builtins), sys.stdlib_module_names, '"from ... import ..." of the standard library'
)


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
        return ast.parse(inspect.getsource(sys.modules[self.effect.table.__module__]))

    @cached_property
    def _defined(self) -> dict[str, ast.FunctionDef]:
        return {node.name: node for node in self._file.body if isinstance(node, ast.FunctionDef)}

    @cached_property
    def _numbers(self) -> dict[str, float]:
        found = {}
        for node in self._file.body:
            if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
                try:
                    value = ast.literal_eval(node.value)
                except ValueError:
                    continue
                if isinstance(value, (int, float)):
                    found[node.targets[0].id] = value
        return found

    @cached_property
    def _imported(self) -> dict[str, str]:
        """Name -> module, of what comes from the standard library."""
        return {
            alias.name: node.module or ""
            for node in self._file.body
            if isinstance(node, ast.ImportFrom) and not node.level
            for alias in node.names
        }

    def name(self, function: Callable[..., object]) -> str:
        """By which the text calls a function."""
        return f"{self.effect.id}_{function.__name__}"

    def text(
        self, functions: Iterable[Callable[..., object]], vocabulary: Vocabulary
    ) -> tuple[str, set[tuple[str, str]]]:
        """The functions with those that they call, in the file's order; and (module, name) of what
        they import."""
        wanted, imports = [function.__name__ for function in functions], set()
        for name in wanted:  # grows as it goes
            if name not in self._defined:
                raise ValueError(f"effect {self.effect.id}: {name} is no function of its file")
            for used in self._names_in(self._defined[name]):
                if used in self._defined:
                    wanted += [] if used in wanted else [used]
                elif self._imported.get(used) in vocabulary.modules:
                    imports.add((self._imported[used], used))
                elif used not in self._numbers and used not in vocabulary.names:
                    raise ValueError(
                        f"effect {self.effect.id}: term {name} uses {used}: a term may use "
                        f"numbers, functions of its file and {vocabulary.said}"
                    )
        parts = [self._renamed(node) for name, node in self._defined.items() if name in wanted]
        return "\n\n\n".join(parts), imports

    def _names_in(self, function: ast.FunctionDef) -> list[str]:
        """Names of the file that a function uses; its own arguments and variables hide them."""
        own = {each.arg for each in function.args.args}
        inner = [node for part in function.body for node in ast.walk(part)]
        names = [node for node in inner if isinstance(node, ast.Name)]
        own |= {node.id for node in names if isinstance(node.ctx, ast.Store)}
        return list(dict.fromkeys(node.id for node in names if node.id not in own))

    def _renamed(self, function: ast.FunctionDef) -> str:
        used = set(self._names_in(function))
        calls = {name for name in used if name in self._defined}
        numbers = {name: self._numbers[name] for name in used if name in self._numbers}

        class Rename(ast.NodeTransformer):
            def visit_Name(inner, node: ast.Name) -> ast.expr:
                if node.id in calls:
                    return ast.Name(f"{self.effect.id}_{node.id}", node.ctx)
                if node.id in numbers:
                    return ast.Constant(numbers[node.id])
                return node

        copy = ast.parse(ast.unparse(function)).body[0]
        assert isinstance(copy, ast.FunctionDef)
        copy.body = [Rename().visit(part) for part in copy.body]
        copy.name = f"{self.effect.id}_{function.name}"
        return ast.unparse(ast.fix_missing_locations(copy))


def arguments(function: Callable[..., object]) -> list[str]:
    """Names by which a term takes its numbers."""
    return list(inspect.signature(function).parameters)


def imports_text(imports: set[tuple[str, str]]) -> str:
    """Import statements, one for each module."""
    modules = sorted({module for module, _ in imports})
    return "\n".join(
        f"from {module} import {', '.join(sorted(n for m, n in imports if m == module))}"
        for module in modules
    )


def define(text: str, name: str, namespace: dict[str, Any]) -> None:
    """Define what a made text defines; a traceback shows its lines under the name."""
    exec(compile(text, name, "exec"), namespace)
    linecache.cache[name] = (len(text), None, text.splitlines(keepends=True), name)
