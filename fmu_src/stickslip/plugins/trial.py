"""The terms of a file, tried at the size that it shows: numbers, and none that drives the motion.

A term that gives no number makes every comparison in the kernel false: the block sticks for ever,
and nobody is told. So each is called here before it becomes part of one.
"""

import inspect
import math
import sys
from collections.abc import Mapping, Sequence
from itertools import product
from pathlib import Path
from types import FrameType
from typing import Any

from ..effects.effect import Effect, Term
from ..generation.places import PACKED, PLACES, TRIED, Place
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
