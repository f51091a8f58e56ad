"""modelDescription.xml of a unit, FMI 2.0."""

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
    set_variability,
    written,
    xml,
)
from cosim.fmu.variables import Variable


def fmi2_description(facts: UnitFacts, variables: Sequence[Variable]) -> bytes:
    """The whole file; without a date, so that builds repeat."""
    root = begun(facts, "2.0", "guid")
    root.set("numberOfEventIndicators", str(facts.indicators or 0))
    if facts.indicators is not None:
        _add_model_exchange(root, facts)
    _add_co_simulation(root, facts)
    add_units(root, variables)
    add_common(root)
    declared = SubElement(root, "ModelVariables")
    index = {variable.name: str(i) for i, variable in enumerate(variables, start=1)}
    exchange = facts.indicators is not None
    for reference, variable in enumerate(variables):
        _add_variable(declared, reference, variable, index, exchange)
    _add_structure(root, variables, index, facts.starts)
    return written(root)


def _add_model_exchange(root: Element, facts: UnitFacts) -> None:
    exchange = SubElement(
        root,
        "ModelExchange",
        modelIdentifier=facts.name,
        needsExecutionTool=xml(facts.python),
        completedIntegratorStepNotNeeded="false",
        providesDirectionalDerivative="true",
        canNotUseMemoryManagementFunctions="true",
        canGetAndSetFMUstate="true",
        canSerializeFMUstate="true",
    )
    _add_sources(exchange, facts)


def _add_co_simulation(root: Element, facts: UnitFacts) -> None:
    co_simulation = SubElement(
        root,
        "CoSimulation",
        modelIdentifier=facts.name,
        needsExecutionTool=xml(facts.python),
        canHandleVariableCommunicationStepSize="true",
        canInterpolateInputs=xml(facts.interpolates and not facts.python),
        maxOutputDerivativeOrder="1" if facts.gives_rates and not facts.python else "0",
        canNotUseMemoryManagementFunctions="true",
        canGetAndSetFMUstate="true",
        canSerializeFMUstate="true",
    )
    _add_sources(co_simulation, facts)


def _add_sources(element: Element, facts: UnitFacts) -> None:
    if facts.sources:
        files = SubElement(element, "SourceFiles")
        for name in facts.sources:
            SubElement(files, "File", name=name)


def _add_variable(
    declared: Element, reference: int, variable: Variable, index: Mapping[str, str], exchange: bool
) -> None:
    scalar = SubElement(
        declared, "ScalarVariable", name=variable.name, valueReference=str(reference)
    )
    scalar.set("causality", variable.causality)
    set_variability(scalar, variable, None)
    scalar.set("description", variable.description)
    of_unit = "Integer" if variable.is_integer else "Real"
    kind = SubElement(scalar, "Boolean" if variable.is_boolean else of_unit)
    for key in ("unit", "min", "max", "nominal", "start"):
        value = getattr(variable, key)
        if value is not None:
            kind.set(key, value if isinstance(value, str) else repr(value))
    if variable.derivative_of:
        kind.set("derivative", index[variable.derivative_of])
    if variable.is_state and exchange:
        kind.set("reinit", "true")


def _add_structure(
    root: Element,
    variables: Sequence[Variable],
    index: Mapping[str, str],
    starts: Mapping[str, tuple[str, ...]],
) -> None:
    structure = SubElement(root, "ModelStructure")
    lists = {"Outputs": of_outputs(variables)}
    if any(variable.is_state for variable in variables):
        lists["Derivatives"] = of_rates(variables)
    lists["InitialUnknowns"] = of_initial_unknowns(variables, starts)
    for name, unknowns in lists.items():
        add_unknowns(SubElement(structure, name), "Unknown", "index", unknowns, index)
