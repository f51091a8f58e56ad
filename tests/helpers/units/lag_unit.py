"""A small FMI 2.0 unit in C, made where a test needs one: y' = gain * u - rate * y, solved exactly.

Its ports can be given names, units and definitions of units.
"""

from collections.abc import Mapping
from pathlib import Path

from c_units import made

UNITS = {
    "degC": 'K="1" offset="273.15"',
    "K": 'K="1"',
    "m": 'm="1"',
    "mm": 'm="1" factor="0.001"',
    "J": 'kg="1" m="2" s="-2"',
    "kJ": 'kg="1" m="2" s="-2" factor="1000"',
    "W": 'kg="1" m="2" s="-3"',
    "N": 'kg="1" m="1" s="-2"',
}


def lag_unit(
    path: Path,
    u_unit: str = "",
    y_unit: str = "",
    *,
    u: str = "u",
    y: str = "y",
    gain: str = "part.gain",
    units: Mapping[str, str] = UNITS,
) -> Path:
    """Write the unit; u, y, gain: names of its variables; u_unit, y_unit: "" for none."""
    used = {unit: units[unit] for unit in (u_unit, y_unit) if unit}
    defined = "".join(f'<Unit name="{n}"><BaseUnit {b}/></Unit>' for n, b in used.items())
    said = {"units": defined or '<Unit name="none"/>', "u": u, "y": y, "gain": gain}
    said |= {"u_unit": u_unit and f' unit="{u_unit}"', "y_unit": y_unit and f' unit="{y_unit}"'}
    written = {f"{{{name}}}": text for name, text in said.items()}
    return made("lag", path.parent, **written).rename(path)
