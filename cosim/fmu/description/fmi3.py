"""modelDescription.xml of a unit, FMI 3.0, and how its sources are named.

What is an array is one variable here, with the reference of its first element. Behind all others
stand the time and the event indicators, which FMI 3 has for variables.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from xml.etree.ElementTree import Element, SubElement

from cosim.fmu.description import (
    UnitFacts,
    add_common,
    add_units,
    add_unknowns,
    begun,
    of_initial_unknowns,
    of_outputs,
    of_rates,
    set_known,
    set_variability,
    written,
)
from cosim.fmu.variables import Variable, by_array

#: Event indicators, in the kernel's order, each with what its event is.
INDICATORS = {
    "event_indicators.contact": "load of a stick reaches the limit, or a slip is at its end",
    "event_indicators.sliding": "a slip in the plane passes the speed at which it has a direction",
    "event_indicators.faster": "a slip in the plane has gained so much speed that a host starts "
    "anew, or an input has left the course that rates were given for",
}


def fmi3_description(facts: UnitFacts, variables: Sequence[Variable]) -> bytes:
    """The whole file; without a date, so that builds repeat."""
    root = begun(facts, "3.0", "instantiationToken")
    _add_interfaces(root, facts)
    add_units(root, variables, more=["s"])  # of the time
    add_common(root)
    indicators = INDICATORS if facts.indicators else {}
    names = [*(variable.name for variable in variables), "time", *indicators]
    references = {name: str(place) for place, name in enumerate(names)}
    declared = SubElement(root, "ModelVariables")
    for elements in by_array(variables):
        _add_variable(declared, elements, references)
    _add_time_and_indicators(declared, references, indicators)
    structure = SubElement(root, "ModelStructure")
    for kind, unknowns in (
        ("Output", of_outputs(variables)),
        ("ContinuousStateDerivative", of_rates(variables)),
        ("InitialUnknown", of_initial_unknowns(variables, facts.starts)),
        ("EventIndicator", dict.fromkeys(indicators)),
    ):
        add_unknowns(structure, kind, "valueReference", unknowns, references)
    return written(root)


def build_description(facts: UnitFacts) -> bytes:
    """buildDescription.xml: for who compiles the unit, where it has no library for a platform."""
    root = Element("fmiBuildDescription", fmiVersion="3.0")
    built = SubElement(root, "BuildConfiguration", modelIdentifier=facts.name)
    files = SubElement(built, "SourceFileSet", language="C99")
    for name in facts.sources:
        SubElement(files, "SourceFile", name=name)
    SubElement(built, "Library", name="m")
    return written(root)


def _add_interfaces(root: Element, facts: UnitFacts) -> None:
    can = dict.fromkeys(("canGetAndSetFMUState", "canSerializeFMUState"), "true")
    common = {"modelIdentifier": facts.name} | can
    of_steps = {"canHandleVariableCommunicationStepSize": "true"}
    if facts.gives_rates:
        of_steps["maxOutputDerivativeOrder"] = "1"
    if facts.indicators:
        of_steps |= {"mightReturnEarlyFromDoStep": "true", "hasEventMode": "true"}
        asked = ("providesDirectionalDerivatives", "needsCompletedIntegratorStep")
        SubElement(root, "ModelExchange", common | dict.fromkeys(asked, "true"))
    SubElement(root, "CoSimulation", common | of_steps)


def _type(variable: Variable) -> str:
    if variable.is_boolean:
        return "Boolean"
    return "Int32" if variable.is_integer else "Float64"


def _add_variable(
    declared: Element, elements: Sequence[Variable], references: Mapping[str, str]
) -> None:
    """A variable, or an array of which all elements but the start values are alike."""
    first = elements[0]
    told = {"name": first.array or first.name, "valueReference": references[first.name]}
    variable = SubElement(declared, _type(first), told, causality=first.causality)
    set_variability(variable, first, "continuous")
    variable.set("description", first.description)
    set_known(variable, first, "unit", "min", "max")
    nominals = [each.nominal for each in elements if each.nominal is not None]
    if nominals and not first.is_discrete:
        variable.set("nominal", repr(max(nominals)))
    if first.start is not None:
        variable.set("start", " ".join(repr(each.start) for each in elements))
    if first.derivative_of:
        variable.set("derivative", references[first.derivative_of])
    if first.is_state:  # of model exchange
        variable.set("reinit", "true")
    if first.array:
        SubElement(variable, "Dimension", start=str(len(elements)))


def _add_time_and_indicators(
    declared: Element, references: Mapping[str, str], indicators: Mapping[str, str]
) -> None:
    calculated = {"causality": "local", "variability": "continuous", "initial": "calculated"}
    added = {"time": ({"causality": "independent", "variability": "continuous"}, "Time", "s")} | {
        name: (calculated, f"Above 0 until its event: {event}", "1")
        for name, event in indicators.items()
    }
    for name, (kind, said, unit) in added.items():
        told = {"name": name, "valueReference": references[name]} | kind
        SubElement(declared, "Float64", told, description=said, unit=unit)
