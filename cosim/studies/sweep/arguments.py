"""`--vary key=v1,v2,...`: text to keys and values."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from .axis import LINK
from .errors import SweepError

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
