"""The functions of an effect's file as text that stands by itself: prefixed, constants put in."""

from __future__ import annotations

import ast
import inspect
import sys
from collections.abc import Callable, Iterable
from functools import cached_property

from ..effects.effect import Effect


class EffectFunctions:
    """What an effect's file defines, by name.

    Each function becomes ``<id>_<name>``, together with the functions of the file that it calls;
    numbers that the file names are put in. Raises ValueError for a function that takes anything
    else from its file.
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

    def text(self, functions: Iterable[Callable[..., object]]) -> tuple[str, set[tuple[str, str]]]:
        """The functions with those that they call, in the file's order; and (module, name) of what
        they import."""
        wanted, imports = [function.__name__ for function in functions], set()
        for name in wanted:  # grows as it goes
            for used in self._names_in(self._defined[name]):
                if used in self._defined and used not in wanted:
                    wanted.append(used)
                elif used in self._imported:
                    imports.add((self._imported[used], used))
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
