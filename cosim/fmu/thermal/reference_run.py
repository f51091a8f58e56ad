"""A run to compare the units of belt and ice with: the whole finite-element model, stepped here."""

from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np

from cosim.fmu.description.documentation import Experiment, Row, cross_check
from cosim.fmu.thermal.variables import NAME, REFERENCE
from cosim.fmu.variables import Variable, names
from thermal import BeltIceModel, ThermalParameters

EXPERIMENT = Experiment(10.0, 0.05, 1e-6)
#: Time, s -> heat flow, W, speed of the belt, m/s, place of the block, m, and running total of the
#: heat, which is not used here, J; linear in between.
INPUTS: tuple[Row, ...] = (
    (0.0, (0.0, 0.15, 0.0, 0.0)),
    (4.0, (0.5, 0.15, 0.02, 0.0)),
    (7.0, (0.2, 0.30, -0.01, 0.0)),
    (10.0, (0.3, 0.05, 0.0, 0.0)),
)


def reference_parameters() -> ThermalParameters:
    """Those that the units start from."""
    tables: dict[str, dict[str, float]] = {}
    for name, value in REFERENCE.items():
        table, _, key = name.partition(".")
        tables.setdefault(table, {})[key] = value
    return ThermalParameters.checked(tables)


def of_heat(parameters: ThermalParameters, variables: Sequence[Variable]) -> dict[str, bytes]:
    """Path in the unit -> content, of a unit with these parameters."""
    outputs = names(variables, "output")
    given = (names(variables, "input"), INPUTS)
    return cross_check(NAME, EXPERIMENT, given, (outputs, _rows(parameters, outputs)))


def _rows(parameters: ThermalParameters, outputs: list[str]) -> Iterator[Row]:
    """As the units take inputs: they are held over the step from where they are set."""
    model = BeltIceModel(parameters)
    points, given = zip(*INPUTS, strict=True)
    curves = np.transpose(given)
    x = INPUTS[0][1][2]
    yield 0.0, _values(model, outputs)
    for begin, end in pairwise(EXPERIMENT.times):
        heat_flow, speed, place, _ = (float(np.interp(begin, points, each)) for each in curves)
        size = end - begin
        model.step(size, heat_flow * size, speed * size - (place - x), speed * size)
        x = place
        yield end, _values(model, outputs)


def _values(model: BeltIceModel, outputs: list[str]) -> list[float]:
    ledger = model.ledger
    values = model.outputs() | {"heat_stored": ledger.stored, "heat_to_air": ledger.lost}
    return [values[name] for name in outputs]
