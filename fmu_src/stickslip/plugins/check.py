"""Whether the terms of a file can become C, and if not, at which of its lines.

They are then tried at the size that the file shows: numbers, and none that drives the motion. A
term that gives no number makes every comparison in the kernel false: the block sticks for ever, and
nobody is told. So each is called here before it becomes part of one.
"""

import ast
import inspect
import math
import re
import sys
from collections.abc import Mapping, Sequence
from functools import cached_property
from itertools import product
from pathlib import Path
from types import FrameType
from typing import Any, NoReturn

from ..effects.effect import Effect, Term
from ..generation.c import c_source
from ..generation.c_program import BUILTINS, MATH, MATH_NUMBERS
from ..generation.functions import EffectFunctions, named_numbers
from ..generation.places import PACKED, PLACES, TRIED, Place
from ..generation.slots import functions_in_kernel, packed_terms
from .errors import PluginError

#: Lines that a term may take; it is called some thousand times a second of motion.
LINES = 200_000


class Endless(RuntimeError):
    """A term that did not come to its end."""


def try_terms(effect: Effect, file: Path) -> None:
    """Call each term at the effect's case; PluginError for one that is no number there.

    Terms that take a sum, a state or a derived number are not tried: what those are, only a run
    knows.
    """
    size: Mapping[str, Any] = effect.table.model_validate(dict(effect.case.effect)).model_dump()
    places = {place.name: place for place in (*PLACES, *PACKED)}
    for term in effect.terms:
        names = list(inspect.signature(term).parameters)
        if not all(name in size or name in TRIED for name in names):
            continue
        for values in product(*(_tried(name, size) for name in names)):
            _try(term, dict(zip(names, values, strict=True)), places[term.__name__], file)


def _tried(name: str, size: Mapping[str, Any]) -> Sequence[float]:
    return (float(size[name]),) if name in size else TRIED[name]


def _try(term: Term, at: Mapping[str, float], place: Place, file: Path) -> None:
    line = term.__code__.co_firstlineno
    where = f"{file}, line {line}: {term.__name__}"
    given = ", ".join(f"{name} = {value:g}" for name, value in at.items())
    try:
        value = _ended(term, at)
    except (ArithmeticError, ValueError, RecursionError, Endless) as error:
        raise PluginError(
            f"{where} at {given}: {' '.join(str(error).split())}; allowed is a term that is a "
            "number at every speed from 0 on, and at whatever else it takes"
        ) from None
    if not isinstance(value, int | float) or not math.isfinite(value):
        raise PluginError(f"{where} is {value} at {given}; allowed is a finite number")
    if value < 0.0 and (place.joins == "multiply" or place.so_far == "mu"):
        raise PluginError(
            f"{where} is {value:g} at {given}: friction would drive the block; allowed is at least "
            "0, as max(0.0, ...) of it is"
        )


def _ended(term: Term, at: Mapping[str, float]) -> float:
    """What a term gives; Endless where it takes more than `LINES` lines."""
    left = LINES

    def count(frame: FrameType, event: str, argument: Any) -> Any:
        nonlocal left
        left -= 1
        if left < 0:
            raise Endless(f"no end after {LINES} lines")
        return count

    watching = sys.gettrace()
    if watching is not None:  # a debugger, or coverage: theirs is the only place there is
        return term(**at)
    sys.settrace(count)
    try:
        return term(**at)
    finally:
        sys.settrace(watching)


ALLOWED = (
    "numbers, arguments and variables that are float; if, while, for ... in range(); "
    f"+ - * / // % **, comparisons, and, or, not; {', '.join(BUILTINS)}; numbers and functions of "
    f"this file; `from math import` of {', '.join(sorted([*MATH, *MATH_NUMBERS]))}"
)
#: As the translator says where it stopped.
_REFUSED = re.compile(r"kernel(?: function \w+)?, line (\d+): (.*?)(?:: )?not in the subset .*")


class _OfFile(EffectFunctions):
    """Functions of a file from outside, whose faults are said with their lines."""

    def __init__(self, effect: Effect, file: Path, text: str) -> None:
        super().__init__(effect)
        self._path, self._text = file, text

    @cached_property
    def _file(self) -> ast.Module:
        """It alone."""
        return ast.parse(self._text)

    def refuse(self, node: ast.AST | None, what: str) -> NoReturn:
        """PluginError."""
        if node is None:
            raise PluginError(f"{self._path}: {what} at the top of this file")
        _refuse(self._path, node, what)


def check_translatable(effect: Effect, file: Path, text: str) -> None:
    """That the kernel can call all terms of an effect in every way it runs; else PluginError.

    text : of the file. The translator itself has the last word, on the file's own lines.
    """
    called = [*functions_in_kernel(effect), *effect.derived, *packed_terms(effect)]
    wanted = _OfFile(effect, file, text).wanted(called)
    for function in wanted.values():
        _check_signature(function, file)
    tree = ast.parse(text)
    numbers = named_numbers(tree)
    kept = [node for node in tree.body if _is_kept(node, {*numbers})]
    try:
        c_source(_only(text, [*wanted.values(), *kept]))
    except ValueError as error:
        _translate(error, file)


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


def _check_signature(node: ast.FunctionDef, file: Path) -> None:
    if node.args.vararg or node.args.kwarg or node.args.kwonlyargs or node.args.defaults:
        _refuse(file, node, f"{node.name} has arguments with defaults, * or **")
    for part in (*node.args.args, None):
        spelled = node.returns if part is None else part.annotation
        if spelled is None or ast.unparse(spelled) != "float":
            what = f"what {node.name} returns" if part is None else f"{part.arg} of {node.name}"
            _refuse(file, part or node, f"{what} is not declared as float")


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
