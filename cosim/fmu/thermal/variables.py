"""What BeltIceThermal has for variables: ports, and parameters by the keys of a scenario's tables.

Nothing here imports the heat model: where a wheel is made there is no scikit-fem.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

from cosim.fmu.variables import Variable

NAME = "BeltIceThermal"
DESCRIPTION = (
    "Temperature of a belt and of a block of ice that stands on it while the belt runs: friction "
    "heat in, temperature of the interface out"
)
#: Of still air about the reference scenario's belt as its run warms it, W/(m2 K).
STILL_AIR = 6.417402098137803
#: Where the units start from, beside the defaults of the heat model: its reference scenario.
REFERENCE: Mapping[str, float] = {
    "belt.air_heat_transfer": STILL_AIR,
    "contact.load": 0.67 * 9.81,
}
AIR = "Heat given to the air, and to what supports the belt less what rubbing there makes"
#: Which of the belt's temperatures is read where.
_EDGE = "face of the belt an eighth of the contact's length"


def inputs() -> list[Variable]:
    """Held over a step."""
    return [
        Variable(
            "heat_flow",
            "input",
            "W",
            0.1,
            "Friction heat, mean over the step; does not count once heat has changed",
            min=0.0,
            start=0.0,
        ),
        Variable(
            "surface_speed", "input", "m/s", 0.1, "Speed of the belt, mean over the step", start=0.0
        ),
        Variable(
            "x", "input", "m", 0.1, "Position of the block along the belt's motion", start=0.0
        ),
        Variable(
            "heat",
            "input",
            "J",
            1.0,
            "Friction heat, running total: what it has risen by since the last step is the heat of "
            "this one; from its first change on it counts in place of heat_flow",
            start=0.0,
        ),
    ]


def outputs() -> list[Variable]:
    """At the end of a step; the melt rate is the mean over it."""
    return [
        _output("interface_temperature", "degC", 10.0, "Mean of the two faces over the contact"),
        _output("belt_entry_temperature", "degC", 10.0, f"{_EDGE} before the contact".capitalize()),
        _output("belt_exit_temperature", "degC", 10.0, f"{_EDGE} behind the contact".capitalize()),
        _output("ice_face_temperature", "degC", 10.0, "Face of the ice, mean over the contact"),
        _output(
            "belt_share", "1", 1.0, "Share of the friction heat that went into the belt so far"
        ),
        _output("melt_rate", "kg/s", 1e-6, "Ice that melts, mean over the step; below 0: freezes"),
        _output("melted_mass", "kg", 1e-3, "Ice that has melted since the start"),
        _output("heat_received", "J", 1.0, "Friction heat taken in: heat_stored + heat_to_air"),
        _output(
            "heat_stored", "J", 1.0, "Heat in belt, ice and melt water, from the air's temperature"
        ),
        _output("heat_to_air", "J", 1.0, AIR),
    ]


def _output(name: str, unit: str, nominal: float, description: str) -> Variable:
    return Variable(name, "output", unit, nominal, description)


#: Initial value of an output -> the parameters that it follows from: nothing has happened yet.
STARTS = {
    each.name: ("ambient.temperature_degC",) if each.unit == "degC" else () for each in outputs()
}


def reduced_parameters() -> list[Variable]:
    """Those of the reduced unit, in the order of its `Numbers`; all else is in its matrices.

    Bounds as in the heat model. The starts are those of the reference scenario; a unit that is
    built for other parameters has others (`reduced`).
    """
    return [
        _parameter(
            "ambient.temperature_degC",
            "degC",
            -8.0,
            "Air; belt and ice start from it",
            (-100.0, 0.0),
        ),
        _parameter(
            "belt.air_heat_transfer",
            "W/(m2.K)",
            STILL_AIR,
            "Heat transfer to the air, on each free face of the belt",
            (0.0, 1e4),
        ),
        _parameter(
            "ice.air_heat_transfer",
            "W/(m2.K)",
            10.0,
            "Heat transfer to the air, on side and top of the ice",
            (0.0, 1e3),
        ),
        _parameter("ice.latent_heat", "J/kg", 334e3, "Latent heat of melting", (0.0, 1e7), True),
        _parameter(
            "contact.conductance",
            "W/(m2.K)",
            1e4,
            "Contact conductance between the two faces",
            (0.0, 1e12),
            True,
        ),
        _parameter(
            "contact.belt_side",
            "1",
            0.5,
            "Share of the friction heat that arises on the belt's face",
            (0.0, 1.0),
        ),
        _parameter(
            "contact.wiper",
            "1",
            0.0,
            "Part of the water and of the ice on the belt that a wiper takes off",
            (0.0, 1.0),
        ),
        _parameter(
            "contact.load",
            "N",
            0.67 * 9.81,
            "Weight on the contact, which squeezes melt water out",
            (0.0, 1e9),
        ),
    ]


def _parameter(
    name: str,
    unit: str,
    start: float,
    description: str,
    bounds: tuple[float, float],
    above_min: bool = False,
) -> Variable:
    return Variable(
        name,
        "parameter",
        unit,
        abs(start) or 1.0,
        description,
        min=bounds[0],
        max=bounds[1],
        above_min=above_min,
        start=start,
    )


def reduced(starts: Mapping[str, float] = MappingProxyType({})) -> list[Variable]:
    """All variables of the reduced unit, in the order of their value references."""
    parameters = [
        replace(each, start=starts.get(each.name, each.start)) for each in reduced_parameters()
    ]
    return [*inputs(), *outputs(), *parameters]
