"""A small FMI 2.0 unit in C, made where a test needs one: y' = gain * u - rate * y, solved exactly.

Its ports can be given names, units and definitions of units.
"""

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

from c_units import made

UNITS = {
    "degC": 'K="1" offset="273.15"', "K": 'K="1"', "m": 'm="1"', "mm": 'm="1" factor="0.001"',
    "J": 'kg="1" m="2" s="-2"', "kJ": 'kg="1" m="2" s="-2" factor="1000"',
    "W": 'kg="1" m="2" s="-3"', "N": 'kg="1" m="1" s="-2"',
}  # fmt: skip

#: y1 = 6 t exactly, which a linear waveform is; y2' = y1 - 2 y2. More lines for the second unit.
RAMP = """
units.ramp = {{ file = "lag.fmu", parameters = {{ "part.gain" = 6.0 }}, inputs = {{ u = 1.0 }} }}
connections = [{{ from = "ramp.y", to = "lag.u" }}]
coupling = {{ scheme = "iterated", macro_step = 0.1 }}
run.stop = 1.0
[units.lag]
file = "lag.fmu"
parameters = {{ "part.rate" = 2.0 }}
{more}
"""


def lag_unit(
    path: Path,
    u_unit: str = "",
    y_unit: str = "",
    *,
    u: str = "u",
    y: str = "y",
    gain: str = "part.gain",
    units: Mapping[str, str] = UNITS,
    changes: Mapping[str, str] = MappingProxyType({}),
) -> Path:
    """Write the unit; u, y, gain: names of its variables; u_unit, y_unit: "" for none.

    changes: what else is replaced in its description.
    """
    used = {unit: units[unit] for unit in (u_unit, y_unit) if unit}
    defined = "".join(f'<Unit name="{n}"><BaseUnit {b}/></Unit>' for n, b in used.items())
    said = {"units": defined or '<Unit name="none"/>', "u": u, "y": y, "gain": gain}
    said |= {"u_unit": u_unit and f' unit="{u_unit}"', "y_unit": y_unit and f' unit="{y_unit}"'}
    written = {f"{{{name}}}": text for name, text in said.items()}
    return made("lag", path.parent, **written, **changes).rename(path)
