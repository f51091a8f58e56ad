"""What is varied: values of one key, or of several that go together; also as text, of `--vary`."""

from __future__ import annotations

import math
import re
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache
from typing import Any, get_args

import numpy as np
from pydantic.fields import FieldInfo
from stickslip import Parameters
from stickslip.quantity import details

from cosim.names import nearest_key
from cosim.scenario import Scenario
from cosim.scenario.validation import known_keys

LINK = "+"
#: In place of a key: a whole scenario.
SCENARIO = "scenario"
#: A key of one table of a list: the list's key, the table's number from 1, its own key.
LIST_ENTRY = re.compile(r"^(\w+\.\w+)\[(\d+)\]\.(\w+)$")
_LARGEST = 2**1023
#: Longest label of a value on an axis.
LONGEST_LABEL = 32


class SweepError(ValueError):
    """A sweep that cannot be started; one line: key, what is wrong, what is allowed."""


@cache
def keys_of(kind: type[Parameters]) -> dict[str, FieldInfo]:
    """`table.key` -> what it holds, of scenarios or of the mechanics alone."""
    return {key: entry for key, entry in known_keys(kind).items() if "." in key}


@dataclass(frozen=True)
class Axis:
    """One dimension of a sweep.

    Attributes
    ----------
    name : of the dimension
    settings : for each of its values, `block.key` -> value
    coordinates : name -> (values as a result file holds them, attributes with unit and long name)
    """

    name: str
    settings: tuple[Mapping[str, Any], ...]
    coordinates: Mapping[str, tuple[np.ndarray, dict[str, str]]] = field(repr=False)

    def __len__(self) -> int:
        return len(self.settings)


def axis(keys: str | Sequence[str], values: Sequence[Any], kind: type[Scenario] = Scenario) -> Axis:
    """The axis of one key, or of linked keys: a tuple of keys (or "a+b") and tuples of values.

    kind: of the scenario that has the keys.

    Raises SweepError, in one line, for a key that the mechanics does not have, for no values and
    for a value that is there twice. Bounds are checked with the whole combination.

    >>> len(axis("rig.mass", [0.67, 2.03]))
    2
    >>> axis(("friction.mu_s", "friction.mu_k"), [(0.28, 0.21), (0.065, 0.05)]).name
    'friction.mu_s+friction.mu_k'
    """
    keys = tuple(keys.split(LINK)) if isinstance(keys, str) else tuple(keys)
    name = LINK.join(keys)
    for key in keys:
        _check_key(key, kind)
    if len(set(keys)) < len(keys):
        raise SweepError(f"{name}: links a key with itself, allowed are different keys")
    rows = [_row(name, keys, value) for value in _listed(name, values)]
    if not rows:
        raise SweepError(f"{name}: no values, allowed is at least one")
    for i, row in enumerate(rows):
        if row in rows[:i]:
            shown = ":".join(_label(value) for value in row)
            raise SweepError(f"{name}: {shown} is there twice, allowed is each value once")
    columns = {key: [row[i] for row in rows] for i, key in enumerate(keys)}
    settings = tuple(dict(zip(keys, row, strict=True)) for row in rows)
    return Axis(name, settings, _coordinates(name, columns, kind))


def labelled_axis(
    name: str,
    long_name: str,
    unit: str,
    labels: Sequence[Any],
    settings: Sequence[Mapping[str, Any]],
) -> Axis:
    """An axis with values of its own, that stand for some settings."""
    coordinate = (_column(labels), {"units": unit, "long_name": long_name})
    return Axis(name, tuple(settings), {name: coordinate})


def scenario_axis(scenarios: Sequence[Scenario]) -> Axis:
    """Whole scenarios, by their names; SweepError for two of one name."""
    names = [scenario.name for scenario in scenarios]
    for i, name in enumerate(names):
        if name in names[:i]:
            raise SweepError(f"two scenarios are named {name}, allowed is each name once")
    settings = [{SCENARIO: scenario} for scenario in scenarios]
    return labelled_axis(SCENARIO, "scenario", "1", names, settings)


def list_entry(key: str) -> tuple[str, int, str] | None:
    """The list's key, the number and the entry of `block.list[2].entry`; None for another key."""
    found = LIST_ENTRY.match(key)
    return None if found is None else (found[1], int(found[2]), found[3])


def field_of(key: str, kind: type[Scenario]) -> FieldInfo | None:
    """What a key of a scenario holds; None where there is no such key."""
    known = keys_of(kind)
    place = list_entry(key)
    if place is None:
        return known.get(key)
    field = known.get(place[0])
    kinds = get_args(field.annotation) if field else ()
    return getattr(kinds[0], "model_fields", {}).get(place[2]) if kinds else None


def _check_key(key: str, kind: type[Scenario]) -> None:
    if field_of(key, kind) is not None:
        return
    every = keys_of(kind)
    tables = dict.fromkeys(known.partition(".")[0] for known in every)
    siblings = [known for known in every if known.partition(".")[0] == key.partition(".")[0]]
    allowed = ", ".join(siblings) or f"a key of {', '.join(tables)}"
    near = nearest_key(key, every)
    hint = f"nearest: {near}" if near else f"allowed: {allowed}"
    raise SweepError(f"{key}: no such key of a scenario, {hint}")


def _listed(name: str, values: Any) -> list[Any]:
    scalar = isinstance(values, (str, bytes, Mapping)) or not hasattr(values, "__iter__")
    if scalar or isinstance(values, np.ndarray) and values.ndim == 0:
        raise SweepError(f"{name}: not a list ({values!r}), allowed is a list of values")
    return list(values)


