"""Numbers of two results side by side, and the keys in which their scenarios differ."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

from .one_result import OneResult

#: What a summary has beside the numbers of the run itself, and how it was computed.
NOT_NUMBERS = (
    *("units", "versions", "parameters", "name", "case", "status", "reason", "created"),
    *("scenario", "events", "wall_time", "rows", "coupling", "participants", "connections"),
)
#: Part by which two numbers differ that are the same to rounding.
SAME = 1e-9
#: Residual of a ledger, J or a part of it, below which it is nothing.
ROUNDING = 1e-9


class Difference(NamedTuple):
    """One number of both runs, None where one has it not.

    difference: b - a; relative: to a, None where that is 0.
    """

    name: str
    unit: str
    a: float | None
    b: float | None

    @property
    def difference(self) -> float | None:
        return None if self.a is None or self.b is None else self.b - self.a

    @property
    def relative(self) -> float | None:
        if self.a is None or self.difference is None or self.a == 0.0:
            return None
        return self.difference / abs(self.a)

    @property
    def same(self) -> bool:
        """Whether both have it, and the same to rounding; a residual is all rounding."""
        if self.a is None or self.b is None:
            return self.a is self.b
        if self.name.endswith("residual") and max(abs(self.a), abs(self.b)) < ROUNDING:
            return True
        return math.isclose(self.a, self.b, rel_tol=SAME)


@dataclass(frozen=True)
class Comparison:
    """Two results.

    Attributes
    ----------
    a, b : the results, with labels that tell them apart
    numbers : `group.key` of the summary, in its order
    keys : of the scenarios, where they differ -> both values, None where one does not have it
    """

    a: OneResult
    b: OneResult
    numbers: tuple[Difference, ...]
    keys: Mapping[str, tuple[Any, Any]]

    @property
    def different(self) -> list[Difference]:
        """Numbers that are not the same."""
        return [one for one in self.numbers if not one.same]

    @property
    def remarks(self) -> list[str]:
        """What is to be known before the numbers are believed."""
        said = [*self.a.remarks, *self.b.remarks]
        cases = [str(one.numbers["case"]) for one in (self.a, self.b) if "case" in one.numbers]
        if len(set(cases)) > 1:
            said.append(
                f"one is of {cases[0]}, the other of {cases[1]}: not all numbers are in both"
            )
        ends = [float(one.dataset["time"][-1]) for one in (self.a, self.b)]
        if not math.isclose(*ends, rel_tol=SAME):
            said.append(
                f"one run is {ends[0]:g} s long, the other {ends[1]:g} s: totals are of each run's"
                " own time"
            )
        return said

    def as_dict(self) -> dict[str, Any]:
        """Everything but the time series, for JSON."""
        return {
            "a": {"name": self.a.label, "place": self.a.place},
            "b": {"name": self.b.label, "place": self.b.place},
            "remarks": self.remarks,
            "scenario": {key: {"a": a, "b": b} for key, (a, b) in self.keys.items()},
            "numbers": {
                one.name: {
                    "unit": one.unit,
                    "a": one.a,
                    "b": one.b,
                    "difference": one.difference,
                    "relative": one.relative,
                }
                for one in self.numbers
            },
        }


def compare(a: OneResult, b: OneResult) -> Comparison:
    """Two results beside each other, whatever they are of.

    Their numbers are those of `summary.json`, in SI units; what only one has is None in the other.
    """
    if a.label == b.label:
        a, b = replace(a, label=f"{a.label} (A)"), replace(b, label=f"{b.label} (B)")
    left, right = dict(_flat(a.numbers)), dict(_flat(b.numbers))
    units = {**b.numbers.get("units", {}), **a.numbers.get("units", {})}
    names = [*left, *(name for name in right if name not in left)]
    numbers = tuple(
        Difference(name, units.get(name, ""), left.get(name), right.get(name)) for name in names
    )
    return Comparison(a, b, numbers, _differing(a, b))


def _flat(tree: Mapping[str, Any], path: str = "") -> Iterator[tuple[str, float]]:
    for key, value in tree.items():
        if not path and key in NOT_NUMBERS:
            continue
        if isinstance(value, Mapping):
            yield from _flat(value, f"{path}{key}.")
        elif isinstance(value, (int, float)) and not isinstance(value, bool):
            yield f"{path}{key}", value


def _differing(a: OneResult, b: OneResult) -> dict[str, tuple[Any, Any]]:
    left, right = a.tables, b.tables
    keys = [*left, *(key for key in right if key not in left)]
    return {key: (left.get(key), right.get(key)) for key in keys if left.get(key) != right.get(key)}
