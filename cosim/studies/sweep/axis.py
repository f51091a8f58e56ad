"""What is varied: values of one key, or of several that go together; also as text, of `--vary`."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from stickslip import Parameters
from stickslip.quantity import details

from cosim.names import nearest_key
from cosim.scenario.faults import known_keys

from .combination import SweepError

LINK = "+"
KEYS = {key: entry for key, entry in known_keys(Parameters).items() if "." in key}


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


def axis(keys: str | Sequence[str], values: Sequence[Any]) -> Axis:
    """The axis of one key, or of linked keys: a tuple of keys (or "a+b") and tuples of values.

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
        _check_key(key)
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
    return Axis(name, settings, _coordinates(name, columns))


def labelled_axis(
    name: str, long_name: str, unit: str, labels: Sequence[Any], settings: Sequence[Mapping]
) -> Axis:
    """An axis with values of its own, that stand for some settings."""
    coordinate = (_column(labels), {"units": unit, "long_name": long_name})
    return Axis(name, tuple(settings), {name: coordinate})


def _check_key(key: str) -> None:
    if key in KEYS:
        return
    near = nearest_key(key, KEYS)
    block = key.partition(".")[0]
    siblings = [known for known in KEYS if known.partition(".")[0] == block]
    blocks = f"a key of {', '.join(dict.fromkeys(known.partition('.')[0] for known in KEYS))}"
    hint = f"nearest: {near}" if near else f"allowed: {', '.join(siblings) or blocks}"
    raise SweepError(f"{key}: no such key of the mechanics, which a sweep runs alone, {hint}")


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
    return value


def _coordinates(name: str, columns: dict[str, list[Any]]) -> dict[str, Any]:
    coordinates: dict[str, Any] = {}
    if len(columns) > 1:
        rows = zip(*columns.values(), strict=True)
        labels = [":".join(_label(value) for value in row) for row in rows]
        coordinates[name] = (_column(labels), {"units": "1", "long_name": name})
    for key, values in columns.items():
        field = KEYS[key]
        attributes = {
            "units": details(field).get("unit", "1"),
            "long_name": field.description or key,
        }
        kind = int if field.annotation is int else float
        coordinates[key] = (_column(values, kind), attributes)
    return coordinates


def _column(values: Sequence[Any], kind: type = float) -> np.ndarray:
    """Numbers as they are, anything else by its label."""
    if all(_is_number(value) for value in values):
        return np.array(values, dtype=kind)
    return np.array([_label(value) for value in values], dtype=object)


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and _is_finite(value)


def _is_finite(value: float) -> bool:
    try:
        return math.isfinite(value)
    except OverflowError:
        return False


def _label(value: Any) -> str:
    if isinstance(value, tuple):
        return " ".join(_label(entry) for entry in value)
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
    entries = [_split(text, part, ":") for part in _split(text, values, ",")]
    if count == 1:
        entries = [[part] for part in _split(text, values, ",")]
    for entry in entries:
        if len(entry) != count or not all(part.strip() for part in entry):
            raise SweepError(
                f"--vary {text}: {':'.join(entry).strip() or 'an empty value'} is not "
                f"{'a value' if count == 1 else f'{count} values for the linked keys'}, {FORM}"
            )
    parsed = [tuple(_value(text, part) for part in entry) for entry in entries]
    return [entry[0] for entry in parsed] if count == 1 else parsed


def _split(text: str, values: str, separator: str) -> list[str]:
    """Parts between separators that stand outside brackets and quotes."""
    parts, depth, quote = [""], 0, ""
    for character in values:
        if quote:
            quote = "" if character == quote else quote
        elif character in QUOTES:
            quote = character
        else:
            depth += (character == "[") - (character == "]")
        if character == separator and not quote and depth == 0:
            parts.append("")
        else:
            parts[-1] += character
    if depth or quote:
        raise SweepError(f"--vary {text}: a bracket or a quotation mark is not closed, {FORM}")
    return parts


def _value(text: str, part: str) -> Any:
    """A number, a list in brackets, or a word with or without quotation marks."""
    part = part.strip()
    if part.startswith("[") and part.endswith("]"):
        inner = part[1:-1]
        return tuple(_value(text, entry) for entry in _split(text, inner, ",") if entry.strip())
    if len(part) > 1 and part[0] in QUOTES and part[-1] == part[0]:
        return part[1:-1]
    for number in (int, float):
        try:
            return number(part)
        except ValueError:
            continue
    return part
