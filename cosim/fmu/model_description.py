"""What StickSlip3DOF declares: its parameters and ports, with units, ranges and structure."""

from __future__ import annotations

import pprint
import uuid
from collections.abc import Iterable
from math import pi
from typing import Any
from xml.etree.ElementTree import Element, SubElement, fromstring, indent, tostring

from stickslip import Parameters, ports
from stickslip.kernel import layout
from stickslip.ports import INPUTS, OUTPUTS, Port
from stickslip.quantity import details

Entry = dict[str, Any]

#: Parameters that the FMU shows otherwise than the parameter models do.
GUIDES: dict[str, Entry] = {
    key: {
        "unit": None,
        "nominal": None,
        "min": 0,
        "max": 1,
        "above_min": False,
        "description": f"1: the block can move in {motion}; 0: a guide keeps it from that",
    }
    for key, motion in (("free_y", "y"), ("free_phi", "phi"))
}
SPECIAL: dict[str, Entry] = {
    "rig.inertia": {
        "min": 0,
        "description": "moment of inertia about the vertical; 0: that of a disc, m a^2 / 2",
    },
    **{
        f"friction.table_{of}[{i + 1}]": {"min": 0}
        for of in ("speed", "mu")
        for i in range(layout.CURVE_LIMIT)
    },
}
DESCRIBED = ("name", "unit", "nominal", "min", "max", "description", "start")


def parameter_table() -> list[Entry]:
    """Every parameter of the FMU, with unit, bounds and description from the parameter models.

    One entry each: name, unit (None: an integer), nominal, min, max, above_min (whether min itself
    is excluded), description, start. Raises ValueError for a unit that `UNITS` lacks.
    """
    return [_entry(name, start) for name, start in Parameters().flat().items()]


def as_ports(table: list[Entry]) -> list[ports.Port]:
    """The parameters as the model description tells them."""
    return [ports.Port(slot="", **{key: entry[key] for key in DESCRIBED}) for entry in table]


def variables_module(table: list[Entry], content: str) -> bytes:
    """Text of the module that tells the slave what it is; ``content``: hash of the build."""
    values = {
        "BUILD": content,
        "GUID": str(uuid.uuid5(uuid.NAMESPACE_URL, f"StickSlip3DOF/{content}")),
        # (name, place in u, start) and (name, place in o, is an integer)
        "INPUTS": [(each.name, getattr(layout, each.slot), each.start) for each in ports.INPUTS],
        "OUTPUTS": [
            (each.name, getattr(layout, each.slot), each.unit is None) for each in ports.OUTPUTS
        ],
        "PARAMETERS": table,
    }
    lines = ['"""What this build of the FMU is, its ports and its parameters."""']
    for name, value in values.items():
        lines.append(f"{name} = {pprint.pformat(value, width=100, sort_dicts=False)}")
    return "\n".join(lines).encode() + b"\n"


def _entry(name: str, start: float) -> Entry:
    group, key = name.split(".")
    entry = {"name": name, "nominal": abs(start) or 1.0, "start": start} | GUIDES.get(key, {})
    if key in GUIDES:
        return entry | {"start": int(start)}
    table: Any = Parameters.model_fields[group].annotation
    field = table.model_fields[key.partition("[")[0]]
    bounds = {
        kind: getattr(bound, kind)
        for bound in field.metadata
        for kind in ("gt", "ge", "le")
        if getattr(bound, kind, None) is not None
    }
    whole = field.annotation is int
    unit = None if whole else details(field)["unit"]
    if unit is not None and unit not in UNITS:
        raise ValueError(
            f"effect or table {group}: {key} is in {unit!r}, a unit that UNITS of {__name__} lacks"
        )
    return (
        entry
        | ({"start": int(start), "nominal": None} if whole else {})
        | {
            "unit": unit,
            "min": bounds.get("gt", bounds.get("ge")),
            "max": bounds.get("le"),
            "above_min": "gt" in bounds,
            "description": field.description,
        }
        | SPECIAL.get(name, {})
    )


# FMI 2 unit name -> exponents of its base units, factor and offset; None: the exponents are not
# whole numbers, which FMI cannot state
UNITS: dict[str, dict[str, float] | None] = {
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
    "J/m3": {"kg": 1, "m": -1, "s": -2},
    "Pa": {"kg": 1, "m": -1, "s": -2},
    "Pa.s": {"kg": 1, "m": -1, "s": -1},
    "W.s0.5/(m2.K)": None,
    "W": {"kg": 1, "m": 2, "s": -3},
    "degC": {"K": 1, "offset": 273.15},
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
# Initial value of an output -> the parameters that it follows from. Totals start from zero;
# of the outputs not named here all parameters and inputs have a say.
STARTS: dict[str, tuple[str, ...]] = {
    name: (f"initial.{name}",) for name in ("x", "y", "phi", "vx", "vy", "omega")
} | dict.fromkeys(
    (
        "heat",
        "heat_flow",
        "damping_heat",
        "sliding_distance",
        "surface_travel",
        "slip_time",
        "slip_count",
        "energy_residual",
    ),
    (),
)


def complete(xml: bytes, parameters: Iterable[Port]) -> bytes:
    """pythonfmu's modelDescription.xml with everything added; no date, so that builds repeat."""
    root = fromstring(xml)
    del root.attrib["generationDateAndTime"]
    variables = _part(root, "ModelVariables")
    known = {port.name: port for port in (*INPUTS, *OUTPUTS, *parameters)}
    for variable in variables:
        _describe(variable, known[variable.attrib["name"]])
    used = {real.get("unit") for real in variables.iter("Real")}
    units = _unit_definitions(sorted(filter(None, used)))
    root.insert(list(root).index(_part(root, "CoSimulation")) + 1, units)
    root.remove(_part(root, "ModelStructure"))
    root.append(_structure([variable.attrib["name"] for variable in variables]))
    for element in root.iter():
        element.text = element.tail = None
    indent(root)
    return tostring(root, encoding="UTF-8", xml_declaration=True)


def _part(root: Element, tag: str) -> Element:
    part = root.find(tag)
    if part is None:
        raise ValueError(f"pythonfmu wrote a model description without {tag}")
    return part


def _describe(variable: Element, known: Port) -> None:
    """Complete one variable. pythonfmu writes a start to 16 digits, which can miss the last bit."""
    variable.set("description", known.description)
    kind = variable[0]
    kind.attrib.clear()
    for key in ("unit", "min", "max", "nominal", "start"):
        value = getattr(known, key)
        if value is not None:
            kind.set(key, value if isinstance(value, str) else repr(value))


def _unit_definitions(used: Iterable[str]) -> Element:
    definitions = Element("UnitDefinitions")
    for name in used:
        unit = SubElement(definitions, "Unit", name=name)
        base = UNITS[name]
        if base is not None:
            SubElement(unit, "BaseUnit", {key: repr(value) for key, value in base.items()})
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
    for port in OUTPUTS:
        SubElement(outputs, "Unknown", index=index[port.name], dependencies="")
        unknown = SubElement(initial, "Unknown", index=index[port.name])
        if port.name in STARTS:
            sources = (index[source] for source in STARTS[port.name])
            unknown.set("dependencies", " ".join(sources))
    return structure
