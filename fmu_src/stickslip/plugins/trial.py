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
from ..generation.places import CONSTANTS, PACKED, PLACES, WORDS, Place
from .errors import PluginError

#: At which a word is tried, in SI units, degC: from rest to faster than any rig.
TRIED: dict[str, Sequence[float]] = {
    "speed": (0.0, 1e-6, 1e-3, 0.03, 0.3, 3.0),
    "hold": (0.0, 1e-3, 1.0, 1e3),
    "temperature": (-40.0, -8.0, 0.0),
    "place": (-0.1, 0.0, 1.0),
    "travel": (0.0, 0.1, 10.0),
    "slid": (0.0, 0.1, 10.0),
    "film_thickness": (0.0, 1e-6, 1e-4),
    "mu": (0.05, 0.3),
    "flooded": (0.0, 0.5, 1.0),
    "extension": (-0.01, 0.0, 0.05),
    "time": (0.0, 0.1, 10.0),
    "steady_speed": (-0.15, 0.0, 0.15),
    "steady_acceleration": (0.0, 0.015),
    "mass": (0.67,),
    "normal_force": (6.57,),
    "radius": (0.04,),
    "stiffness": (20.17,),
    "mu_s": (0.28,),
    "mu_k": (0.21,),
}
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
        if not all(name in size or _is_word(name) for name in names):
            continue
        for values in product(*(_tried(name, size) for name in names)):
            _try(term, dict(zip(names, values, strict=True)), places[term.__name__], file)


def _is_word(name: str) -> bool:
    return name in TRIED and (name in {**WORDS, **CONSTANTS} or _is_local(name))


def _is_local(name: str) -> bool:
    return any(name in place.local for place in PLACES)


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
