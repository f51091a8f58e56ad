"""What a unit says of itself, whatever the version of FMI."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from importlib.metadata import version
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from stickslip.units import UNITS

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
        *("heat", "heat_flow", "damping_heat", "sliding_distance", "surface_travel"),
        *("slip_time", "slip_count", "energy_residual"),
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
    version, tool : of the product that made it
    python : whether it needs a Python in its host, and its temporary files
    indicators : event indicators of model exchange; None: it is for co-simulation only
    sources : C files of the library, in the unit's folder `sources`
    interpolates : whether it takes rates of its inputs
    gives_rates : whether it has first derivatives of its outputs
    starts : initial value of an output -> what it follows from, see `STARTS`
    """

    name: str
    guid: str
    description: str
    version: str = field(default_factory=lambda: version("stickslip"))  # a wheel is built before
    tool: str = "stickslip"
    license: str = LICENSE
    python: bool = False
    indicators: int | None = None
    sources: tuple[str, ...] = ()
    interpolates: bool = True
    gives_rates: bool = True
    starts: Mapping[str, tuple[str, ...]] = field(default_factory=lambda: STARTS)


def begun(facts: UnitFacts, fmi: str, token: str) -> Element:
    """The root of a description in a version of FMI, in which the GUID is called ``token``."""
    return Element(
        "fmiModelDescription",
        {
            "fmiVersion": fmi,
            "modelName": facts.name,
            token: facts.guid,
            "description": facts.description,
            "author": AUTHOR,
            "version": facts.version,
            "copyright": COPYRIGHT,
            "license": facts.license,
            "generationTool": facts.tool,
            "variableNamingConvention": "structured",
        },
    )


def written(root: Element) -> bytes:
    """The file."""
    indent(root)
    found: bytes = tostring(root, encoding="UTF-8", xml_declaration=True)
    return found


def add_units(root: Element, variables: Iterable[Variable], more: Iterable[str] = ()) -> None:
    """Those that the variables are in, and more, by their base units."""
    definitions = SubElement(root, "UnitDefinitions")
    for name in sorted({variable.unit for variable in variables if variable.unit} | {*more}):
        unit = SubElement(definitions, "Unit", name=name)
        base = UNITS[name]
        if base is not None:
            SubElement(unit, "BaseUnit", {key: repr(value) for key, value in base.items()})


def add_common(root: Element) -> None:
    """Categories of messages, and the experiment that a host may take."""
    categories = SubElement(root, "LogCategories")
    for name, meaning in LOG_CATEGORIES.items():
        SubElement(categories, "Category", name=name, description=meaning)
    SubElement(root, "DefaultExperiment", startTime="0", stopTime=STOP_TIME, stepSize=STEP_SIZE)


def xml(value: bool) -> str:
    """As XML has it."""
    return str(value).lower()


def set_variability(element: Element, variable: Variable, otherwise: str | None) -> None:
    """When a variable changes, and how it begins; otherwise: of an output that is not discrete."""
    if variable.causality == "parameter":
        element.set("variability", "tunable" if variable.is_tunable else "fixed")
        element.set("initial", "exact")
    elif variable.causality != "input":
        if changes := "discrete" if variable.is_discrete else otherwise:
            element.set("variability", changes)
        element.set("initial", "calculated")


def set_known(element: Element, variable: Variable, *keys: str) -> None:
    """Set what is declared of a variable."""
    for key in keys:
        if (value := getattr(variable, key)) is not None:
            element.set(key, value if isinstance(value, str) else repr(value))


#: Name of an unknown -> names of what it depends on; None: of all states and inputs.
Dependencies = dict[str, list[str] | None]


def of_outputs(variables: Sequence[Variable]) -> Dependencies:
    """What each output follows from.

    In co-simulation, the outputs at a communication point are those of the end of the step that led
    there: an input set at the point acts in the next step. In model exchange some follow from the
    inputs of the moment (`DIRECT`); where there is only co-simulation, none does.
    """
    states = [variable.name for variable in variables if variable.is_state]
    return {each.name: _direct(each, states) for each in variables if each.causality == "output"}


def _direct(variable: Variable, states: list[str]) -> list[str] | None:
    if not states or variable.is_discrete:
        return []
    if variable.name in DIRECT:
        return None
    return [variable.name] if variable.is_state else states


def of_rates(variables: Sequence[Variable]) -> Dependencies:
    """The rates of the states; each follows from the states that the motion depends on and from
    the inputs, but that of the time in slip, which is the mode."""
    motion = [
        each.name
        for each in variables
        if each.causality == "input" or (each.is_state and each.name not in COUNTED)
    ]
    said = {"der(slip_time)": [], "der(surface_travel)": ["surface_speed"]}
    return {
        variable.name: said.get(variable.name, motion)
        for variable in variables
        if variable.derivative_of
    }


def of_initial_unknowns(
    variables: Sequence[Variable], starts: Mapping[str, tuple[str, ...]]
) -> Dependencies:
    """What is there after the initialisation: outputs, states and rates."""
    return {
        variable.name: list(starts[variable.name]) if variable.name in starts else None
        for variable in variables
        if variable.causality in ("output", "local")
    }


def add_unknowns(
    element: Element, kind: str, key: str, unknowns: Dependencies, references: Mapping[str, str]
) -> None:
    """What each depends on; key: by which attribute it is told, references: and as what."""
    for name, sources in unknowns.items():
        unknown = SubElement(element, kind, {key: references[name]})
        if sources is not None:
            unknown.set("dependencies", " ".join(references[source] for source in sources))
