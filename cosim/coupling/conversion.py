"""What a connection does to a value on its way: from the source's unit to the sink's, and scaled.

Units are compared by what their participants say that they are made of (FMI: value in SI base
units = factor * value + offset), never by a table of spellings here.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from cosim.coupling.participant import CouplingError, Port, UnitDefinition
from cosim.coupling.waveform import Waveform

NO_UNIT = "1"
#: kg m^2 s^-3.
POWER = (1, 2, -3, 0, 0, 0, 0, 0)
BASE_UNITS = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")
# Definitions are written with some 15 digits, and a conversion that is none by these is none.
SAME = 1e-12


@dataclass(frozen=True)
class Affine:
    """value -> factor * value + offset.

    >>> Affine(2.0, 1.0).then(Affine(10.0))(3.0)
    70.0
    """

    factor: float = 1.0
    offset: float = 0.0

    def __call__(self, value: float) -> float:
        """The value on the other side."""
        return self.factor * value + self.offset

    def rate(self, value: float) -> float:
        """A derivative on the other side, of any order."""
        return self.factor * value

    def then(self, after: "Affine") -> "Affine":
        """This, and `after` on what it gives."""
        return Affine(after.factor * self.factor, after.factor * self.offset + after.offset)

    @property
    def is_identity(self) -> bool:
        """Whether every value stays as it is."""
        return self.factor == 1.0 and self.offset == 0.0

    def __str__(self) -> str:
        parts = ["" if self.factor == 1.0 else f"times {self.factor:.6g}"]
        if self.offset:
            parts.append(f"{'plus' if self.offset > 0 else 'less'} {abs(self.offset):.6g}")
        return ", ".join(filter(None, parts)) or "as it is"


IDENTITY: Affine = Affine()


def watts(port: Port) -> float | None:
    """W in the port's unit; None where it is no power."""
    if port.definition is not None:
        same = port.definition.exponents == POWER and port.definition.offset == 0.0
        return port.definition.factor if same else None
    return 1.0 if port.unit == "W" else None


def conversion(source: Port, sink: Port) -> tuple[Affine, str]:
    """From the unit of an output to that of an input, and a remark where nothing could be compared.

    Units of one dimension are converted by their definitions; a side without a unit takes that of
    the other, and the remark says so. Raises CouplingError when the units are of different
    dimensions, when one spelling stands for two units, and when two spellings differ and
    nobody says what they mean.
    """
    if source.definition is not None and sink.definition is not None:
        return _by_definition(source, sink), ""
    if source.unit == sink.unit:
        return IDENTITY, ""
    if NO_UNIT in (source.unit, sink.unit):
        side, taken = ("output", sink) if source.unit == NO_UNIT else ("input", source)
        return IDENTITY, f"units not checked: the {side} states none, {_told(taken)} is taken"
    raise CouplingError(
        f"{_told(source)} does not fit {_told(sink)}: the units must be the same, or be defined by"
        " both (UnitDefinitions of an FMU)"
    )


def _by_definition(source: Port, sink: Port) -> Affine:
    start, end = source.definition, sink.definition
    assert start is not None and end is not None
    if start.exponents != end.exponents:
        raise CouplingError(
            f"{_told(source)} ({told_dimension(start.exponents)}) does not fit {_told(sink)}"
            f" ({told_dimension(end.exponents)}), allowed are units of one dimension"
        )
    if start.factor == 0.0 or end.factor == 0.0:
        raise CouplingError(f"{_told(source)} to {_told(sink)}: a unit is defined by the factor 0")
    found = between(start, end)
    if source.unit == sink.unit and not found.is_identity:
        raise CouplingError(
            f"both are in {source.unit}, which they define differently: the one's value is the"
            f" other's {found}"
        )
    return found


def between(start: UnitDefinition, end: UnitDefinition) -> Affine:
    """From one unit to another of its dimension, without what is rounding of the definitions."""
    factor, offset = start.factor / end.factor, (start.offset - end.offset) / end.factor
    factor = 1.0 if math.isclose(factor, 1.0, rel_tol=SAME) else factor
    return Affine(factor, 0.0 if abs(offset) <= SAME else offset)


def _told(port: Port) -> str:
    return "no unit" if port.unit == NO_UNIT else port.unit


def told_dimension(exponents: Sequence[int]) -> str:
    """In base units, of exponents in the order of `BASE_UNITS`: kg.m2/s2 is `kg m^2 s^-2`."""
    parts = [
        name if exponent == 1 else f"{name}^{exponent}"
        for name, exponent in zip(BASE_UNITS, exponents, strict=True)
        if exponent
    ]
    return " ".join(parts) or "a plain number"


def converted(affine: Affine, waveform: Waveform) -> Waveform:
    """An input over a step, on the other side of a connection."""
    if affine.is_identity:
        return waveform
    start, *rates = waveform.coefficients
    return Waveform((affine(start), *map(affine.rate, rates)), waveform.size)
