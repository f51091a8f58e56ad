"""An SSP file as a system to be run: its nested systems as one.

Which unit's output comes to which unit's input, and what starts where. A connector of a system only
passes on: a value on its way through it is followed to where it comes from, and what a parameter
set gives to it goes to what it feeds.
"""

from collections.abc import Iterable, Iterator, Mapping
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import tostring

from cosim.coupling import UnitDefinition
from cosim.coupling.fmu.variables import NUMERIC
from cosim.names import unknown_name
from cosim.scenario.toml_file import changed_tables
from cosim.scenario.validation import checked
from cosim.systems.specification import (
    Hop,
    Link,
    Settings,
    Start,
    SystemFault,
    SystemSpecification,
    UnitEntry,
    naming,
)
from cosim.systems.ssp.package import Package
from cosim.systems.ssp.structure import Connector, Element, Ends, tables_of, top_of, units_of
from cosim.systems.ssp.values import bound_values

#: Names of the elements from the outermost system's to this one, without the outermost's.
Way = tuple[str, ...]
#: A connector: of what, and its name.
Node = tuple[Way, str]
#: Kinds that give a value to what they are connected with, seen from inside their element.
GIVES, TAKES = ("output", "calculatedParameter"), ("input", "parameter", "structuralParameter")


class Flat:
    """The units and links of a system. definitions: units of its file."""

    def __init__(self, top: Element, definitions: Mapping[str, UnitDefinition], package: Package):
        self._definitions, self._package = definitions, package
        #: Components and systems.
        self._elements: dict[Way, Element] = {}
        #: What comes to a connector: from where, and by which connection.
        self._feeds: dict[Node, tuple[Node, Ends]] = {}
        self._walk((), top)
        self._names = _names(path for path, one in self._elements.items() if one.source)

    def units(self) -> list[UnitEntry]:
        """All components, with what they start from."""
        given = self._all_given()
        return [
            UnitEntry(
                name=own,
                file=self._package.file(self._elements[path].source),
                given={name: start for (owner, name), start in given.items() if owner == path},
                ports={
                    name: (connector.unit, self._definitions.get(connector.unit))
                    for name, connector in self._elements[path].connectors.items()
                    if connector.unit is not None
                },
            )
            for path, own in self._names.items()
        ]

    def links(self) -> list[Link]:
        """What comes to the inputs of components from outputs of components."""
        found = []
        for node in self._feeds:
            if self._is_of_unit(node) and self._connector(node).kind == "input":
                *_, (source, hops) = self._behind(node)
                if self._is_of_unit(source):
                    found.append(Link(self._address(source), self._address(node), tuple(hops)))
        return found

    def _walk(self, path: Way, element: Element) -> None:
        self._elements[path] = element
        for name, inner in element.elements.items():
            self._walk((*path, name), inner)
        for ends in element.connections:
            source, sink = (
                ((*path, *filter(None, [owner])), name) for owner, name in _directed(element, ends)
            )
            if sink in self._feeds:
                raise SystemFault(
                    f"connection {ends}: {_spelled(sink)} is fed twice,"
                    " allowed is one connection to an input"
                )
            self._feeds[sink] = source, ends

    def _behind(self, node: Node) -> Iterator[tuple[Node, list[Hop]]]:
        """From where a value comes, farther and farther back, and the hops that it makes from there
        on."""
        seen: set[Node] = set()
        hops: list[Hop] = []
        while node in self._feeds and node not in seen and not (hops and self._is_of_unit(node)):
            seen.add(node)
            (source, ends), unit = self._feeds[node], self._connector(node).unit
            definition = self._definitions.get(unit or "")
            hops = [Hop(ends.transformation, ends.converts, unit, definition), *hops]
            node = source
            yield node, hops

    def _is_of_unit(self, node: Node) -> bool:
        return node[0] in self._names

    def _connector(self, node: Node) -> Connector:
        path, name = node
        return self._elements[path].connectors[name]

    def _address(self, node: Node) -> str:
        """`unit.port` of a connector that can be coupled."""
        connector = self._connector(node)
        for wrong, what, allowed in (
            (connector.type not in NUMERIC, f"a {connector.type}", "numbers"),
            (connector.is_array, "an array", "its elements"),
            (connector.kind not in ("input", "output"), f"a {connector.kind}", "input and output"),
        ):
            if wrong:
                raise SystemFault(
                    f"connector {_spelled(node)} is {what}, which is not coupled here,"
                    f" allowed are {allowed}"
                )
        return f"{self._names[node[0]]}.{node[1]}"

    def _all_given(self) -> dict[Node, Start]:
        """What every connector and variable starts from; outer bindings count more than inner."""
        found: dict[Node, Start] = {}
        # from the innermost outwards, so that what comes later counts
        for path in sorted(self._elements, key=lambda path: (path not in self._names, -len(path))):
            system = self._elements[path]
            for name, start, place in bound_values(system.node, self._package, self._definitions):
                targets = [*self._targets(path, name)]
                if not targets:
                    inner = ((f"{n}.", each.connectors) for n, each in system.elements.items())
                    levels = [("", system.connectors), *inner]
                    known = [before + own for before, connectors in levels for own in connectors]
                    raise SystemFault(
                        f"{place}: {unknown_name('variable of the system', name, known)}"
                    )
                found |= dict.fromkeys(targets, start)
        return found | self._passed_on(found)

    def _targets(self, path: Way, name: str) -> Iterator[Node]:
        """All connectors and variables that a name means, seen from a component or a system."""
        element = self._elements[path]
        if element.source or name in element.connectors:
            yield path, name
        for dot in (place for place, letter in enumerate(name) if letter == "."):
            if name[:dot] in element.elements:
                yield from self._targets((*path, name[:dot]), name[dot + 1 :])

    def _passed_on(self, given: dict[Node, Start]) -> dict[Node, Start]:
        """What a system's connector starts from, to the inputs and parameters that it feeds."""
        found = {}
        for node, (_, ends) in self._feeds.items():
            if not self._is_of_unit(node):
                continue
            for passed, hops in self._behind(node):
                if passed in given and not self._is_of_unit(passed):
                    affine = given[passed].transformation
                    for hop in hops:
                        affine = affine.then(hop.transformation)
                    found[node] = replace(given[passed], transformation=affine)
                    break
            else:
                if self._is_of_unit(passed) and self._connector(node).kind != "input":
                    raise SystemFault(
                        f"connection {ends}: a parameter that another unit computes is not"
                        " done here, allowed are inputs"
                    )
        return found


