"""Trees of numbers with units, split into values and a map of units."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple


class Quantity(NamedTuple):
    """A number, or None where there is none, and its unit."""

    value: float | int | None
    unit: str


def split_units(tree: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, str]]:
    """Values with None for what is not finite, and ``path.to.key`` -> unit."""
    values: dict[str, Any] = {}
    units: dict[str, str] = {}
    for key, node in tree.items():
        if isinstance(node, Quantity):
            values[key], units[key] = finite(node.value), node.unit
        elif isinstance(node, Mapping):
            values[key], inner = split_units(node)
            units |= {f"{key}.{path}": unit for path, unit in inner.items()}
        else:
            values[key] = node
    return values, units


def finite(value: float | int | None) -> float | int | None:
    """A plain number, None for NaN and infinities."""
    if value is None or not math.isfinite(value):
        return None
    return value if isinstance(value, int) else float(value)


def ratio(part: float, whole: float) -> float | None:
    """part / whole; None where the whole is zero."""
    return part / whole if whole else None
