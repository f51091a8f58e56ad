"""The units that variables are in, by their base units, as FMI defines them."""

from __future__ import annotations

from math import pi

# FMI 2 unit name -> exponents of its base units, factor and offset; None: the exponents are not
# whole numbers, which FMI cannot state
UNITS: dict[str, dict[str, float] | None] = {
    "1": {},
    "m": {"m": 1},
    "m/s": {"m": 1, "s": -1},
    "rad": {"rad": 1},
    "rad/s": {"rad": 1, "s": -1},
    "rad/s2": {"rad": 1, "s": -2},
    "deg": {"rad": 1, "factor": pi / 180},
    "s": {"s": 1},
    "kg": {"kg": 1},
    "kg.m2": {"kg": 1, "m": 2},
    "N": {"kg": 1, "m": 1, "s": -2},
    "N.m": {"kg": 1, "m": 2, "s": -2},
    "N/m": {"kg": 1, "s": -2},
    "J": {"kg": 1, "m": 2, "s": -2},
    "J/m3": {"kg": 1, "m": -1, "s": -2},
    "Pa": {"kg": 1, "m": -1, "s": -2},
    "Pa.s": {"kg": 1, "m": -1, "s": -1},
    "W.s0.5/(m2.K)": None,
    "W": {"kg": 1, "m": 2, "s": -3},
    "degC": {"K": 1, "offset": 273.15},
    "K": {"K": 1},
    "kg/s": {"kg": 1, "s": -1},
    "kg/m3": {"kg": 1, "m": -3},
    "J/kg": {"m": 2, "s": -2},
    "J/(kg.K)": {"m": 2, "s": -2, "K": -1},
    "W/(m.K)": {"kg": 1, "m": 1, "s": -3, "K": -1},
    "W/(m2.K)": {"kg": 1, "s": -3, "K": -1},
    "1/K": {"K": -1},
    "1/J": {"kg": -1, "m": -2, "s": 2},
    "Hz": {"s": -1},
    "s/m": {"s": 1, "m": -1},
    "N/m3": {"kg": 1, "m": -2, "s": -2},
    "N/m5": {"kg": 1, "m": -4, "s": -2},
    "N.s/m": {"kg": 1, "s": -1},
    "N.s2/m2": {"kg": 1, "m": -1},
    "N.m.s": {"kg": 1, "m": 2, "s": -1},
    "1/m": {"m": -1},
    "1/s": {"s": -1},
    "m/s2": {"m": 1, "s": -2},
}