def _row(name: str, keys: tuple[str, ...], value: Any) -> tuple[Any, ...]:
    """One value for each key, in plain Python types (numpy's are refused by strict models)."""
    if len(keys) == 1:
        return (_plain(value),)
    if isinstance(value, str) or not hasattr(value, "__len__") or len(value) != len(keys):
        raise SweepError(
            f"{name}: not one value for each linked key ({value!r}), allowed are {len(keys)}"
        )
    return tuple(_plain(entry) for entry in value)


def _plain(value: Any) -> Any:
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, (list, tuple, np.ndarray)):
        return tuple(_plain(entry) for entry in value)
    if isinstance(value, Mapping):
        return {key: _plain(entry) for key, entry in value.items()}
    return value


def _coordinates(name: str, columns: dict[str, list[Any]], kind: type[Scenario]) -> dict[str, Any]:
    coordinates: dict[str, Any] = {}
    if len(columns) > 1:
        rows = zip(*columns.values(), strict=True)
        labels = [":".join(_label(value) for value in row) for row in rows]
        coordinates[name] = (_column(labels), {"units": "1", "long_name": name})
    for key, values in columns.items():
        field = field_of(key, kind)
        assert field is not None, "checked before"
        attributes = {
            "units": details(field).get("unit", "1"),
            "long_name": field.description or key,
        }
        number = int if field.annotation is int else float
        coordinates[key] = (_column(values, number), attributes)
    return coordinates


def _column(values: Sequence[Any], kind: type = float) -> np.ndarray:
    """Numbers as they are, anything else by its label."""
    if all(_is_number(value) for value in values):
        return np.array(values, dtype=kind)
    labels = [_label(value) for value in values]
    if any(len(label) > LONGEST_LABEL for label in labels):
        labels = [f"{i}: {label}"[:LONGEST_LABEL] for i, label in enumerate(labels, 1)]
    return np.array(labels, dtype=object)


def _is_number(value: Any) -> bool:
    # a whole number may be too large to be a float
    whole = isinstance(value, int) and not isinstance(value, bool) and abs(value) < _LARGEST
    return whole or isinstance(value, float) and math.isfinite(value)


def _label(value: Any) -> str:
    if isinstance(value, tuple):
        return " ".join(_label(entry) for entry in value)
    if isinstance(value, Mapping):
        return "(" + ", ".join(f"{key} {_label(entry)}" for key, entry in value.items()) + ")"
    if isinstance(value, bool):
        return str(value).lower()
    return format(value, "g") if _is_number(value) else str(value)


FORM = "allowed is key=v1,v2,... or, linked, key+key=v1:w1,v2:w2,..."
QUOTES = "\"'"


def parse_vary(texts: Iterable[str]) -> dict[tuple[str, ...], list[Any]]:
    """Keys -> values, or tuples of values of linked keys; SweepError in one line.

    >>> parse_vary(["rig.mass=0.67,2.03", "friction.mu_s+friction.mu_k=0.28:0.21,0.065:0.05"])
    {('rig.mass',): [0.67, 2.03], ('friction.mu_s', 'friction.mu_k'): [(0.28, 0.21), (0.065, 0.05)]}
    >>> parse_vary(["rig.degrees_of_freedom=[x],[x,y,phi]", "rig.inertia=disc,0.001"])
    {('rig.degrees_of_freedom',): [('x',), ('x', 'y', 'phi')], ('rig.inertia',): ['disc', 0.001]}
    """
    varied: dict[tuple[str, ...], list[Any]] = {}
    for text in texts:
        name, equals, values = text.partition("=")
        keys = tuple(part.strip() for part in name.split(LINK))
        if not equals or not all(keys):
            raise SweepError(f"--vary {text}: not a key with values, {FORM}")
        if keys in varied:
            raise SweepError(f"--vary {name.strip()}: varied twice, allowed is once")
        varied[keys] = _values(text, values, len(keys))
    return varied


def _values(text: str, values: str, count: int) -> list[Any]:
    if not values.strip():
        raise SweepError(f"--vary {text}: no values, {FORM}")
    wanted = "a value" if count == 1 else f"{count} values for the linked keys"
    found = []
    for part in _split(text, values, ","):
        entry = [part] if count == 1 else _split(text, part, ":")
        if len(entry) != count or not all(one.strip() for one in entry):
            shown = ":".join(entry).strip() or "an empty value"
            raise SweepError(f"--vary {text}: {shown} is not {wanted}, {FORM}")
        row = tuple(_value(text, one) for one in entry)
        found.append(row[0] if count == 1 else row)
    return found


def _split(text: str, values: str, separator: str) -> list[str]:
    """Parts between separators that stand outside brackets and quotes."""
    parts, depth, quote = [""], 0, ""
    for character in values:
        if quote:
            quote = "" if character == quote else quote
        elif character in QUOTES:
            quote = character
        else:
            depth += (character in "[{") - (character in "]}")
        if character == separator and not quote and depth == 0:
            parts.append("")
        else:
            parts[-1] += character
    if depth or quote:
        raise SweepError(f"--vary {text}: a bracket or a quotation mark is not closed, {FORM}")
    return parts


def _value(text: str, part: str) -> Any:
    """A number, true or false, a list, a table, or a word with or without quotation marks."""
    part = part.strip()
    try:
        return _plain(tomllib.loads(f"value = {part}")["value"])
    except tomllib.TOMLDecodeError as error:
        if "{" in part:
            raise SweepError(f"--vary {text}: {part} is no TOML: {error}") from None
    if part.startswith("[") and part.endswith("]"):
        entries = _split(text, part[1:-1], ",")
        return tuple(_value(text, entry) for entry in entries if entry.strip())
    for number in (int, float):
        with suppress(ValueError):
            return number(part)
    return part
