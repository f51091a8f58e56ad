"""SystemStructure.ssd as nested systems: elements, connectors, connections, bindings.

What is here is read as it stands; what it comes to, with all borders gone, is in `flat`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from xml.etree.ElementTree import Element as Xml
from xml.etree.ElementTree import register_namespace

from cosim.coupling import Affine, UnitDefinition
from cosim.coupling.conversion import BASE_UNITS
from cosim.systems.system_errors import SystemFault, naming

_NAMES = {
    **{"ssc": "Common", "ssd": "Description"},
    **{"ssv": "ParameterValues", "ssm": "ParameterMapping"},
}
_SPACES = {
    prefix: f"http://ssp-standard.org/SSP1/SystemStructure{name}" for prefix, name in _NAMES.items()
}
for _prefix, _space in _SPACES.items():
    register_namespace(_prefix, _space)
FMU = "application/x-fmu-sharedlibrary"
#: Types of a connector or a value that are numbers, in SSP 1.0 and 2.0.
REALS = ("Real", "Float64", "Float32")
INTEGERS = ("Integer", *(f"{sign}Int{bits}" for sign in ("", "U") for bits in (8, 16, 32, 64)))
NUMBERS = (*REALS, *INTEGERS, "Boolean", "Enumeration")
TYPES = (*NUMBERS, "String", "Binary", "Clock")


#: Masters with a fixed step, of OMSimulator and of the OSP tools -> their key of it.
MASTERS = {"FixedStepMaster": "stepSize", "FixedStepAlgorithm": "baseStepSize"}


@dataclass(frozen=True)
class Connector:
    """A connector of a component or a system; kind and type as the file has them."""

    kind: str
    type: str
    unit: str | None
    is_array: bool


@dataclass(frozen=True)
class Ends:
    """A connection as it stands: element ("" for the system itself) and connector of both ends."""

    start: tuple[str, str]
    end: tuple[str, str]
    transformation: Affine
    converts: bool

    def __str__(self) -> str:
        return " -> ".join(
            ".".join(filter(None, end)) or "a nameless end" for end in (self.start, self.end)
        )


@dataclass(frozen=True)
class Element:
    """A unit, or a system. node: the XML, for its parameter bindings.

    source: of a unit, its file within the package, "" of a system. elements: of a system, by name,
    and what connects them.
    """

    name: str
    connectors: Mapping[str, Connector]
    node: Xml
    source: str = ""
    elements: Mapping[str, Element] = field(default_factory=dict)
    connections: tuple[Ends, ...] = ()


@dataclass(frozen=True)
class Structure:
    """The whole file. start, stop, step: s, None where it names none."""

    name: str
    system: Element
    units: Mapping[str, UnitDefinition]
    start: float | None
    stop: float | None
    step: float | None


def read_structure(root: Xml, place: str) -> Structure:
    """What the root of an SSD says; SystemFault, with the place, by the name of what cannot be."""
    if root.tag != tag("ssd:SystemStructureDescription"):
        raise SystemFault(
            f"{place}: is no SystemStructureDescription, allowed is one of SSP 1.0 or 2.0"
        )
    top = root.find(tag("ssd:System"))
    if top is None:
        raise SystemFault(f"{place}: has no System, needed is one")
    experiment = root.find(tag("ssd:DefaultExperiment"))
    with naming(place):
        return Structure(
            name=root.get("name") or top.get("name") or "system",
            system=_system(top),
            units=units_of(root, "ssd"),
            start=_number(experiment, "startTime"),
            stop=_number(experiment, "stopTime"),
            step=_step(root),
        )


def tag(name: str) -> str:
    """`ssd:System` as ElementTree spells it."""
    prefix, _, local = name.rpartition(":")
    return f"{{{_SPACES[prefix]}}}{local}" if prefix else local


def below(node: Xml, path: str) -> Iterator[Xml]:
    """Elements at a path such as `ssd:Elements/ssd:Component`."""
    yield from node.iterfind("/".join(map(tag, path.split("/"))))


def local(node: Xml) -> str:
    """The name of an element without its namespace."""
    return node.tag.rpartition("}")[2]


def units_of(root: Xml, space: str) -> dict[str, UnitDefinition]:
    """Unit -> what it is made of, of the Units of a file."""
    found = {}
    for unit in below(root, f"{space}:Units/ssc:Unit"):
        base = unit.find(tag("ssc:BaseUnit"))
        if base is not None:
            exponents = tuple(int(_finite(base, name, 0.0)) for name in BASE_UNITS)
            factor = _finite(base, "factor", 1.0)
            if factor == 0.0:
                raise SystemFault(f"unit {unit.get('name')!r} has factor = 0, allowed is another")
            found[unit.get("name", "")] = UnitDefinition(
                exponents,  # type: ignore[arg-type]  # eight of them
                factor,
                _finite(base, "offset", 0.0),
            )
    return found


def unit_of(node: Xml) -> str | None:
    """The unit that a connector or a value names; some tools put it in brackets, or name none."""
    return node.get("unit", "").strip().removeprefix("[").removesuffix("]").strip() or None


def transformation_of(node: Xml, what: str) -> Affine:
    """The linear transformation in a connection or a mapping; others are refused by name."""
    for child in node:
        name = local(child)
        if name == "LinearTransformation":
            return Affine(_finite(child, "factor", 1.0), _finite(child, "offset", 0.0))
        if name.endswith("Transformation"):
            raise SystemFault(f"{what}: {name} is not done here, allowed is LinearTransformation")
    return Affine()


def converts(node: Xml) -> bool:
    """Whether units are to be converted."""
    return node.get("suppressUnitConversion", "false").strip() not in ("true", "1")


def _system(node: Xml) -> Element:
    name = node.get("name", "")
    for found in (*below(node, "ssd:SignalDictionaries/*"), *below(node, "ssd:Elements/*")):
        if local(found) in ("SignalDictionary", "SignalDictionaryReference"):
            raise SystemFault(
                f"{local(found)} {found.get('name', '')!r} in system {name!r} is not done here;"
                " allowed are connections of the units themselves"
            )
    elements: dict[str, Element] = {}
    for element in map(_element, below(node, "ssd:Elements/*")):
        if element.name in elements:
            raise SystemFault(
                f"system {name!r} has two elements named {element.name!r}, allowed is one"
            )
        elements[element.name] = element
    connections = tuple(_ends(child) for child in below(node, "ssd:Connections/ssd:Connection"))
    return Element(name, _connectors(node), node, "", elements, connections)


def _element(node: Xml) -> Element:
    kind, name = local(node), node.get("name", "")
    if not name:
        raise SystemFault(f"a {kind} has no name, needed is one")
    if kind == "System":
        return _system(node)
    if kind != "Component":
        raise SystemFault(f"{kind} {name!r} is not done here, allowed are Component and System")
    form, source = node.get("type", FMU), node.get("source", "")
    if form != FMU:
        raise SystemFault(f"component {name!r} is of type {form}, allowed is {FMU}")
    if node.get("implementation", "any") not in ("any", "CoSimulation"):
        raise SystemFault(
            f"component {name!r} asks for {node.get('implementation')}, which is not done here; "
            "allowed is CoSimulation"
        )
    if not source:
        raise SystemFault(f"component {name!r} has no source, needed is the path of an FMU")
    return Element(name, _connectors(node), node, source)


def _connectors(node: Xml) -> dict[str, Connector]:
    found = {}
    for child in below(node, "ssd:Connectors/ssd:Connector"):
        kinds = [inner for inner in child if local(inner) in TYPES]
        form = kinds[0] if kinds else None
        found[child.get("name", "")] = Connector(
            kind=child.get("kind", "unspecified"),
            type="Real" if form is None else local(form),
            unit=None if form is None else unit_of(form),
            is_array=any(local(inner) == "Dimension" for inner in child),
        )
    return found


def _ends(node: Xml) -> Ends:
    start, end = (
        (node.get(f"{side}Element", ""), node.get(f"{side}Connector", ""))
        for side in ("start", "end")
    )
    bare = Ends(start, end, Affine(), converts(node))
    return replace(bare, transformation=transformation_of(node, f"connection {bare}"))


def _number(node: Xml | None, key: str) -> float | None:
    text = None if node is None else node.get(key)
    if node is None or text is None:
        return None
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise SystemFault(f"{local(node)} has {key} = {text!r}, allowed is a finite number")
    return value


def _finite(node: Xml, key: str, default: float) -> float:
    value = _number(node, key)
    return default if value is None else value


def _step(root: Xml) -> float | None:
    """The step of a master that the annotations name: OMSimulator's, or that of the OSP tools."""
    for node in root.iter():
        if local(node) in MASTERS:
            return _number(node, MASTERS[local(node)])
    return None