def _directed(system: Element, ends: Ends) -> tuple[tuple[str, str], tuple[str, str]]:
    """Both ends of a connection, first that which gives, whichever the file puts first."""
    start_gives, end_gives = (_gives(system, ends, end) for end in (ends.start, ends.end))
    if start_gives == end_gives:
        raise SystemFault(
            f"connection {ends}: both ends {'give' if end_gives else 'take'}, allowed is"
            " an output to an input"
        )
    return (ends.start, ends.end) if start_gives else (ends.end, ends.start)


def _gives(system: Element, ends: Ends, end: tuple[str, str]) -> bool:
    """Whether an end of a connection is one that gives; SystemFault where there is none such."""
    element, name = end
    owner = system.elements.get(element) if element else system
    if owner is None:
        known = unknown_name("element", element, system.elements)
        raise SystemFault(f"connection {ends}: {known}")
    if name not in owner.connectors:
        known = unknown_name("connector", name, owner.connectors)
        raise SystemFault(f"connection {ends}: {known}")
    kind = owner.connectors[name].kind
    if kind not in GIVES + TAKES:
        raise SystemFault(
            f"connection {ends}: a connector of kind {kind} is not connected here,"
            " allowed are input and output"
        )
    # an input of the system gives to what is in it
    return (kind in GIVES) is bool(element)


def _spelled(node: Node) -> str:
    return ".".join((*node[0], node[1]))


def _names(paths: Iterable[Way]) -> dict[Way, str]:
    """Component -> its name as a participant: without dots, and no two the same."""
    found: dict[Way, str] = {}
    for path in paths:
        name = "_".join(path).replace(".", "_").replace("/", "_")
        while name in found.values():
            name += "_"
        found[path] = name
    return found


def read_ssp(path: Path, changes: Mapping[str, Any]) -> SystemSpecification:
    """The system in an SSP, or in a folder or structure file of the same contents.

    changes: `table.key` -> value of the tables [coupling] and [run], which an SSP does not have.
    Raises SystemFault in one line: file, element, what is wrong, what is allowed.
    """
    with ExitStack() as unpacked, naming(str(path)):
        package = Package(path)
        unpacked.callback(package.close)
        root = package.xml(package.structure)
        with naming(package.structure):
            top, definitions, said = top_of(root), units_of(root, "ssd"), tables_of(root)
        flat = Flat(top, definitions, package)
        tables = changed_tables(said, changes)
        settings = checked(Settings, tables)
        units = flat.units()
        if not units:
            raise SystemFault(f"{package.structure}: has no component, needed is one at least")
        variants = [
            f"{path}: {name} is another variant; {package.structure} is run"
            for name in package.others()
        ]
        return SystemSpecification(
            name=root.get("name") or top.node.get("name") or "system",
            source=str(path),
            units=units,
            links=flat.links(),
            coupling=settings.coupling,
            run=settings.run,
            text=tostring(root, encoding="unicode"),
            remarks=(*package.remarks, *variants),
            _held=unpacked.pop_all(),
        )
