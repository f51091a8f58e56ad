"""Nested systems as one: which unit's output comes to which unit's input, and what starts where.

A connector of a system only passes on: a value on its way through it is followed to where it comes
from, and what a parameter set gives to it goes to what it feeds.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from cosim.coupling import UnitDefinition
from cosim.names import unknown_name
from cosim.systems.specification import Hop, Link, Start, UnitEntry
from cosim.systems.ssp.package import Package
from cosim.systems.ssp.structure import NUMBERS, Connector, Element, Ends, Structure
from cosim.systems.ssp.values import bound_values
from cosim.systems.system_errors import SystemFault

#: Names of the elements from the outermost system's to this one, without the outermost's.
Path = tuple[str, ...]
#: A connector: of what, and its name.
Node = tuple[Path, str]
#: Kinds that give a value to what they are connected with, seen from inside their element.
GIVES, TAKES = ("output", "calculatedParameter"), ("input", "parameter", "structuralParameter")


class Flat:
    """The units and links of a structure."""

    def __init__(self, structure: Structure, package: Package):
        self._structure, self._package = structure, package
        #: Components and systems.
        self._elements: dict[Path, Element] = {}
        #: What comes to a connector: from where, and by which connection.
        self._feeds: dict[Node, tuple[Node, Ends]] = {}
        self._walk((), structure.system)
        self._components = {path: one for path, one in self._elements.items() if one.source}
        self._names = _names(self._components)

    def units(self) -> list[UnitEntry]:
        """All components, with what they start from."""
        given = self._all_given()
        return [
            UnitEntry(
                name=self._names[path],
                file=self._package.file(component.source),
                given={name: start for (owner, name), start in given.items() if owner == path},
                ports={
                    name: (connector.unit, self._definition(connector.unit))
                    for name, connector in component.connectors.items()
                    if connector.unit is not None
                },
            )
            for path, component in self._components.items()
        ]

    def links(self) -> list[Link]:
        """What comes to the inputs of components from outputs of components."""
        found = []
        for node in self._feeds:
            if node[0] not in self._components or self._connector(node).kind != "input":
                continue
            *_, (source, hops) = self._behind(node)
            if source[0] in self._components:
                self._check_kind(source)
                self._check_kind(node)
                found.append(Link(self._address(source), self._address(node), tuple(hops)))
        return found

    def _walk(self, path: Path, element: Element) -> None:
        self._elements[path] = element
        for name, inner in element.elements.items():
            self._walk((*path, name), inner)
        for ends in element.connections:
            self._add(path, element, ends)

    def _add(self, path: Path, system: Element, ends: Ends) -> None:
        """Note a connection by the end that it feeds, whichever end the file puts first."""
        start_gives, end_gives = (_gives(system, ends, end) for end in (ends.start, ends.end))
        if start_gives == end_gives:
            raise SystemFault(
                f"connection {ends}: both ends {'give' if end_gives else 'take'}, allowed is"
                " an output to an input"
            )
        sides = (ends.start, ends.end) if start_gives else (ends.end, ends.start)
        source, sink = (((*path, *filter(None, [element])), name) for element, name in sides)
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
            hops = [Hop(ends.transformation, ends.converts, unit, self._definition(unit)), *hops]
            node = source
            yield node, hops

    def _is_of_unit(self, node: Node) -> bool:
        return node[0] in self._components

    def _definition(self, unit: str | None) -> UnitDefinition | None:
        return None if unit is None else self._structure.units.get(unit)

    def _connector(self, node: Node) -> Connector:
        path, name = node
        return self._elements[path].connectors[name]

    def _address(self, node: Node) -> str:
        return f"{self._names[node[0]]}.{node[1]}"

    def _check_kind(self, node: Node) -> None:
        connector = self._connector(node)
        for wrong, what, allowed in (
            (connector.type not in NUMBERS, f"a {connector.type}", "numbers"),
            (connector.is_array, "an array", "its elements"),
            (connector.kind not in ("input", "output"), f"a {connector.kind}", "input and output"),
        ):
            if wrong:
                raise SystemFault(
                    f"connector {_spelled(node)} is {what}, which is not coupled here,"
                    f" allowed are {allowed}"
                )

    def _all_given(self) -> dict[Node, Start]:
        """What every connector and variable starts from; outer bindings count more than inner."""
        found: dict[Node, Start] = {}
        # from the innermost system outwards, so that what comes later counts
        inwards = sorted(self._elements, key=len, reverse=True)
        for path in sorted(inwards, key=lambda path: path not in self._components):
            node = self._elements[path].node
            for name, start, place in bound_values(node, self._package, self._structure.units):
                targets = [*self._targets(path, name)]
                if not targets:
                    known = self._known_names(path)
                    raise SystemFault(
                        f"{place}: {unknown_name('variable of the system', name, known)}"
                    )
                found |= dict.fromkeys(targets, start)
        return found | self._passed_on(found)

    def _targets(self, path: Path, name: str) -> Iterator[Node]:
        """All connectors and variables that a name means, seen from a component or a system."""
        element = self._elements[path]
        if element.source or name in element.connectors:
            yield path, name
        for dot in (place for place, letter in enumerate(name) if letter == "."):
            if name[:dot] in element.elements:
                yield from self._targets((*path, name[:dot]), name[dot + 1 :])

    def _known_names(self, path: Path) -> list[str]:
        system = self._elements[path]
        known = list(system.connectors)
        for name, element in system.elements.items():
            known += [f"{name}.{connector}" for connector in element.connectors]
        return known

    def _passed_on(self, given: dict[Node, Start]) -> dict[Node, Start]:
        """What a system's connector starts from, to the inputs and parameters that it feeds."""
        found = {}
        for node, (_, ends) in self._feeds.items():
            if not self._is_of_unit(node):
                continue
            for passed, hops in self._behind(node):
                if passed in given and not self._is_of_unit(passed):
                    found[node] = _moved(given[passed], hops)
                    break
            else:
                if self._is_of_unit(passed) and self._connector(node).kind != "input":
                    raise SystemFault(
                        f"connection {ends}: a parameter that another unit computes is not"
                        " done here, allowed are inputs"
                    )
        return found


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


def _moved(start: Start, hops: Iterable[Hop]) -> Start:
    """A value behind some connections that scale it."""
    affine = start.transformation
    for hop in hops:
        affine = affine.then(hop.transformation)
    return replace(start, transformation=affine)


def _names(paths: Iterable[Path]) -> dict[Path, str]:
    """Component -> its name as a participant: without dots, and no two the same."""
    found: dict[Path, str] = {}
    for path in paths:
        name = "_".join(path).replace(".", "_").replace("/", "_")
        while name in found.values():
            name += "_"
        found[path] = name
    return found
