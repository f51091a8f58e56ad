"""What is varied: values of one key, or of several that go together; also as text, of `--vary`."""

import math
import re
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import Any, get_args

import numpy as np
import xarray as xr
from pydantic.fields import FieldInfo
from stickslip import Parameters

from cosim.names import nearest_key
from cosim.scenario import Scenario
from cosim.scenario.toml_file import value_of
from cosim.scenario.validation import known_keys, unit_of

LINK = "+"
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
    coordinates : name -> values along it as a result file holds them, with unit and long name
    """

    name: str
    settings: tuple[Mapping[str, Any], ...]
    coordinates: Mapping[str, xr.Variable] = field(repr=False)

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
    name, fields = LINK.join(keys), {key: _field(key, kind) for key in keys}
    if len(fields) < len(keys):
        raise SweepError(f"{name}: links a key with itself, allowed are different keys")
    rows = _rows(name, len(keys), values)
    if not rows:
        raise SweepError(f"{name}: no values, allowed is at least one")
    labels = [":".join(map(_label, row)) for row in rows]
    for i, row in enumerate(rows):
        if row in rows[:i]:
            raise SweepError(f"{name}: {labels[i]} is there twice, allowed is each value once")
    coordinates = {name: _coordinate(name, labels, "1", name)}  # of one key, its own values instead
    for (key, of), column in zip(fields.items(), zip(*rows, strict=True), strict=True):
        number = int if of.annotation is int else float
        coordinates[key] = _coordinate(name, column, unit_of(of), of.description or key, number)
    return Axis(name, tuple(dict(zip(keys, row, strict=True)) for row in rows), coordinates)


def labelled_axis(
    name: str,
    long_name: str,
    unit: str,
    labels: Sequence[Any],
    settings: Iterable[Mapping[str, Any]],
) -> Axis:
    """An axis with values of its own, that stand for some settings."""
    return Axis(name, tuple(settings), {name: _coordinate(name, labels, unit, long_name)})


def list_entry(key: str) -> tuple[str, int, str] | None:
    """The list's key, the number and the entry of `block.list[2].entry`; None for another key."""
    found = LIST_ENTRY.match(key)
    return None if found is None else (found[1], int(found[2]), found[3])


def _field(key: str, kind: type[Scenario]) -> FieldInfo:
    """What a key of a scenario holds; SweepError where there is no such key."""
    every = keys_of(kind)
    of_list, _, entry = list_entry(key) or (key, 0, "")
    found = every.get(of_list)
    if entry and found is not None:
        tables = get_args(found.annotation)
        found = getattr(tables[0], "model_fields", {}).get(entry) if tables else None
    if found is not None:
        return found
    tables_known = dict.fromkeys(known.partition(".")[0] for known in every)
    siblings = [known for known in every if known.partition(".")[0] == key.partition(".")[0]]
    allowed = ", ".join(siblings) or f"a key of {', '.join(tables_known)}"
    near = nearest_key(key, every)
    hint = f"nearest: {near}" if near else f"allowed: {allowed}"
    raise SweepError(f"{key}: no such key of a scenario, {hint}")


def _rows(name: str, count: int, values: Any) -> list[tuple[Any, ...]]:
    """Of each of some values one for each of so many keys, in plain Python types."""
    if isinstance(values, (str, bytes, Mapping)) or not np.iterable(values):
        raise SweepError(f"{name}: not a list ({values!r}), allowed is a list of values")
    rows = [(value,) if count == 1 else value for value in map(_plain, values)]
    for row in rows:
        if not isinstance(row, tuple) or len(row) != count:
            said = f"not one value for each linked key ({row!r}), allowed are {count}"
            raise SweepError(f"{name}: {said}")
    return rows


def _plain(value: Any) -> Any:
    """Python's own types in place of numpy's, which strict models refuse."""
    if isinstance(value, (np.generic, np.ndarray)):
        value = value.tolist()
    if isinstance(value, Mapping):
        return {key: _plain(entry) for key, entry in value.items()}
    return tuple(map(_plain, value)) if isinstance(value, (list, tuple)) else value


def _coordinate(
    dim: str, values: Sequence[Any], unit: str, long_name: str, number: type = float
) -> xr.Variable:
    """Numbers as they are, anything else by its label."""
    attributes = {"units": unit, "long_name": long_name}
    if all(map(_is_number, values)):
        return xr.Variable(dim, np.array(values, number), attributes)
    labels = [_label(value) for value in values]
    if max(map(len, labels)) > LONGEST_LABEL:
        labels = [f"{i}: {label}"[:LONGEST_LABEL] for i, label in enumerate(labels, 1)]
    return xr.Variable(dim, np.array(labels, object), attributes)


def _is_number(value: Any) -> bool:
    # a whole number may be too large to be a float
    whole = isinstance(value, int) and not isinstance(value, bool) and abs(value) < _LARGEST
    return whole or isinstance(value, float) and math.isfinite(value)


def _label(value: Any) -> str:
    if isinstance(value, tuple):
        return " ".join(map(_label, value))
    if isinstance(value, Mapping):
        return "(" + ", ".join(f"{key} {_label(entry)}" for key, entry in value.items()) + ")"
    if isinstance(value, bool):
        return str(value).lower()
    return format(value, "g") if _is_number(value) else str(value)


FORM = "allowed is key=v1,v2,... or, linked, key+key=v1:w1,v2:w2,..."


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
        if not values.strip():
            raise SweepError(f"--vary {text}: no values, {FORM}")
        varied[keys] = [_entry(text, part, len(keys)) for part in _split(text, values, ",")]
    return varied


def _entry(text: str, part: str, count: int) -> Any:
    """The value of one key, or a tuple of those of linked ones."""
    parts = [part] if count == 1 else _split(text, part, ":")
    if len(parts) != count or not all(one.strip() for one in parts):
        wanted = "a value" if count == 1 else f"{count} values for the linked keys"
        shown = part.strip() or "an empty value"
        raise SweepError(f"--vary {text}: {shown} is not {wanted}, {FORM}")
    values = tuple(_value(text, one) for one in parts)
    return values[0] if count == 1 else values


def _split(text: str, values: str, separator: str) -> list[str]:
    """Parts between separators that stand outside brackets and quotes."""
    parts, depth, quote = [""], 0, ""
    for character in values:
        if quote:
            quote = "" if character == quote else quote
        elif character in "\"'":
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
        return _plain(tomllib.loads(f"value = {part}")["value"] if "{" in part else value_of(part))
    except tomllib.TOMLDecodeError as error:
        raise SweepError(f"--vary {text}: {part} is no TOML: {error}") from None
