"""What a unit says of itself, whatever the version of FMI."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from importlib.metadata import version
from typing import Any
from xml.etree.ElementTree import fromstring, indent, register_namespace, tostring

from stickslip.units import UNITS

from cosim.fmu.variables import DECLARED, Variable, by_array

LICENSE = "BSD-3-Clause"
_SAID = DECLARED["dependencies"]
#: Initial value of an output -> the parameters that it follows from.
STARTS: Mapping[str, Sequence[str]] = _SAID["starts"]
#: Event indicators, in the kernel's order, each with what its event is.
INDICATORS: Mapping[str, str] = _SAID["indicators"]
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
    starts: Mapping[str, Sequence[str]] = field(default_factory=lambda: STARTS)


def xml_of(template: str, package: str = __name__, **values: Any) -> bytes:
    """A file of a template that lies in a package; without a date, so that builds repeat."""
    from cosim.report.page import render  # not for who only compiles

    text = re.sub(r">\s+<", "><", render(template, package, **values))
    for prefix, space in re.findall(r'xmlns:(\w+)="(.*?)"', text):
        register_namespace(prefix, space)  # by which they are written, too
    root = fromstring(text)
    indent(root)
    found: bytes = tostring(root, encoding="UTF-8", xml_declaration=True)
    return found


#: Name of an unknown -> names of what it depends on; None: of all states and inputs.
Dependencies = dict[str, list[str] | None]


def fmi2_description(facts: UnitFacts, variables: Sequence[Variable]) -> bytes:
    """modelDescription.xml, FMI 2.0."""
    references = {variable.name: i for i, variable in enumerate(variables, start=1)}
    lists = {"Outputs": of_outputs(variables)}
    if any(variable.is_state for variable in variables):
        lists["Derivatives"] = of_rates(variables)
    lists["InitialUnknowns"] = of_initial_unknowns(variables, facts.starts)
    return _described("fmi2.xml.j2", facts, variables, lists, references, token="guid")


def fmi3_description(facts: UnitFacts, variables: Sequence[Variable]) -> bytes:
    """modelDescription.xml, FMI 3.0."""
    indicators = INDICATORS if facts.indicators else {}
    names = [*(variable.name for variable in variables), "time", *indicators]
    lists = {
        "Output": of_outputs(variables),
        "ContinuousStateDerivative": of_rates(variables),
        "InitialUnknown": of_initial_unknowns(variables, facts.starts),
        "EventIndicator": dict.fromkeys(indicators),
    }
    references = {name: place for place, name in enumerate(names)}
    own = {"token": "instantiationToken", "arrays": by_array(variables), "indicators": indicators}
    return _described("fmi3.xml.j2", facts, variables, lists, references, **own)


def _described(
    template: str,
    facts: UnitFacts,
    variables: Sequence[Variable],
    lists: Mapping[str, Dependencies],
    references: Mapping[str, int],
    **own: Any,
) -> bytes:
    """references: what stands for a name where others depend on it."""
    used = {each.unit for each in variables if each.unit}
    if "time" in references:
        used.add("s")
    return xml_of(
        template,
        facts=facts,
        variables=variables,
        lists=lists,
        references=references,
        units={name: UNITS[name] for name in sorted(used)},
        stop=STOP_TIME,
        step=STEP_SIZE,
        **own,
    )


def build_description(facts: UnitFacts) -> bytes:
    """buildDescription.xml: for who compiles the unit, where it has no library for a platform."""
    return xml_of("build.xml.j2", facts=facts)


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
    if variable.name in _SAID["direct"]:
        return None
    return [variable.name] if variable.is_state else states


def of_rates(variables: Sequence[Variable]) -> Dependencies:
    """The rates of the states; each follows from the states that the motion depends on and from
    the inputs, but that of the time in slip, which is the mode."""
    motion = [
        each.name
        for each in variables
        if each.causality == "input" or (each.is_state and each.name not in _SAID["counted"])
    ]
    said = {"der(slip_time)": [], "der(surface_travel)": ["surface_speed"]}
    return {
        variable.name: said.get(variable.name, motion)
        for variable in variables
        if variable.derivative_of
    }


def of_initial_unknowns(
    variables: Sequence[Variable], starts: Mapping[str, Sequence[str]]
) -> Dependencies:
    """What is there after the initialisation: outputs, states and rates."""
    return {
        variable.name: list(starts[variable.name]) if variable.name in starts else None
        for variable in variables
        if variable.causality in ("output", "local")
    }
