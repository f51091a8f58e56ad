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
    set_known,
    set_variability,
    written,
    xml,
)
from cosim.fmu.variables import Variable

#: Of both interfaces.
CAN = dict.fromkeys(
    ("canNotUseMemoryManagementFunctions", "canGetAndSetFMUstate", "canSerializeFMUstate"), "true"
)


def fmi2_description(facts: UnitFacts, variables: Sequence[Variable]) -> bytes:
    """The whole file; without a date, so that builds repeat."""
    root = begun(facts, "2.0", "guid")
    root.set("numberOfEventIndicators", str(facts.indicators or 0))
    _add_interfaces(root, facts)
    add_units(root, variables)
    add_common(root)
    declared = SubElement(root, "ModelVariables")
    index = {variable.name: str(i) for i, variable in enumerate(variables, start=1)}
    for reference, variable in enumerate(variables):
        _add_variable(declared, reference, variable, index, facts.indicators is not None)
    structure = SubElement(root, "ModelStructure")
    lists = {"Outputs": of_outputs(variables)}
    if any(variable.is_state for variable in variables):
        lists["Derivatives"] = of_rates(variables)
    lists["InitialUnknowns"] = of_initial_unknowns(variables, facts.starts)
    for name, unknowns in lists.items():
        add_unknowns(SubElement(structure, name), "Unknown", "index", unknowns, index)
    return written(root)


def _add_interfaces(root: Element, facts: UnitFacts) -> None:
    common = {"modelIdentifier": facts.name, "needsExecutionTool": xml(facts.python)}
    rates = facts.gives_rates and not facts.python
    kinds = {
        "ModelExchange": {
            "completedIntegratorStepNotNeeded": "false",
            "providesDirectionalDerivative": "true",
        },
        "CoSimulation": {
            "canHandleVariableCommunicationStepSize": "true",
            "canInterpolateInputs": xml(facts.interpolates and not facts.python),
            "maxOutputDerivativeOrder": str(int(rates)),
        },
    }
    if facts.indicators is None:
        del kinds["ModelExchange"]
    for kind, able in kinds.items():
        element = SubElement(root, kind, common | able | CAN)
        if facts.sources:
            files = SubElement(element, "SourceFiles")
            for name in facts.sources:
                SubElement(files, "File", name=name)


def _add_variable(
    declared: Element, reference: int, variable: Variable, index: Mapping[str, str], exchange: bool
) -> None:
    told = {"name": variable.name, "valueReference": str(reference)}
    scalar = SubElement(declared, "ScalarVariable", told, causality=variable.causality)
    set_variability(scalar, variable, None)
    scalar.set("description", variable.description)
    of_unit = "Integer" if variable.is_integer else "Real"
    kind = SubElement(scalar, "Boolean" if variable.is_boolean else of_unit)
    set_known(kind, variable, "unit", "min", "max", "nominal", "start")
    if variable.derivative_of:
        kind.set("derivative", index[variable.derivative_of])
    if variable.is_state and exchange:
        kind.set("reinit", "true")
