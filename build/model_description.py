"""What StickSlip3DOF declares beyond what pythonfmu writes: units, ranges, structure."""

from math import pi
from xml.etree.ElementTree import Element, SubElement, fromstring, indent, tostring

# FMI 2 unit name -> exponents of its base units, factor and offset
UNITS = {
    "1": {},
    "m": {"m": 1},
    "m/s": {"m": 1, "s": -1},
    "rad": {"rad": 1},
    "rad/s": {"rad": 1, "s": -1},
    "deg": {"rad": 1, "factor": pi / 180},
    "s": {"s": 1},
    "kg": {"kg": 1},
    "kg.m2": {"kg": 1, "m": 2},
    "N": {"kg": 1, "m": 1, "s": -2},
    "N.m": {"kg": 1, "m": 2, "s": -2},
    "N/m": {"kg": 1, "s": -2},
    "J": {"kg": 1, "m": 2, "s": -2},
    "W": {"kg": 1, "m": 2, "s": -3},
    "degC": {"K": 1, "offset": 273.15},
    "1/K": {"K": -1},
    "1/m": {"m": -1},
    "1/s": {"s": -1},
    "m/s2": {"m": 1, "s": -2},
}
# name: unit, nominal, min, max, description
INPUTS = {
    "surface_speed": ("m/s", 0.1, None, None, "Speed of the surface at the block; run-up on top"),
    "interface_temperature": ("degC", 10.0, -273.15, None, "Temperature between block and surface"),
    "external_force_x": ("N", 1.0, None, None, "Force on the block along x"),
    "external_force_y": ("N", 1.0, None, None, "Force on the block along y"),
    "external_moment": ("N.m", 0.1, None, None, "Moment on the block about the vertical"),
}
OUTPUTS = {
    "x": ("m", 0.1, None, None, "Position along the surface's motion, 0 where the springs rest"),
    "y": ("m", 0.1, None, None, "Position across"),
    "phi": ("rad", 0.1, None, None, "Rotation about the vertical"),
    "vx": ("m/s", 0.1, None, None, "Velocity along x"),
    "vy": ("m/s", 0.1, None, None, "Velocity along y"),
    "omega": ("rad/s", 1.0, None, None, "Angular velocity"),
    "friction_force_x": ("N", 1.0, None, None, "Friction on the block along x"),
    "friction_force_y": ("N", 1.0, None, None, "Friction on the block along y"),
    "friction_moment": ("N.m", 0.1, None, None, "Friction moment on the block"),
    "sliding_speed": ("m/s", 0.1, 0.0, None, "Local sliding speed, mean over the contact"),
    "heat_flow": ("W", 0.1, 0.0, None, "Friction heat, mean over the last step"),
    "heat": (
        "J",
        1.0,
        0.0,
        None,
        "Friction heat since the start; its difference quotient is heat_flow",
    ),
    "sliding_distance": ("m", 1.0, 0.0, None, "Way slid since the start, mean over the contact"),
    "surface_travel": ("m", 1.0, None, None, "Way of the surface since the start"),
    "mode": (None, None, 0, 1, "0 stick, 1 slip"),
    "slip_count": (None, None, 0, None, "Break-aways since the start"),
    "energy_residual": (
        "J",
        1.0,
        None,
        None,
        "Energy gained less energy supplied: the integrator's error",
    ),
}
# Initial value of an output -> the parameters that it follows from. Totals start from zero;
# of the outputs not named here all parameters and inputs have a say.
STARTS = {
    name: (f"initial.{name}",) for name in ("x", "y", "phi", "vx", "vy", "omega")
} | dict.fromkeys(
    ("heat", "heat_flow", "sliding_distance", "surface_travel", "slip_count", "energy_residual"), ()
)


def complete(xml: bytes, table: list[dict]) -> bytes:
    """pythonfmu's modelDescription.xml with everything added; no date, so that builds repeat."""
    root = fromstring(xml)
    del root.attrib["generationDateAndTime"]
    variables = root.find("ModelVariables")
    known = _known(table)
    starts = {entry["name"]: entry["start"] for entry in table}
    for variable in variables:
        name = variable.get("name")
        _describe(variable, known[name], starts.get(name))
    used = {real.get("unit") for real in variables.iter("Real")}
    root.insert(list(root).index(root.find("CoSimulation")) + 1, _unit_definitions(used))
    root.remove(root.find("ModelStructure"))
    root.append(_structure([variable.get("name") for variable in variables]))
    for element in root.iter():
        element.text = element.tail = None
    indent(root)
    return tostring(root, encoding="UTF-8", xml_declaration=True)


def _known(table: list[dict]) -> dict[str, tuple]:
    parameters = {
        entry["name"]: tuple(entry[key] for key in ("unit", "nominal", "min", "max", "description"))
        for entry in table
    }
    return INPUTS | OUTPUTS | parameters


def _describe(variable: Element, known: tuple, exact_start: float | None) -> None:
    """Complete one variable. pythonfmu writes a start to 16 digits, which can miss the last bit."""
    unit, nominal, low, high, description = known
    variable.set("description", description)
    kind = variable[0]
    # In the order of the schema's documentation, start last.
    start = kind.attrib.pop("start", None)
    if exact_start is not None:
        start = repr(exact_start)
    for key, value in (("unit", unit), ("min", low), ("max", high), ("nominal", nominal)):
        if value is not None:
            kind.set(key, value if isinstance(value, str) else repr(value))
    if start is not None:
        kind.set("start", start)
    if kind.tag == "Real" and unit is None:
        raise ValueError(f'{variable.get("name")}: has no unit; "1" for a plain number')


def _unit_definitions(used: set[str]) -> Element:
    definitions = Element("UnitDefinitions")
    for name in sorted(used):
        unit = SubElement(definitions, "Unit", name=name)
        SubElement(unit, "BaseUnit", {key: repr(value) for key, value in UNITS[name].items()})
    return definitions


def _structure(names: list[str]) -> Element:
    """Outputs and initial unknowns with what they depend on.

    The outputs at a communication point are those of the end of the step that led there: an input
    set at the point acts in the next step. So no output depends directly on any input, and a host
    needs not fear an algebraic loop.
    """
    index = {name: str(position) for position, name in enumerate(names, start=1)}
    structure = Element("ModelStructure")
    outputs, initial = (SubElement(structure, tag) for tag in ("Outputs", "InitialUnknowns"))
    for name in OUTPUTS:
        SubElement(outputs, "Unknown", index=index[name], dependencies="")
        unknown = SubElement(initial, "Unknown", index=index[name])
        if name in STARTS:
            unknown.set("dependencies", " ".join(index[source] for source in STARTS[name]))
    return structure
