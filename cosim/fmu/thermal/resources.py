"""The file in the resources of BeltIceThermal.fmu: the matrices of the heat model, as C reads them.

A header of 64 bytes, little-endian: "BELTICE" and a zero byte; the number 0x01020304; version 2;
four sizes: cells, trial functions through the thickness, trial functions of the ice, strips; 8
bytes of nothing; how many numbers follow; FNV-1a of 64 bits over all of the header before it and of
the numbers; 8 bytes of nothing. Then the numbers, 8 bytes each, in the order of
`Tables` in fmu_src/native/beltice/model.h.
"""

import struct

import numpy as np

from thermal import ThermalParameters
from thermal.reduction import Reduction, reduce

FILE = "beltice.bin"
#: Of the file's layout, as in resources.c.
VERSION = 2
#: What there is room for, as in model.h.
MOST_CELLS, MOST_FIELD, MOST_ICE, MOST_STRIPS, MOST_WINDOW = 4096, 32768, 40, 32, 256


class TooLarge(ValueError):
    """Parameters that make a model that the unit has no room for; one line."""


def starts(made: Reduction) -> dict[str, float]:
    """Where the unit's parameters start from, in their order."""
    p = made.parameters
    return {
        "ambient.temperature_degC": p.ambient.temperature_degC,
        "belt.air_heat_transfer": p.belt.film,
        "ice.air_heat_transfer": p.ice.air_heat_transfer,
        "ice.latent_heat": p.ice.latent_heat,
        "contact.conductance": p.contact.conductance,
        "contact.belt_side": p.contact.belt_side,
        "contact.wiper": p.contact.wiper,
        "contact.load": p.contact.load or made.ice.weight,
    }


def reduction(parameters: ThermalParameters) -> Reduction:
    """The matrices; TooLarge where they are."""
    made = reduce(parameters)
    belt, footprint = parameters.belt, made.footprint
    window = 1.125 * footprint.length * belt.cells / belt.length + 6.0
    for key, value, most in (
        ("belt.cell_length: cells", belt.cells, MOST_CELLS),
        ("belt.cell_length: modes of all cells", belt.cells * made.belt.face.size, MOST_FIELD),
        ("contact.strips: strips", footprint.strips, MOST_STRIPS),
        ("belt.cell_length: cells below the contact", window, min(MOST_WINDOW, belt.cells)),
        ("ice: trial functions", made.ice.contact.size, MOST_ICE),
    ):
        if value > most:
            raise TooLarge(f"{key}: {value:g}; the reduced unit has room for {most}")
    return made


def packed(made: Reduction) -> bytes:
    """The file."""
    p, footprint, belt, ice = made.parameters, made.footprint, made.belt, made.ice
    scalars = [
        *(p.belt.length, footprint.lane, footprint.length, footprint.area),
        *(p.ice.height, p.ice.density, p.ice.heat_capacity),
    ]
    arrays = [
        *(np.array(scalars), np.array(list(starts(made).values()))),
        *(belt.conduction, belt.film, belt.along, belt.face),
        *(ice.across, ice.upwards, ice.side, ice.top, ice.sinking, ice.contact),
        *(belt.heat, ice.heat),
    ]
    numbers = np.concatenate([array.ravel() for array in arrays]).astype("<f8")
    sizes = (p.belt.cells, belt.face.size, ice.contact.size, footprint.strips)
    header = struct.pack("<8sII4iqQ", b"BELTICE", 0x01020304, VERSION, *sizes, 0, numbers.size)
    body = numbers.tobytes()
    return header + struct.pack("<QQ", _checksum(header + body), 0) + body


def _checksum(content: bytes) -> int:
    """FNV-1a of 64 bits."""
    total = 14695981039346656037
    for byte in content:
        total = (total ^ byte) * 1099511628211 % 2**64
    return total
