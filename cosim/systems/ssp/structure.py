"""SystemStructure.ssd as nested systems: elements, connectors, connections, bindings.

What is here is read as it stands; what it comes to, with all borders gone, is in `reader`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from typing import NamedTuple
from xml.etree.ElementTree import Element as Xml
from xml.etree.ElementTree import register_namespace

from cosim.coupling import Affine, UnitDefinition
from cosim.coupling.conversion import BASE_UNITS
from cosim.coupling.fmu.variables import NUMERIC
from cosim.systems.specification import SystemFault

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
#: Types of a connector or a value, in SSP 1.0 and 2.0.
TYPES = (*NUMERIC, "String", "Binary", "Clock")


#: Masters with a fixed step, of OMSimulator and of the OSP tools -> their key of it.
MASTERS = {"FixedStepMaster": "stepSize", "FixedStepAlgorithm": "baseStepSize"}


class Connector(NamedTuple):
    """A connector of a component or a system; kind and type as the file has them."""

    kind: str
    type: str
    unit: str | None
    is_array: bool


class Ends(NamedTuple):
    """A connection as it stands: element ("" for the system itself) and connector of both ends."""

    start: tuple[str, str]
    end: tuple[str, str]
    transformation: Affine = Affine()
    converts: bool = True

    def __str__(self) -> str:
        ends = (".".join(filter(None, end)) or "a nameless end" for end in self[:2])
        return " -> ".join(ends)


@dataclass(frozen=True)
class Element:
    """A unit, or a system. node: the XML, for its parameter bindings.

    source: of a unit, its file within the package, "" of a system. elements: of a system, by name,
    and what connects them.
    """

    node: Xml
    connectors: Mapping[str, Connector]
    source: str = ""
    elements: Mapping[str, Element] = field(default_factory=dict)
    connections: tuple[Ends, ...] = ()


def top_of(root: Xml) -> Element:
    """The outermost system below the root of an SSD."""
    if root.tag != tag("ssd:SystemStructureDescription"):
        raise SystemFault("is no SystemStructureDescription, allowed is one of SSP 1.0 or 2.0")
    top = root.find(tag("ssd:System"))
    if top is None:
        raise SystemFault("has no System, needed is one")
    return _system(top)


def tables_of(root: Xml) -> dict[str, dict[str, float]]:
    """What the file says of time and step, as the tables [run] and [coupling].

    The step is that of a master that the annotations name: OMSimulator's, or of the OSP tools.
    """
    experiments = root.findall(tag("ssd:DefaultExperiment"))[:1]
    masters = [node for node in root.iter() if local(node) in MASTERS][:1]
    return {
        "coupling": _numbers(masters, {key: "macro_step" for key in MASTERS.values()}),
        "run": _numbers(experiments, {"startTime": "start", "stopTime": "stop"}),
    }


def _numbers(nodes: list[Xml], keys: Mapping[str, str]) -> dict[str, float]:
    found = {keys[key]: _number(node, key) for node in nodes for key in keys if key in node.keys()}
    return found


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
        for base in below(unit, "ssc:BaseUnit"):
            exponents = tuple(int(_number(base, name)) for name in BASE_UNITS)
            factor = _number(base, "factor", 1.0)
            if factor == 0.0:
                raise SystemFault(f"unit {unit.get('name')!r} has factor = 0, allowed is another")
            definition = UnitDefinition(exponents, factor, _number(base, "offset"))
            found[unit.get("name", "")] = definition
    return found


def unit_of(node: Xml) -> str | None:
    """The unit that a connector or a value names; some tools put it in brackets, or name none."""
    return node.get("unit", "").strip().removeprefix("[").removesuffix("]").strip() or None


def transformation_of(node: Xml, what: str) -> Affine:
    """The linear transformation in a connection or a mapping; others are refused by name."""
    for child in node:
        name = local(child)
        if name == "LinearTransformation":
            return Affine(_number(child, "factor", 1.0), _number(child, "offset"))
        if name.endswith("Transformation"):
            raise SystemFault(f"{what}: {name} is not done here, allowed is LinearTransformation")
    return Affine()


def converts(node: Xml) -> bool:
    """Whether units are to be converted."""
    return node.get("suppressUnitConversion", "false").strip() not in ("true", "1")


def _system(node: Xml) -> Element:
    name = node.get("name", "")
    elements: dict[str, Element] = {}
    for found in (*below(node, "ssd:SignalDictionaries/*"), *below(node, "ssd:Elements/*")):
        kind, own = local(found), found.get("name", "")
        if kind in ("SignalDictionary", "SignalDictionaryReference"):
            raise SystemFault(
                f"{kind} {own!r} in system {name!r} is not done here;"
                " allowed are connections of the units themselves"
            )
        if own in elements:
            raise SystemFault(f"system {name!r} has two elements named {own!r}, allowed is one")
        elements[own] = _element(found, kind, own)
    connections = tuple(_ends(child) for child in below(node, "ssd:Connections/ssd:Connection"))
    return Element(node, _connectors(node), "", elements, connections)


def _element(node: Xml, kind: str, name: str) -> Element:
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
    return Element(node, _connectors(node), source)


def _connectors(node: Xml) -> dict[str, Connector]:
    found = {}
    for child in below(node, "ssd:Connectors/ssd:Connector"):
        form = next((inner for inner in child if local(inner) in TYPES), None)
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
    affine = transformation_of(node, f"connection {Ends(start, end)}")
    return Ends(start, end, affine, converts(node))


def _number(node: Xml, key: str, default: float = 0.0) -> float:
    text = node.get(key)
    if text is None:
        return default
    with suppress(ValueError):
        if math.isfinite(value := float(text)):
            return value
    raise SystemFault(f"{local(node)} has {key} = {text!r}, allowed is a finite number")
