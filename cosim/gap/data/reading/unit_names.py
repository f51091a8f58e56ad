"""Units that a tracker's columns may be in, and what makes SI of them."""

from __future__ import annotations

from cosim.coupling.conversion import BASE_UNITS, Affine, conversion
from cosim.coupling.participant import Causality, CouplingError, Port, UnitDefinition
from cosim.fmu.units import UNITS as DEFINED
from cosim.names import nearest

#: Channel -> what it is in inside.
SI = {"t": "s", "x": "m", "y": "m", "phi": "rad", "force": "N"}
_WHAT = {"s": "time", "m": "length", "rad": "angle", "N": "force"}
_PREFIXES = {"n": 1e-9, "u": 1e-6, "µ": 1e-6, "μ": 1e-6, "m": 1e-3, "c": 1e-2, "k": 1e3}
#: SI unit -> prefixes that somebody measures with.
_PREFIXED = {"s": "nuµμm", "m": "nuµμmck", "rad": "uµμm", "N": "uµμmk"}
#: Other words -> the unit.
_WORDS = {
    "°": "deg", "degree": "deg", "degrees": "deg", "sec": "s", "second": "s", "seconds": "s",
    "metre": "m", "metres": "m", "meter": "m", "meters": "m", "radian": "rad", "radians": "rad",
    "newton": "N", "newtons": "N",
}  # fmt: skip
#: Prefixes in full, and the signs for micro as they are shown.
_SPELLED = {
    "n": "nano", "u": "micro", "µ": "micro", "μ": "micro", "m": "milli", "c": "centi", "k": "kilo",
}  # fmt: skip
_ASCII = {"µ": "u", "μ": "u"}
#: Minutes, by the second.
_MINUTE = 60.0


def to_si(channel: str, unit: str) -> Affine:
    """From a unit to that of a channel; ValueError: what is wrong with it and what is allowed.

    >>> to_si("x", "mm")(12.0), round(to_si("phi", "deg")(180.0), 4)
    (0.012, 3.1416)
    """
    wanted = SI[channel]
    known = _definitions()
    name = _WORDS.get(unit, unit)
    allowed = f"allowed is a {_WHAT[wanted]}: {', '.join(_of(wanted))}"
    if name not in known:
        meant = _meant(unit, wanted)
        hint = f" (nearest: {meant})" if meant else ""
        raise ValueError(f"{unit} is no unit that is known, {allowed}{hint}")
    source = Port(channel, name, Causality.OUTPUT, definition=known[name])
    sink = Port(channel, wanted, Causality.INPUT, definition=known[wanted])
    try:
        return conversion(source, sink)[0]
    except CouplingError:
        raise ValueError(f"{unit} is of another kind, {allowed}") from None


def is_unit(text: str) -> bool:
    """Whether a text is a unit of any channel, in brackets or not.

    >>> is_unit("mm"), is_unit("[ms]"), is_unit("lost")
    (True, True, False)
    """
    bare = text.strip().strip("[]()").strip()
    return _WORDS.get(bare, bare) in _definitions()


def _meant(unit: str, wanted: str) -> str | None:
    """The unit of one kind that a word is most like: `MM` is mm, `msec` and `millimetre` too."""
    spelled = {name.lower(): name for name in _of(wanted)}
    words = [wanted, *(word for word, name in _WORDS.items() if name == wanted and len(word) > 1)]
    for prefix in _PREFIXED[wanted]:
        for begin in {prefix, _SPELLED[prefix]}:
            spelled |= {begin + word: _ASCII.get(prefix, prefix) + wanted for word in words}
    near = nearest(unit.lower(), spelled)
    return spelled[near] if near else None


def _of(wanted: str) -> list[str]:
    """What is shown of the units of one kind: without the two other signs for micro."""
    prefixed = [prefix + wanted for prefix in _PREFIXED[wanted] if prefix not in "µμ"]
    return [wanted, *prefixed, *{"rad": ["deg"], "s": ["min"]}.get(wanted, [])]


def _definitions() -> dict[str, UnitDefinition]:
    """Unit -> what it is made of."""
    found = {name: _definition(name) for name in ("s", "m", "rad", "N", "deg")}
    for unit, prefixes in _PREFIXED.items():
        for prefix in prefixes:
            whole = found[unit]
            found[prefix + unit] = UnitDefinition(whole.exponents, _PREFIXES[prefix] * whole.factor)
    found["min"] = UnitDefinition(found["s"].exponents, _MINUTE)
    return found


def _definition(name: str) -> UnitDefinition:
    parts = DEFINED[name] or {}
    kg, m, s, a, k, mol, cd, rad = (int(parts.get(base, 0)) for base in BASE_UNITS)
    return UnitDefinition((kg, m, s, a, k, mol, cd, rad), float(parts.get("factor", 1.0)))
