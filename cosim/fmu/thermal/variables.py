"""What BeltIceThermal has for variables: ports, and parameters by the keys of a scenario's tables.

Nothing here imports the heat model: where a wheel is made there is no scikit-fem.
"""

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

from stickslip.packaged import packaged_tables

from cosim.fmu.variables import Variable

NAME = "BeltIceThermal"
DESCRIPTION = (
    "Temperature of a belt and of a block of ice that stands on it while the belt runs: friction "
    "heat in, temperature of the interface out"
)
_DECLARED = packaged_tables(__package__, "variables.toml")
#: Output -> how far the reduced unit is from the whole model, at a low and a high speed.
ERRORS: Mapping[str, list[str]] = _DECLARED["errors"]


def _declared(causality: str) -> list[Variable]:
    variables = _DECLARED[causality].items()
    return [
        Variable(name, causality, **({"nominal": abs(told.get("start", 0.0)) or 1.0} | told))
        for name, told in variables
    ]


def inputs() -> list[Variable]:
    """Held over a step."""
    return _declared("input")


def outputs() -> list[Variable]:
    """At the end of a step; the melt rate is the mean over it."""
    return _declared("output")


#: Where the units start from, beside the defaults of the heat model: its reference scenario.
REFERENCE: Mapping[str, float] = {
    key: _DECLARED["parameter"][key]["start"] for key in ("belt.air_heat_transfer", "contact.load")
}
#: Initial value of an output -> the parameters that it follows from: nothing has happened yet.
STARTS = {
    each.name: ("ambient.temperature_degC",) if each.unit == "degC" else () for each in outputs()
}


def reduced(starts: Mapping[str, float] = MappingProxyType({})) -> list[Variable]:
    """All variables of the reduced unit, in the order of their value references."""
    parameters = [
        replace(each, start=starts.get(each.name, each.start)) for each in _declared("parameter")
    ]
    return [*inputs(), *outputs(), *parameters]
