"""Numbers and time series of two results side by side, and where their scenarios differ.

A run names its series by the port (`x`), a system by unit and port (`mechanics.x`): the same name
is the same quantity, and so is the same port where either has but one of it.
"""

import math
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from operator import itemgetter
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from stickslip.units import UNITS

from cosim.report.columns import Array
from cosim.result import RunResult

from ...coupling.conversion import BASE_UNITS, between, told_dimension
from ...coupling.participant import UnitDefinition
from ..page import PageResult
from ..quantities import ROUNDING, TABLES
from .one_result import OneResult, as_result

#: What is no quantity of its own: a system's inputs repeat outputs.
INPUT = "input"
#: Attributes of a variable: its unit by base units, value in them = factor * value + offset.
BASE, FACTOR, OFFSET = "base_units", "si_factor", "si_offset"


PICKS: dict[str, Callable[[Array], Any]] = {
    **{"start": itemgetter(0), "end": itemgetter(-1)},
    **{"lowest": np.min, "highest": np.max},
}


class Series(NamedTuple):
    """A quantity that both results have: names, A's unit, and B's values into it."""

    name: str
    other: str
    unit: str
    factor: float = 1.0
    offset: float = 0.0

    def of_a(self, dataset: xr.Dataset) -> Array:
        """A's values, (n,) in `unit`."""
        return np.asarray(dataset[self.name].values, float)

    def of_b(self, dataset: xr.Dataset) -> Array:
        """B's values, (m,) in `unit`."""
        return self.factor * np.asarray(dataset[self.other].values, float) + self.offset


class Apart(NamedTuple):
    """How far two curves are apart where both runs are, by the rows of the one with fewer.

    largest: with its sign, B less A, at the time ``at`` (s). rms: root of the mean square. span:
    of A in that time, which both are judged by. size: its largest value. All in ``unit``.
    """

    name: str
    unit: str
    largest: float
    at: float
    rms: float
    span: float
    size: float


def matched(a: xr.Dataset, b: xr.Dataset) -> tuple[list[Series], list[str]]:
    """What both have, and a line for each of the same name that is not the same quantity."""
    left, right = _quantities(a), _quantities(b)
    couples = [(name, name) for name in left if name in right]
    rest = [{name for name in one if name not in dict(couples)} for one in (left, right)]
    ports = [_single_ports(names) for names in rest]
    couples += [(ports[0][port], ports[1][port]) for port in ports[0] if port in ports[1]]
    found, refused = [], []
    for name, other in sorted(couples, key=lambda couple: left.index(couple[0])):
        units = [str(one[each].attrs.get("units", "1")) for one, each in ((a, name), (b, other))]
        affine = _into(b[other].attrs, a[name].attrs)
        if affine is None:
            refused.append(f"{name} is in {units[0]}, {other} in {units[1]}: not compared")
        else:
            found.append(Series(name, other, units[0], *affine))
    return found, refused


def apart(series: Series, a: xr.Dataset, b: xr.Dataset) -> Apart | None:
    """Of curves that both have for some time and that are no counts or modes; else None."""
    if np.issubdtype(a[series.name].dtype, np.integer):
        return None
    times = [np.asarray(one["time"].values, float) for one in (a, b)]
    begin, end = max(one[0] for one in times), min(one[-1] for one in times)
    coarse = min(times, key=lambda one: int(np.sum((one >= begin) & (one <= end))))
    at = coarse[(coarse >= begin) & (coarse <= end)]
    if at.size == 0:
        return None
    ours = np.interp(at, times[0], series.of_a(a))
    off = np.interp(at, times[1], series.of_b(b)) - ours
    if not np.all(np.isfinite(off)):
        return None
    most = int(np.argmax(np.abs(off)))
    rms = math.sqrt(float(np.mean(off**2)))
    largest, size = float(off[most]), float(np.max(np.abs(ours)))
    return Apart(series.name, series.unit, largest, float(at[most]), rms, float(np.ptp(ours)), size)


def ends(series: Series, a: xr.Dataset, b: xr.Dataset) -> dict[str, tuple[float, float]]:
    """start, end, lowest, highest -> those of A and of B, in A's unit."""
    values = (series.of_a(a), series.of_b(b))
    return {key: (float(pick(values[0])), float(pick(values[1]))) for key, pick in PICKS.items()}


def _quantities(dataset: xr.Dataset) -> list[str]:
    return [
        str(name)
        for name, series in dataset.data_vars.items()
        if series.dims == ("time",) and series.attrs.get("causality") != INPUT
    ]


def _single_ports(names: Iterable[str]) -> dict[str, str]:
    """Port -> the one quantity of that name; ports of several units are none of them."""
    ports = {name: name.rpartition(".")[2] for name in sorted(names)}
    counts = Counter(ports.values())
    return {port: name for name, port in ports.items() if counts[port] == 1}


