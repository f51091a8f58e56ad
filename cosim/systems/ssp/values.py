"""Parameter bindings: sets of values (ssv), and how their names are mapped (ssm)."""

import math
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from xml.etree.ElementTree import Element

from cosim.coupling import UnitDefinition
from cosim.coupling.fmu.variables import INTEGERS, REALS
from cosim.systems.specification import Start, SystemFault
from cosim.systems.ssp.package import Package
from cosim.systems.ssp.structure import (
    below,
    converts,
    local,
    tag,
    transformation_of,
    unit_of,
    units_of,
)

SET, MAPPING = "application/x-ssp-parameter-set", "application/x-ssp-parameter-mapping"
TRUTH = {"true": True, "1": True, "false": False, "0": False}


def bound_values(
    node: Element, package: Package, units: Mapping[str, UnitDefinition]
) -> Iterator[tuple[str, Start, str]]:
    """All that the bindings of a component or a system give: a name, seen from there, what it
    starts from, and where that stands, for messages. In their order: later ones count.

    units: of the structure file, for sets that have none of their own.
    """
    for binding in below(node, "ssd:ParameterBindings/ssd:ParameterBinding"):
        given, place = _set(binding, package, units)
        prefix = binding.get("prefix", "")
        named = {prefix + name: start for name, start in given.items()}
        for name, start in _mapped(binding, named, package, place):
            yield name, start, place


def _set(
    binding: Element, package: Package, units: Mapping[str, UnitDefinition]
) -> tuple[dict[str, Start], str]:
    """Name -> value of the set of a binding, and where it stands."""
    _check_form(binding, SET, "parameter set")
    source = binding.get("source")
    if source:
        root, place = package.xml(source), source
    else:
        inline = next(below(binding, "ssd:ParameterValues/ssv:ParameterSet"), None)
        if inline is None:
            return {}, "a binding without values"
        root, place = inline, f"the set {inline.get('name', '')!r}"
    if root.tag != tag("ssv:ParameterSet"):
        raise SystemFault(f"{place} is no ParameterSet, allowed is one")
    known = {**units, **units_of(root, "ssv")}
    found = {}
    for parameter in below(root, "ssv:Parameters/ssv:Parameter"):
        name = parameter.get("name", "")
        found[name] = _value(parameter, known, f"{name!r} of {place}")
    return found, place


def _mapped(
    binding: Element, given: Mapping[str, Start], package: Package, place: str
) -> Iterator[tuple[str, Start]]:
    """Names and values as the mapping has them; as they are, without one."""
    mapping = binding.find(tag("ssd:ParameterMapping"))
    if mapping is None:
        yield from given.items()
        return
    _check_form(mapping, MAPPING, "parameter mapping")
    source = mapping.get("source")
    root = package.xml(source) if source else mapping.find(tag("ssm:ParameterMapping"))
    if root is None or root.tag != tag("ssm:ParameterMapping"):
        raise SystemFault(
            f"the mapping {source or 'inside the binding'} is no ParameterMapping, allowed is one"
        )
    for entry in below(root, "ssm:MappingEntry"):
        name, target = entry.get("source", ""), entry.get("target", "")
        what = f"the mapping of {name!r} to {target!r}"
        if not name:
            continue  # of a tool that lists all targets, those that get nothing
        if name not in given:
            raise SystemFault(f"{what}: {place} has no such value, allowed are those that it has")
        affine, start = transformation_of(entry, what), given[name]
        if not affine.is_identity and isinstance(start.value, (bool, str)):
            raise SystemFault(f"{what} scales what is no number, allowed are numbers")
        yield target, replace(start, transformation=affine, converts=converts(entry))


def _check_form(node: Element, form: str, what: str) -> None:
    if node.get("type", form) != form:
        raise SystemFault(f"a {what} of type {node.get('type')} is not read, allowed is {form}")
    if node.get("sourceBase", "SSD") != "SSD":
        raise SystemFault(
            f"the {what} {node.get('source', '')!r} is to be found from its "
            f"{node.get('sourceBase')}, which is not done here; allowed is sourceBase = SSD"
        )


def _value(parameter: Element, units: Mapping[str, UnitDefinition], what: str) -> Start:
    about = ("Annotations", "MetaData", "Dimension")
    child = next((each for each in parameter if local(each) not in about), None)
    if child is None or (text := child.get("value")) is None:
        raise SystemFault(f"{what} has no value, needed is one")
    form = local(child)
    if form in REALS or form in INTEGERS:
        unit = unit_of(child)
        return Start(_numeric(text, form, what), unit, units.get(unit or ""))
    if form == "Boolean":
        if text.strip() not in TRUTH:
            raise SystemFault(f"{what} is {text!r}, allowed is true or false")
        return Start(TRUTH[text.strip()])
    if form in ("String", "Enumeration"):
        return Start(text)
    raise SystemFault(f"{what} is a {form}, which is not set here, allowed are numbers and texts")


def _numeric(text: str, form: str, what: str) -> float | int:
    if len(text.split()) > 1:
        raise SystemFault(
            f"{what} is an array, which is not set here, allowed are numbers and texts"
        )
    with suppress(ValueError, OverflowError):
        value = int(text) if form in INTEGERS else float(text)
        if math.isfinite(value):
            return value
    raise SystemFault(f"{what} is {text!r}, allowed is a finite number")
