"""Nested systems as one: which unit's output comes to which unit's input, and what starts where.

A connector of a system only passes on: a value on its way through it is followed to where it comes
from, and what a parameter set gives to it goes to what it feeds.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

from cosim.coupling import UnitDefinition
from cosim.names import unknown_name
from cosim.systems.specification import Hop, Link, Start, UnitEntry
from cosim.systems.ssp.package import Package
from cosim.systems.ssp.structure import NUMBERS, Connector, Element, Ends, Structure
from cosim.systems.ssp.values import Bound, bound_values
from cosim.systems.system_errors import SystemFault

#: Names of the elements from the outermost system's to this one, without the outermost's.
Path = tuple[str, ...]
#: A connector: of what, and its name.
Node = tuple[Path, str]
#: Kinds that give a value to what they are connected with, seen from inside their element.
GIVES, TAKES = ("output", "calculatedParameter"), ("input", "parameter", "structuralParameter")


@dataclass(frozen=True)
class Feed:
    """What comes to a connector: from where, and the connection that it comes by."""

    source: Node
    ends: Ends


class Flat:
    """The units and links of a structure."""

    def __init__(self, structure: Structure, package: Package):
        self._structure, self._package = structure, package
        self._components: dict[Path, Element] = {}
        self._systems: dict[Path, Element] = {}
        self._feeds: dict[Node, Feed] = {}
        self._walk((), structure.system)
        self._names = _names(self._components)

    def units(self) -> list[UnitEntry]:
        """All components, with what they start from."""
        given = self._all_given()
        return [
            UnitEntry(
                name=self._names[path],
                file=self._package.file(component.source),
                given=given[path],
                ports={
                    connector.name: (connector.unit, self._definition(connector.unit))
                    for connector in component.connectors.values()
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
                for end in (source, node):
                    self._check_kind(end)
                found.append(Link(self._address(source), self._address(node), tuple(hops)))
        return found

    def _walk(self, path: Path, system: Element) -> None:
        self._systems[path] = system
        for name, element in system.elements.items():
            if element.source:
                self._components[(*path, name)] = element
            else:
                self._walk((*path, name), element)
        for ends in system.connections:
            self._add(path, system, ends)

    def _add(self, path: Path, system: Element, ends: Ends) -> None:
        """Note a connection by the end that it feeds, whichever end the file puts first."""
        nodes = []
        for element, name in (ends.start, ends.end):
            owner = system if not element else system.elements.get(element)
            if owner is None:
                known = list(system.elements)
                raise SystemFault(f"connection {ends}: {unknown_name('element', element, known)}")
            if name not in owner.connectors:
                known = list(owner.connectors)
                raise SystemFault(f"connection {ends}: {unknown_name('connector', name, known)}")
            kind = owner.connectors[name].kind
            if kind not in GIVES + TAKES:
                raise SystemFault(
                    f"connection {ends}: a connector of kind {kind} is not connected here,"
                    " allowed are input and output"
                )
            # an input of the system gives to what is in it
            gives = (kind in GIVES) is bool(element)
            nodes.append((((*path, element) if element else path, name), gives))
        (start, start_gives), (end, end_gives) = nodes
        if start_gives == end_gives:
            raise SystemFault(
                f"connection {ends}: both ends {'give' if end_gives else 'take'}, allowed is"
                " an output to an input"
            )
        source, sink = (start, end) if start_gives else (end, start)
        if sink in self._feeds:
            raise SystemFault(
                f"connection {ends}: {'.'.join((*sink[0], sink[1]))} is fed twice,"
                " allowed is one connection to an input"
            )
        self._feeds[sink] = Feed(source, ends)

    def _behind(self, node: Node) -> Iterator[tuple[Node, list[Hop]]]:
        """From where a value comes, farther and farther back, and the hops that it makes from there
        on."""
        seen: set[Node] = set()
        hops: list[Hop] = []
        while node in self._feeds and node not in seen:
            seen.add(node)
            feed, unit = self._feeds[node], self._connector(node).unit
            ends, definition = feed.ends, self._definition(unit)
            hops = [Hop(ends.transformation, ends.converts, unit, definition), *hops]
            node = feed.source
            yield node, hops
            if node[0] in self._components:
                return

    def _definition(self, unit: str | None) -> UnitDefinition | None:
        return None if unit is None else self._structure.units.get(unit)

    def _connector(self, node: Node) -> Connector:
        path, name = node
        owner = self._components.get(path) or self._systems[path]
        return owner.connectors[name]

    def _address(self, node: Node) -> str:
        return f"{self._names[node[0]]}.{node[1]}"

    def _check_kind(self, node: Node) -> None:
        connector = self._connector(node)
        where = ".".join((*node[0], node[1]))
        if connector.type not in NUMBERS:
            raise SystemFault(
                f"connector {where} is a {connector.type}, which is not coupled here,"
                " allowed are numbers"
            )
        if connector.is_array:
            raise SystemFault(
                f"connector {where} is an array, which is not coupled here,"
                " allowed are its elements"
            )
        if connector.kind not in ("input", "output"):
            raise SystemFault(
                f"connector {where} is a {connector.kind}, which is not coupled here,"
                " allowed are input and output"
            )

    def _all_given(self) -> dict[Path, dict[str, Start]]:
        """Component -> variable -> what it starts from; outer bindings count more than inner."""
        found: dict[Path, dict[str, Start]] = {path: {} for path in self._components}
        borders: dict[Node, Start] = {}
        # from the innermost system outwards, so that what comes later counts
        for path in sorted(self._components, key=len, reverse=True):
            for bound in self._bound(path):
                found[path][bound.name] = bound.start
        for path in sorted(self._systems, key=len, reverse=True):
            for bound in self._bound(path):
                targets = list(self._targets(path, bound.name))
                if not targets:
                    known = self._known_names(path)
                    unknown = unknown_name("variable of the system", bound.name, known)
                    raise SystemFault(f"{bound.place}: {unknown}")
                for owner, name in targets:
                    if owner in found:
                        found[owner][name] = bound.start
                    else:
                        borders[owner, name] = bound.start
        self._pass_on(borders, found)
        return found

    def _bound(self, path: Path) -> Iterator[Bound]:
        owner = self._components.get(path) or self._systems[path]
        return bound_values(owner.node, self._package, self._structure.units)

    def _targets(self, path: Path, name: str) -> Iterator[Node]:
        """All connectors and variables that a name means, seen from a system."""
        system = self._systems[path]
        if name in system.connectors:
            yield path, name
        for dot in (place for place, letter in enumerate(name) if letter == "."):
            element, rest = name[:dot], name[dot + 1 :]
            if element not in system.elements:
                continue
            inner = (*path, element)
            if inner in self._components:
                yield inner, rest
            else:
                yield from self._targets(inner, rest)

    def _known_names(self, path: Path) -> list[str]:
        system = self._systems[path]
        known = list(system.connectors)
        for name, element in system.elements.items():
            known += [f"{name}.{connector}" for connector in element.connectors]
        return known

    def _pass_on(self, borders: Mapping[Node, Start], found: dict[Path, dict[str, Start]]) -> None:
        """What a system's connector starts from, to the inputs and parameters that it feeds."""
        for node, feed in self._feeds.items():
            if node[0] not in self._components:
                continue
            for passed, hops in self._behind(node):
                if passed in borders:
                    found[node[0]][node[1]] = _moved(borders[passed], hops)
                    break
            else:
                if passed[0] in self._components and self._connector(node).kind != "input":
                    raise SystemFault(
                        f"connection {feed.ends}: a parameter that another unit computes is not"
                        " done here, allowed are inputs"
                    )


def _moved(start: Start, hops: Iterable[Hop]) -> Start:
    """A value behind some connections that scale it."""
    affine = start.transformation
    for hop in hops:
        affine = affine.then(hop.transformation)
    return replace(start, transformation=affine)


def _names(paths: Iterable[Path]) -> dict[Path, str]:
    """Component -> its name as a participant: without dots, and no two the same."""
    found: dict[Path, str] = {}
    taken: set[str] = set()
    for path in paths:
        name = "_".join(path).replace(".", "_").replace("/", "_")
        while name in taken:
            name += "_"
        found[path] = name
        taken.add(name)
    return found
