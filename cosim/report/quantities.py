"""Numbers with their units: as trees of values, and as they are read on a page."""

import math
from collections.abc import Mapping
from typing import Any

from stickslip.packaged import packaged_tables

from .page import unit_text


def with_units(tree: Mapping[str, Any], path: str = "") -> tuple[dict[str, Any], dict[str, str]]:
    """Values of a summary with None for what is not finite, and ``path.to.key`` -> unit."""
    values: dict[str, Any] = {}
    units: dict[str, str] = {}
    for key, node in tree.items():
        place = f"{path}{key}"
        if isinstance(node, Mapping):
            values[key], inner = with_units(node, f"{place}.")
            units |= inner
        elif unit := unit_of(place):
            values[key], units[place] = finite(node), unit
        else:
            values[key] = node
    return values, units


def unit_of(path: str) -> str:
    """Unit of a number of a summary, "" of what has none."""
    *_, group, key = ("", *path.split("."))
    return GROUP_UNITS.get(group, KEY_UNITS.get(key, ""))


def finite(value: float | int | None) -> float | int | None:
    """A plain number, None for NaN and infinities."""
    if value is None or not math.isfinite(value):
        return None
    return value if isinstance(value, int) else float(value)


def ratio(part: float, whole: float) -> float | None:
    """part / whole; None where the whole is zero."""
    return part / whole if whole else None


#: What is called and shown how: `tables.toml`.
TABLES: dict[str, dict[str, Any]] = packaged_tables(__package__, "tables.toml")
WORDS: dict[str, str] = TABLES["words"]
#: Key of a summary -> its unit; group -> unit of all keys in it.
KEY_UNITS: dict[str, str] = {key: unit for unit, keys in TABLES["units"].items() for key in keys}
GROUP_UNITS: dict[str, str] = TABLES["group_units"]
ROUNDING: dict[str, float] = TABLES["rounding"]

NONE = "–"
#: Digits of what is given, and of differences between results.
DIGITS = 5
#: Digits of what a run finds: a rig's friction, springs and belt are known to percents. A rise of
#: temperature is in doubt by a factor of 0.75 to 2 (`stickslip belt-length`).
FOUND = 3
FOUND_RISE = 2
MINUS = str.maketrans("-", "−")
SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
# units that are read more easily with a prefix than with a power of ten
PREFIXED = {"m", "K", "W", "N", "s", "J", "m/s", "rad", "rad/s", "N.m"}


def worded(key: str) -> str:
    """A key of the summary in words."""
    return WORDS.get(key, key.replace("_", " "))


def spelled(unit: str) -> str:
    """A unit as it is printed."""
    return "" if unit == "1" else unit_text(unit)


def told(
    value: float | int | None, unit: str, share: bool = False, count: int | None = None
) -> str:
    """A number with its unit; a share in percent; a dash where there is none.

    count: of digits; left out, as many as what a run finds is worth. What is but rounding beside
    the sizes that its unit has in a rig is 0.
    """
    if value is None:
        return NONE
    if count is None:
        count = FOUND_RISE if unit == "K" else FOUND
    if abs(value) < ROUNDING.get(unit, 0.0):
        value = 0
    if share:
        return f"{100.0 * value:z.{count - 2}f} %".translate(MINUS)
    if unit == "deg":
        return f"{value:z.2f}°".translate(MINUS)
    if unit in PREFIXED and 1e-6 <= abs(value) < 0.1:
        factor, prefix = (1e3, "m") if abs(value) >= 1e-3 else (1e6, "µ")
        return f"{digits(factor * value, count)} {prefix}{spelled(unit)}"
    return with_unit(digits(value, count), spelled(unit))


def told_at(value: float | int | None, path: str) -> str:
    """A number of a summary, by its ``path.to.key``, as `told`."""
    return told(value, unit_of(path), is_share(path))


def is_share(path: str) -> bool:
    """Whether a number of a summary is read in percent."""
    return path.endswith("share") or path.startswith("heat_shares.")


def with_unit(number: str, unit: str) -> str:
    """A number and its spelled unit; the degree of an angle stands close."""
    return number + unit if unit == "°" else f"{number} {unit}".rstrip()


def digits(value: Any, count: int = DIGITS) -> str:
    """A value with at most so many digits, powers of ten written out; text and lists as they are.

    A whole number has all of its own.
    """
    if isinstance(value, (list, tuple)):
        return ", ".join(digits(item, count) for item in value)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return str(value)
    if isinstance(value, int) or value == int(value) and abs(value) < 1e6:
        return f"{int(value)}".translate(MINUS)
    if 1e-4 <= abs(value) < 1e6:
        # %g would go over to powers of ten
        decimals = count - 1 - math.floor(math.log10(abs(value)))
        text = f"{round(value, decimals):.{max(0, decimals)}f}"
        return (text.rstrip("0").rstrip(".") if "." in text else text).translate(MINUS)
    mantissa, exponent = f"{value:.2e}".split("e")
    return f"{mantissa.translate(MINUS)} · 10{str(int(exponent)).translate(SUPERSCRIPT)}"
