"""The combinations of a sweep: every value of each axis with every value of the others."""

from __future__ import annotations

import warnings
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from math import prod
from typing import Any

from pydantic import ValidationError
from stickslip import Parameters

from cosim.scenario.faults import describe_faults

from .axis import Axis, axis
from .combination import Run, content_key, with_changes
from .errors import SweepError

#: More combinations than this are a slip of the product: hours of checking before the first run.
MOST = 1_000_000

Settings = Mapping[str, Any]


def merged(settings: Sequence[Settings]) -> dict[str, Any]:
    """The settings of one value from each axis, taken together."""
    return {key: value for setting in settings for key, value in setting.items()}


@dataclass(frozen=True)
class Grid:
    """Combinations of ``axes`` around ``base``, the last axis running fastest.

    combine: makes the changes of a combination (`block.key` -> value) out of one setting from
    each axis.
    """

    base: Parameters
    axes: tuple[Axis, ...]
    combine: Callable[[Sequence[Settings]], dict[str, Any]] = merged

    def __post_init__(self) -> None:
        if not self.axes:
            raise SweepError("nothing is varied, allowed is at least one key with its values")
        keys = Counter(key for each in self.axes for key in {*each.coordinates, each.name})
        for key, count in keys.items():
            if count > 1:
                raise SweepError(f"{key}: varied twice, allowed is once")
        if len(self) > MOST:
            raise SweepError(f"{len(self)} combinations, allowed are at most {MOST}")

    def __len__(self) -> int:
        return prod(self.shape)

    @property
    def shape(self) -> tuple[int, ...]:
        return tuple(len(each) for each in self.axes)

    @property
    def dims(self) -> tuple[str, ...]:
        return tuple(each.name for each in self.axes)

    @cached_property
    def changes(self) -> list[dict[str, Any]]:
        """`block.key` -> value, for every combination in order."""
        return [self.combine(each) for each in product(*(each.settings for each in self.axes))]

    def keys(self, run: Run) -> list[str]:
        """The content key of every combination; SweepError, in one line, for one that cannot be."""
        keys: list[str] = []
        warned: Counter[str] = Counter()
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", UserWarning)
            for changes in self.changes:
                keys.append(content_key(self._parameters(changes), run))
                warned.update({str(entry.message) for entry in caught})
                caught.clear()
        _warn_once(warned)
        return keys

    def _parameters(self, changes: Settings) -> Parameters:
        try:
            return with_changes(self.base, changes)
        except ValidationError as report:
            fault = describe_faults(report, Parameters)
            if any(fault.startswith(f"{key}: ") for key in changes):
                raise SweepError(fault) from None
            where = ", ".join(f"{key} = {value}" for key, value in changes.items())
            raise SweepError(f"{where}: {fault}") from None


def product_grid(parameters: Parameters, vary: Mapping[Any, Sequence[Any]]) -> Grid:
    """The product of the varied keys; `axis` says how keys and values are given."""
    return Grid(mechanics_of(parameters), tuple(axis(*entry) for entry in vary.items()))


def mechanics_of(parameters: Parameters) -> Parameters:
    """The mechanical part of a scenario, which is a Parameters and more."""
    blocks = {name: getattr(parameters, name) for name in Parameters.model_fields}
    return Parameters.model_construct(**blocks)


def _warn_once(warned: Counter[str]) -> None:
    """One warning for all combinations, whose texts differ by their numbers only."""
    for text in _first(warned):
        others = len(warned) - 1
        also = f" (and {others} like it in other combinations)" if others else ""
        warnings.warn(text + also, stacklevel=3)


def _first(warned: Counter[str]) -> Iterator[str]:
    yield from list(warned)[:1]
