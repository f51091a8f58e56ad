"""The units that variables are in, by their base units, as FMI defines them, and others as they are
written into a file."""

import re

from .packaged import packaged_tables

_DECLARED = packaged_tables(__package__, "units.toml")
#: FMI 2 unit name -> exponents of its base units, factor and offset; None: the exponents are not
#: whole numbers, which FMI cannot state.
UNITS: dict[str, dict[str, float] | None] = {
    name: None if isinstance(told, str) else told for name, told in _DECLARED["units"].items()
}
#: Letter or letters before a unit -> factor.
PREFIXES: dict[str, float] = _DECLARED["prefixes"]
#: What a unit is put together of, beside those of `UNITS` that are a word: name -> as there.
_WRITTEN: dict[str, dict[str, float]] = _DECLARED["written"]
#: A number, and a unit of whatever kind.
QUANTITY = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([^\W\d].*|°.*)")
#: Operator, bracket that opens, name, exponent, bracket that closes.
_PART = re.compile(r"\s*([*/.·]?)\s*(\(?)\s*([^\W\d]+|°C?)(?:(?:\^|\*\*)?(-?\d))?\s*(\)?)")


def in_unit(text: str, unit: str) -> float | None:
    """The number of a quantity as it is written, in a unit of `UNITS`; None where it is no such.

    Units are written as pint reads them.

    >>> in_unit("870 g", "kg"), in_unit("60 mm/s", "m/s"), in_unit("2 N/mm", "N/m")
    (0.87, 0.06, 2000.0)
    >>> in_unit("1.2 g/cm**3", "kg/m3"), in_unit("265.15 K", "degC"), in_unit("14 degF", "degC")
    (1200.0, -8.0, -10.0)
    >>> in_unit("3 mm", "kg")
    """
    found, wanted = QUANTITY.fullmatch(text), UNITS.get(unit)
    written = base_units(found[2]) if found and wanted else None
    if found is None or not wanted or written is None:
        return None
    sizes = [{"factor": 1.0, "offset": 0.0} | each for each in (written, wanted)]
    (factor, offset), (own, own_offset) = [(one.pop("factor"), one.pop("offset")) for one in sizes]
    # a difference of temperatures is in K, and in nothing else
    if sizes[0] != sizes[1] or (offset and not own_offset):
        return None
    value = float(found[1]) * factor + offset - own_offset
    return float(f"{value / own:.15g}")


def base_units(text: str) -> dict[str, float] | None:
    """Base units, factor and offset of a unit as it is written behind a number; None for no unit.

    >>> base_units("N/mm")
    {'factor': 1000.0, 'kg': 1, 's': -2}
    """
    whole: dict[str, float] = {"factor": 1.0}
    at, group, depth = 0, 1, 0
    while at < len(text):
        part = _PART.match(text, at)
        base = _named(part[3]) if part else None
        if part is None or base is None or (part[2] and depth):
            return None
        operator, opens, _, exponent, closes = part.groups()
        sign = -1 if operator == "/" else 1
        if opens:
            group, depth, sign = sign, 1, 1
        power = group * sign * int(exponent or 1)
        if "offset" in base and (power != 1 or len(text) != part.end() or at):
            return None
        for name, value in base.items():
            if name == "factor":
                whole["factor"] *= value**power
            else:
                whole[name] = whole.get(name, 0) + (value if name == "offset" else value * power)
        if closes:
            if not depth:
                return None
            group, depth = 1, 0
        at = part.end()
    return None if depth else {name: value for name, value in whole.items() if value}


def _named(name: str) -> dict[str, float] | None:
    """A unit that is a word, with or without a prefix."""
    words = {key: base for key, base in UNITS.items() if base and key.isalpha()} | _WRITTEN
    if name in words:
        return words[name]
    for prefix, factor in PREFIXES.items():
        base = words.get(name.removeprefix(prefix)) if name.startswith(prefix) else None
        if base is not None and "offset" not in base:
            return base | {"factor": base.get("factor", 1.0) * factor}
    return None
