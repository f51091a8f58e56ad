"""modelDescription.xml of a unit, FMI 2.0."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from cosim.fmu.units import UNITS
from cosim.fmu.variables import Variable

LOG_CATEGORIES = {
    "logStatusWarning": "what should be known, though it is no failure",
    "logStatusError": "why a call was refused; logged always",
    "logAll": "both",
}
AUTHOR = "The stickslip developers"
COPYRIGHT = "Copyright (c) 2026, the stickslip developers"
LICENSE = "BSD-3-Clause"
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
# Outputs that follow from the inputs of the moment in model exchange.
DIRECT = (
    *(f"friction_{of}" for of in ("force_x", "force_y", "moment")),
    "sliding_speed",
    "heat_flow",
    "surface_speed_actual",
)
# States that are only counted: no rate depends on them.
COUNTED = ("heat", "surface_work", "external_work", "damping_heat", "slip_time")
STOP_TIME, STEP_SIZE = "30", "0.01"  # s, of the experiment that a host may take


@dataclass(frozen=True)
class UnitFacts:
    """What a unit says of itself beside its variables.

    name : of the model and of its libraries
    version : of the product, and of the build
    python : whether it needs a Python in its host, and its temporary files
    indicators : event indicators of model exchange; None: it is for co-simulation only
    sources : of the library, in the unit's folder `sources`
    """

    name: str
    guid: str
    description: str
    version: str
    tool: str
    python: bool = False
    indicators: int | None = None
    sources: tuple[str, ...] = ()

    @property
    def license(self) -> str:
        """Of the unit."""
        return LICENSE


def fmi2_description(facts: UnitFacts, variables: Sequence[Variable]) -> bytes:
    """The whole file; without a date, so that builds repeat."""
    root = Element(
        "fmiModelDescription",
        fmiVersion="2.0",
        modelName=facts.name,
        guid=facts.guid,
        description=facts.description,
        author=AUTHOR,
        version=facts.version,
        copyright=COPYRIGHT,
        license=LICENSE,
        generationTool=facts.tool,
        variableNamingConvention="structured",
        numberOfEventIndicators=str(facts.indicators or 0),
    )
    if facts.indicators is not None:
        _add_model_exchange(root, facts)
    _add_co_simulation(root, facts)
    _add_units(root, variables)
    categories = SubElement(root, "LogCategories")
    for name, meaning in LOG_CATEGORIES.items():
        SubElement(categories, "Category", name=name, description=meaning)
    SubElement(root, "DefaultExperiment", startTime="0", stopTime=STOP_TIME, stepSize=STEP_SIZE)
    declared = SubElement(root, "ModelVariables")
    index = {variable.name: str(i) for i, variable in enumerate(variables, start=1)}
    exchange = facts.indicators is not None
    for reference, variable in enumerate(variables):
        _add_variable(declared, reference, variable, index, exchange)
    _add_structure(root, variables, index)
    indent(root)
    return tostring(root, encoding="UTF-8", xml_declaration=True)


def _add_model_exchange(root: Element, facts: UnitFacts) -> None:
    exchange = SubElement(
        root,
        "ModelExchange",
        modelIdentifier=facts.name,
        needsExecutionTool=_xml(facts.python),
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
        needsExecutionTool=_xml(facts.python),
        canHandleVariableCommunicationStepSize="true",
        canInterpolateInputs=_xml(not facts.python),
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


def _add_units(root: Element, variables: Iterable[Variable]) -> None:
    definitions = SubElement(root, "UnitDefinitions")
    for name in sorted({variable.unit for variable in variables if variable.unit}):
        unit = SubElement(definitions, "Unit", name=name)
        base = UNITS[name]
        if base is not None:
            SubElement(unit, "BaseUnit", {key: repr(value) for key, value in base.items()})


def _add_variable(
    declared: Element, reference: int, variable: Variable, index: Mapping[str, str], exchange: bool
) -> None:
    scalar = SubElement(
        declared, "ScalarVariable", name=variable.name, valueReference=str(reference)
    )
    scalar.set("causality", variable.causality)
    if variable.causality == "parameter":
        scalar.set("variability", "tunable" if variable.is_tunable else "fixed")
        scalar.set("initial", "exact")
    elif variable.causality != "input":
        if variable.is_integer:
            scalar.set("variability", "discrete")
        scalar.set("initial", "calculated")
    scalar.set("description", variable.description)
    kind = SubElement(scalar, "Integer" if variable.is_integer else "Real")
    for key in ("unit", "min", "max", "nominal", "start"):
        value = getattr(variable, key)
        if value is not None and not (key == "unit" and variable.is_integer):
            kind.set(key, value if isinstance(value, str) else repr(value))
    if variable.derivative_of:
        kind.set("derivative", index[variable.derivative_of])
    if variable.is_state and exchange:
        kind.set("reinit", "true")


def _xml(value: bool) -> str:
    return str(value).lower()


def _add_structure(root: Element, variables: Sequence[Variable], index: Mapping[str, str]) -> None:
    """Outputs, rates of the states and initial unknowns, with what they depend on.

    In co-simulation, the outputs at a communication point are those of the end of the step that led
    there: an input set at the point acts in the next step. In model exchange some follow from the
    inputs of the moment (`DIRECT`); where there is only co-simulation, none does. Outputs without
    an entry follow from all states and inputs.
    """
    structure = SubElement(root, "ModelStructure")
    exchange = any(variable.is_state for variable in variables)
    outputs = SubElement(structure, "Outputs")
    for variable in variables:
        if variable.causality == "output":
            unknown = SubElement(outputs, "Unknown", index=index[variable.name])
            if not exchange or variable.is_integer:
                unknown.set("dependencies", "")
            elif variable.name not in DIRECT:
                unknown.set("dependencies", _of_states(variable, variables, index))
    if exchange:
        _add_derivatives(SubElement(structure, "Derivatives"), variables, index)
    initial = SubElement(structure, "InitialUnknowns")
    for variable in variables:
        if variable.causality in ("output", "local"):
            unknown = SubElement(initial, "Unknown", index=index[variable.name])
            if variable.name in STARTS:
                sources = (index[source] for source in STARTS[variable.name])
                unknown.set("dependencies", " ".join(sources))


def _of_states(variable: Variable, variables: Sequence[Variable], index: Mapping[str, str]) -> str:
    """Of an output that is a state: itself; of another: all states."""
    if variable.is_state:
        return index[variable.name]
    return " ".join(index[each.name] for each in variables if each.is_state)


def _add_derivatives(
    element: Element, variables: Sequence[Variable], index: Mapping[str, str]
) -> None:
    """The rates of the states; each follows from the states that the motion depends on and from
    the inputs, but that of the time in slip, which is the mode."""
    said = {
        "der(slip_time)": "",
        "der(surface_travel)": index["surface_speed"],
    }
    motion = " ".join(
        index[each.name]
        for each in variables
        if each.causality == "input" or (each.is_state and each.name not in COUNTED)
    )
    for variable in variables:
        if variable.derivative_of:
            dependencies = said.get(variable.name, motion)
            SubElement(element, "Unknown", index=index[variable.name], dependencies=dependencies)