def _into(source: Mapping[str, Any], sink: Mapping[str, Any]) -> tuple[float, float] | None:
    """Factor and offset from one variable's unit to the other's; None: another kind of unit."""
    (kind, start), (other, end) = _definition(source), _definition(sink)
    if kind != other or not end.factor:
        return None
    found = between(start, end)
    return found.factor, found.offset


def _definition(attributes: Mapping[str, Any]) -> tuple[str, UnitDefinition]:
    """What a unit is of, in base units, and its factor and offset: as the variable states them, of
    a unit that is ours, or else by its name.
    """
    unit = str(attributes.get("units", "1"))
    if BASE in attributes:
        kind, size = str(attributes[BASE]), (attributes[FACTOR], attributes[OFFSET])
    elif (known := UNITS.get(unit)) is not None:
        kind = told_dimension([int(known.get(base, 0)) for base in BASE_UNITS])
        size = known.get("factor", 1.0), known.get("offset", 0.0)
    else:
        kind, size = unit, (1.0, 0.0)
    return kind, UnitDefinition((0,) * 8, *map(float, size))


#: What a summary has beside the numbers of the run itself, and how it was computed.
NOT_NUMBERS = (
    "units", "versions", "parameters", "name", "case", "status", "reason", "created",
    "scenario", "events", "wall_time", "rows", "coupling", "participants", "connections",
    "outputs", "system", "source",
)  # fmt: skip
#: Part by which two numbers differ that are the same to rounding.
SAME = 1e-9
#: Residual of a ledger, J or a part of it, below which it is nothing.
RESIDUAL = 1e-9
RESIDUALS = ("residual", "largest_difference", "relative_difference")
#: Units whose zero is a convention: what is a part of such a value says nothing.
NO_PARTS = ("degC",)
SYSTEM = "system"
REMARKS: dict[str, str] = TABLES["compare"]["remarks"]
CASES = {SYSTEM: "any system", "coupled": "a coupled run", "mechanics": "the mechanics alone"}
#: Outputs of a system's summary: they are compared as series, in one unit.
OUTPUTS = "outputs"
#: Part of a curve's size that is its rounding.
PART_OF_SIZE = 1e-12
#: Part by which the rows of two runs may be apart in time and be as dense all the same.
AS_DENSE = 0.01


class Difference(NamedTuple):
    """One number of both runs, None where one has it not.

    difference: b - a; relative: to a, None where that is nothing beside rounding, or in degC.
    size: of what it is taken from, such as a curve's largest value; 0 where it stands alone.
    """

    name: str
    unit: str
    a: float | None
    b: float | None
    size: float = 0.0

    @property
    def difference(self) -> float | None:
        return None if self.a is None or self.b is None else self.b - self.a

    @property
    def relative(self) -> float | None:
        if self.a is None or self.difference is None or self.unit in NO_PARTS:
            return None
        # beside the other it is nothing: a part of it would be one of a rounding error
        nothing = self._is_nothing(self.a) or abs(self.a) < SAME * abs(self.difference)
        return None if nothing else self.difference / abs(self.a)

    def _is_nothing(self, value: float) -> bool:
        return value == 0.0 or abs(value) < _rounding(self.unit, self.size)

    @property
    def in_both(self) -> bool:
        return self.a is not None and self.b is not None

    @property
    def same(self) -> bool:
        """Whether both have it, and the same to rounding; a residual is all rounding."""
        if self.a is None or self.b is None:
            return self.a is self.b
        if self._is_nothing(self.a) and self._is_nothing(self.b):
            return True
        if _is_residual(self.name) and max(abs(self.a), abs(self.b)) < RESIDUAL:
            return True
        return math.isclose(self.a, self.b, rel_tol=SAME, abs_tol=PART_OF_SIZE * self.size)


def _rounding(unit: str, size: float) -> float:
    """Below this a number in a unit is nothing, beside the size of what it is of."""
    return max(ROUNDING.get(unit, 0.0), PART_OF_SIZE * size)


def _is_residual(name: str) -> bool:
    return any(part.endswith(RESIDUALS) for part in name.split("."))


