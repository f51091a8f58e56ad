"""Units that a tracker's columns may be in, and what makes SI of them."""

from __future__ import annotations

import math

from cosim.names import nearest

#: Channel -> what it is in inside.
SI = {"t": "s", "x": "m", "y": "m", "phi": "rad", "force": "N"}
_WHAT = {"s": "time", "m": "length", "rad": "angle", "N": "force"}
_PREFIXES = {"n": 1e-9, "u": 1e-6, "m": 1e-3, "c": 1e-2, "k": 1e3}
_SPELLED = {"n": "nano", "u": "micro", "m": "milli", "c": "centi", "k": "kilo"}
#: SI unit -> name of a unit that somebody measures in -> factor.
FACTORS = {
    unit: {unit: 1.0} | {prefix + unit: _PREFIXES[prefix] for prefix in prefixes}
    for unit, prefixes in {"s": "num", "m": "numck", "rad": "um", "N": "umk"}.items()
}
FACTORS["s"]["min"] = 60.0
FACTORS["rad"]["deg"] = math.pi / 180.0
#: Other words -> the unit.
_WORDS = {
    "°": "deg", "degree": "deg", "degrees": "deg", "sec": "s", "second": "s", "seconds": "s",
    "metre": "m", "metres": "m", "meter": "m", "meters": "m", "radian": "rad", "radians": "rad",
    "newton": "N", "newtons": "N",
}  # fmt: skip


def to_si(channel: str, unit: str) -> float:
    """Factor from a unit to that of a channel; ValueError: what is wrong and what is allowed.

    >>> to_si("x", "mm"), to_si("y", "µm"), round(180.0 * to_si("phi", "°"), 4)
    (0.001, 1e-06, 3.1416)
    """
    units = FACTORS[SI[channel]]
    if (name := _name(unit)) in units:
        return units[name]
    allowed = f"allowed is a {_WHAT[SI[channel]]}: {', '.join(units)}"
    if is_unit(unit):
        raise ValueError(f"{unit} is of another kind, {allowed}")
    near = nearest(unit.lower(), words := _words(SI[channel]))
    raise ValueError(
        f"{unit} is no unit that is known, {allowed}{f' (nearest: {words[near]})' if near else ''}"
    )


def is_unit(text: str) -> bool:
    """Whether a text is a unit of any channel, in brackets or not.

    >>> is_unit("mm"), is_unit("[ms]"), is_unit("lost")
    (True, True, False)
    """
    return any(_name(text.strip().strip("[]()").strip()) in units for units in FACTORS.values())


def _name(unit: str) -> str:
    """As it is listed: there are two signs for micro."""
    return _WORDS.get(unit, unit.replace("µ", "u").replace("μ", "u"))


def _words(wanted: str) -> dict[str, str]:
    """What a word may be meant for: `MM` for mm, `msec` and `millimetre` too."""
    words = [wanted, *(word for word, name in _WORDS.items() if name == wanted)]
    spelled = {name.lower(): name for name in FACTORS[wanted]}
    for prefix, whole in _SPELLED.items():
        if prefix + wanted in FACTORS[wanted]:
            spelled |= {begin + w: prefix + wanted for begin in (prefix, whole) for w in words}
    return spelled
