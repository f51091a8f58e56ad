"""Numbers with their units: as trees of values, and as they are read on a page."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

from .page import unit_text


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


WORDS = {
    "begin": "window begins",
    "duration": "window lasts",
    "break_aways": "break-aways counted",
    "frequency": "stick-slip frequency",
    "mean_period": "mean time between break-aways",
    "slip_share": "share of the time in slip",
    "mean_x": "mean x",
    "min_x": "smallest x",
    "max_x": "largest x",
    "mean_y": "mean y",
    "min_y": "smallest y",
    "max_y": "largest y",
    "max_rotation_deg": "largest rotation",
    "mean_friction_force_x": "mean friction along x",
    "max_friction_force_x": "largest friction along x",
    "mean_heat_flow": "mean friction heat",
    "surface_travel": "travel of the surface",
    "sliding_distance": "sliding distance",
    "surface_work": "work of the surface",
    "external_work": "work of the external forces",
    "damping_heat": "heat in the structural damping",
    "friction_heat": "friction heat",
    "residual": "residual at the end",
    "largest_residual": "largest residual",
    "relative_residual": "largest residual, relative",
    "received": "received from friction",
    "belt": "in the belt",
    "ice": "in the ice",
    "air": "given to the air",
    "melting": "spent on melting",
    "from_contact_to_belt": "entered the belt at the contact",
    "handed_over": "handed over by the mechanics",
    "taken_up": "taken up by belt and ice",
    "largest_difference": "largest difference",
    "relative_difference": "largest difference, relative",
    "largest_total_residual": "largest residual of the whole system",
    "onset": "melting begins",
    "melted_mass": "ice that the block has lost",
    "refrozen_mass": "of it lying frozen on the belt",
    "wiped_ice_mass": "of it frozen on the belt, and wiped off",
    "mean_melt_rate": "melt rate, mean since then",
    "max_melt_rate": "largest melt rate",
    "melting_share": "share of the friction heat spent on melting since then",
    "melting_share_end": "share of the friction heat spent on melting",
    "friction_before": "friction coefficient in the second before",
    "friction_end": "friction coefficient",
    "film_thickness": "water under the block, mean thickness",
    "film_fed_by_melting": "thickness that melting alone feeds",
    "friction_stress": "stress of friction",
    "whole_film_shear": "shear of the film if it covered the whole contact",
    "largest_flooded_share": "share of the contact that it can cover at most",
    "flooded_share": "flooded share",
    "water_shear": "shear of the water, part of the stress",
    "interface": "contact, mean of both faces",
    "belt_entry": "belt before the contact",
    "belt_exit": "belt behind the contact",
    "ice_face": "face of the ice",
}

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
PREFIXED = {"m", "K", "W", "N", "s", "J"}


#: Unit -> what is rounding below it, beside what a rig's block, belt and ice are like: an atom's
#: size for a length, a part in 1e13 or less of the nominal values for the others.
ROUNDING = {
    "m": 1e-10,
    "m/s": 1e-13,
    "rad": 1e-12,
    "deg": 1e-10,
    "rad/s": 1e-11,
    "N": 1e-13,
    "N.m": 1e-14,
    "W": 1e-14,
    "J": 1e-15,
    "K": 1e-11,
    "kg": 1e-16,
    "kg/s": 1e-16,
    "Pa": 1e-9,
}


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
        return f"{digits(factor * value, count)} {prefix}{unit}"
    return with_unit(digits(value, count), spelled(unit))


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