@dataclass(frozen=True)
class Comparison(PageResult):
    """Two results beside each other.

    Attributes
    ----------
    a, b : the results, with labels that tell them apart
    numbers : `group.key` of the summary, in its order
    keys : of the scenarios, or of the systems, where they differ -> both values, None where one
        does not have it; none for a scenario beside a system
    series : what both have over time, in one unit
    not_compared : what has one name and is not one quantity, a line each
    """

    SHOWN_BY = f"{__package__}.page"

    a: OneResult
    b: OneResult
    numbers: tuple[Difference, ...]
    keys: Mapping[str, tuple[Any, Any]]
    series: tuple[Series, ...] = ()
    not_compared: tuple[str, ...] = ()

    @property
    def different(self) -> list[Difference]:
        """Numbers that both have, and that are not the same."""
        return [one for one in self.numbers if one.in_both and not one.same]

    @property
    def of_one(self) -> list[Difference]:
        """Numbers that only one of them has."""
        return [one for one in self.numbers if (one.a is None) is not (one.b is None)]

    @cached_property
    def apart(self) -> list[Apart]:
        """Of each curve that both have, how far they are apart over the time of both."""
        found = (apart(each, self.a.dataset, self.b.dataset) for each in self.series)
        return [*filter(None, found)]

    @property
    def curves(self) -> list[Apart]:
        """Of these, what is apart by more than rounding."""
        return [
            one
            for one in self.apart
            if not _is_residual(one.name)
            and abs(one.largest) > max(_rounding(one.unit, one.size), SAME * one.span)
        ]

    @property
    def remarks(self) -> list[str]:
        """What is to be known before the numbers are believed."""
        said = [*self.a.remarks, *self.b.remarks]
        both = (self.a, self.b)
        cases = [str(one.numbers["case"]) for one in both if "case" in one.numbers]
        if len(set(cases)) > 1:
            said.append(REMARKS["cases"].format(*(CASES.get(case, case) for case in cases)))
        ends = [float(one.dataset["time"][-1]) for one in both]
        if not math.isclose(*ends, rel_tol=SAME):
            said.append(REMARKS["ends"].format(*ends))
        steps = [one.output_step for one in both]
        if all(steps) and not math.isclose(*steps, rel_tol=AS_DENSE):
            said.append(REMARKS["steps"].format(*steps))
        return [*said, *self.not_compared]

    def summary(self) -> dict[str, Any]:
        """What `compare.json` holds: everything but the time series."""
        return {
            "a": {"name": self.a.label, "place": self.a.place},
            "b": {"name": self.b.label, "place": self.b.place},
            "remarks": self.remarks,
            "scenario": {key: {"a": a, "b": b} for key, (a, b) in self.keys.items()},
            "numbers": _table(self.numbers, ("unit", "a", "b", "difference", "relative")),
            "curves": _table(self.apart, ("unit", "largest", "at", "rms", "span")),
        }


def _table(ones: Iterable[Difference | Apart], keys: Sequence[str]) -> dict[str, dict[str, Any]]:
    return {one.name: {key: getattr(one, key) for key in keys} for one in ones}


def compare(
    a: OneResult | RunResult | str | Path, b: OneResult | RunResult | str | Path
) -> Comparison:
    """Two results beside each other, whatever they are of: runs, folders, or `read_result` of one.

    Their numbers are those of `summary.json`, in SI units; what only one has is None in the other.
    Outputs of a system are compared with what the other has of the same name, and in A's unit.

    >>> from cosim import compare, read_scenario, simulate_scenario
    >>> short = read_scenario().changed(run_duration=2.0)
    >>> light, heavy = (simulate_scenario(short.changed(rig_mass=mass)) for mass in (0.67, 1.0))
    >>> both = compare(light, heavy.save("results/heavy"))
    >>> list(both.keys), both.save("results/two-masses").name
    (['rig.mass'], 'two-masses')
    """
    a, b = as_result(a), as_result(b)
    if a.label == b.label:
        a, b = replace(a, label=f"{a.label} (A)"), replace(b, label=f"{b.label} (B)")
    units = {**b.numbers.get("units", {}), **a.numbers.get("units", {}), "time_reached": "s"}
    series, refused = matched(a.dataset, b.dataset)
    numbers = [
        Difference(name, units.get(name, ""), *values)
        for name, values in _both(dict(_flat(a.numbers)), dict(_flat(b.numbers))).items()
    ]
    if SYSTEM in (a.numbers.get("case"), b.numbers.get("case")):
        numbers += _outputs(a, b, series)
    return Comparison(a, b, tuple(numbers), _differing(a, b), tuple(series), tuple(refused))


def _outputs(a: OneResult, b: OneResult, series: Iterable[Series]) -> Iterator[Difference]:
    """Where the outputs of both begin, end and go to."""
    for each in series:
        found = ends(each, a.dataset, b.dataset)
        size = max(abs(value) for values in found.values() for value in values)
        for key, values in found.items():
            yield Difference(f"{OUTPUTS}.{each.name}.{key}", each.unit, *values, size)


def _flat(tree: Mapping[str, Any], path: str = "") -> Iterator[tuple[str, float]]:
    for key, value in tree.items():
        if not path and key in NOT_NUMBERS:
            continue
        if isinstance(value, Mapping):
            yield from _flat(value, f"{path}{key}.")
        elif isinstance(value, (int, float)) and not isinstance(value, bool):
            yield f"{path}{key}", value


def _differing(a: OneResult, b: OneResult) -> dict[str, tuple[Any, Any]]:
    if bool(a.scenario) is not bool(b.scenario):
        return {}
    keys = _both(a.tables, b.tables)
    return {key: (left, right) for key, (left, right) in keys.items() if left != right}


def _both(left: Mapping[str, Any], right: Mapping[str, Any]) -> dict[str, tuple[Any, Any]]:
    """What either has, A's first, with the values of both; None where one has it not."""
    return {key: (left.get(key), right.get(key)) for key in {**left, **right}}
