"""Which time series of two results are the same quantity, in one unit, and how far they are apart.

A run names its series by the port (`x`), a system by unit and port (`mechanics.x`): the same name
is the same quantity, and so is the same port where either has but one of it.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from operator import itemgetter
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from stickslip.units import UNITS

from cosim.coupling.conversion import BASE_UNITS, between, told_dimension
from cosim.coupling.participant import UnitDefinition

Array = NDArray[np.float64]
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
