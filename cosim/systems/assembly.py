"""A system as its file has it, put together: participants, connections, scheme, steps."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from fmpy.model_description import ModelDescription, ModelVariable
from stickslip.units import QUANTITY, base_units

from cosim.coupling import (
    Affine,
    Connection,
    CoupledSystem,
    Driven,
    FmuParticipant,
    IsolatedParticipant,
    Participant,
    Port,
    Scheme,
    StepControl,
    Subcycled,
    UnitDefinition,
)
from cosim.coupling.conversion import BASE_UNITS, IDENTITY, NO_UNIT, between, conversion
from cosim.coupling.fmu.description import describe, faults_of
from cosim.coupling.fmu.variables import INTEGERS, REALS, definitions_of, scalars, unit_of
from cosim.coupling.methods import control_of, scheme_of
from cosim.coupling.participant import Causality
from cosim.coupling.system import ENERGY_UNIT, Address, find_port
from cosim.coupling.tolerance import Tolerance
from cosim.names import unknown_name
from cosim.scenario.validation import not_in
from cosim.systems.specification import (
    NOT_GIVEN,
    Link,
    Start,
    SystemFault,
    SystemSpecification,
    UnitEntry,
    Value,
    naming,
    unused,
)

#: Types of variables whose number may be given as a text with its unit.
WITH_UNIT = (*REALS, *INTEGERS)
#: More macro steps than this are a slip of the unit, and have no end.
MOST_STEPS = 1_000_000_000
#: The step control without one.
FIXED = "fixed"
#: Of a run where nobody names a step.
STEPS_OF_A_RUN = 1000


@dataclass(frozen=True)
class Assembly:
    """A system that can be run. remarks: what was assumed or could not be checked, a line each.

    To be closed when the run is over.
    """

    system: CoupledSystem
    scheme: Scheme
    control: StepControl
    macro_step: float
    remarks: tuple[str, ...]


def assemble(specification: SystemSpecification, debug: bool = False) -> Assembly:
    """Read the units and connect them.

    debug: keep also what units log where all is well.

    Raises SystemFault, FmuError or CouplingError in one line for what does not fit.
    """
    source = specification.source
    descriptions = {unit.name: describe(unit.file) for unit in specification.units}
    units = {unit.name: unit for unit in specification.units}
    with naming(source):
        participants = {
            name: _participant(unit, descriptions[name], debug) for name, unit in units.items()
        }
    remarks = [
        *specification.remarks,
        *unused(specification.coupling, specification.run),
        *_faults(specification),
    ]
    connections = []
    for link in specification.links:
        with naming(source, link.place):
            for end in map(Address.parse, (link.source, link.sink)):
                if end.participant in descriptions:
                    _refuse_other_types(descriptions[end.participant], end.participant, end.port)
            affine, remark = _conversion(units, participants, link)
            sink = Address.parse(link.sink)
            if sink.port in units[sink.participant].driven:
                raise SystemFault(
                    f"{link}: {link.sink} is a column of {units[sink.participant].input_file}, too;"
                    " allowed is one of both"
                )
        taken = link.taken or _receipt(participants, link)
        connections.append(
            Connection(link.source, link.sink, taken, transformation=affine, converts=False)
        )
        if remark:
            remarks.append(f"{link}: {remark}")
    with naming(source):
        together = [*participants.values()]
        system = CoupledSystem(together, connections, specification.residuals, receipts=False)
    step, remark = _step(specification, descriptions)
    scheme, control = _methods(specification, system, step)
    return Assembly(system, scheme, control, step, (*remarks, *filter(None, [remark])))


def _faults(specification: SystemSpecification) -> list[str]:
    """What is wrong with the units and does no harm, a line for each."""
    found = []
    for unit in specification.units:
        if faults := faults_of(unit.file):
            others = f" (and {len(faults) - 1} more)" if len(faults) > 1 else ""
            found.append(f"{unit.name}: {faults[0].removeprefix('- ')}{others}")
    return found


def _participant(unit: UnitEntry, description: ModelDescription, debug: bool) -> Participant:
    """A unit with what it is set to, and what its file has of its inputs over time, in as many
    steps a macro step as the file says."""
    options: dict[str, Any] = _settings(unit, description)
    options |= {"tolerance": unit.tolerance, "debug": debug}
    participant: Participant
    if unit.isolate:
        if unit.time_limit != NOT_GIVEN:
            options["time_limit"] = unit.time_limit
        participant = IsolatedParticipant(FmuParticipant, str(unit.file), unit.name, **options)
    else:
        participant = FmuParticipant(unit.file, unit.name, **options)
    inputs = [port.name for port in participant.ports.values() if port.causality == "input"]
    for name in unit.driven:
        if name not in inputs:
            raise SystemFault(
                f"{unit.input_file}: {unknown_name('input of ' + unit.name, name, inputs)}"
            )
        if name in unit.given:
            raise SystemFault(
                f"{unit.name}.{name}: is set, and a column of {unit.input_file}; allowed is one of"
                " both"
            )
    if unit.driven:
        participant = Driven(participant, unit.driven)
    return participant if unit.substeps == 1 else Subcycled(participant, unit.substeps)


def _settings(unit: UnitEntry, description: ModelDescription) -> dict[str, dict[str, Value]]:
    """What its variables, and elements of arrays, start from: by what a participant takes."""
    variables = {name: each.variable for name, each in scalars(description).items()}
    definitions = definitions_of(description)
    tables: dict[str, dict[str, Value]] = {}
    for name, start in unit.given.items():
        variable = variables.get(name)
        _refuse_other_types(description, unit.name, name)
        if variable is None:
            raise SystemFault(unknown_name(f"variable of {unit.name}", name, variables))
        if variable.causality == "structuralParameter":
            raise SystemFault(
                f"{unit.name}.{name} is a structural parameter, which sizes arrays and "
                "is not set here; allowed are parameters and inputs"
            )
        kind = {"parameter": "parameters", "input": "inputs"}.get(variable.causality, "starts")
        value = _value(f"{unit.name}.{name}", variable, start, definitions)
        tables.setdefault(kind, {})[name] = value
    return tables


def _refuse_other_types(description: ModelDescription, unit: str, name: str) -> None:
    """Refuse a variable that there is, of a type that nothing here has a value of."""
    for variable in description.modelVariables:
        if variable.name == name and (variable.type in ("Binary", "Clock") or variable.clocks):
            kind = "of a clock" if variable.clocks else f"a {variable.type}"
            raise SystemFault(
                f"{unit}.{name} is {kind}, which is not coupled here; allowed are numbers, Booleans"
                " and texts"
            )


def _value(
    label: str, variable: ModelVariable, start: Start, definitions: Mapping[str, UnitDefinition]
) -> Value:
    """What a variable is set to, in its own unit."""
    value = start.value
    if variable.type == "Enumeration" and isinstance(value, str):
        items = variable.declaredType.items if variable.declaredType else []
        numbers = {item.name: int(item.value) for item in items}
        if value not in numbers:
            raise SystemFault(f"{label}: {unknown_name('item', value, numbers)}")
        return numbers[value]
    if isinstance(value, str) and variable.type in WITH_UNIT:
        return _in_own_unit(label, value, unit_of(variable), definitions)
    affine = start.transformation
    if start.unit is not None and start.converts:
        unit = unit_of(variable)
        given = Port(label, start.unit or NO_UNIT, Causality.OUTPUT, definition=start.definition)
        needed = Port(label, unit, Causality.INPUT, definition=definitions.get(unit))
        with naming(label):
            affine = conversion(given, needed)[0].then(affine)
    if affine.is_identity or isinstance(value, (bool, str)):
        return value
    own = affine(value)
    if not math.isfinite(own):
        raise SystemFault(
            f"{label}: {value:g} {start.unit or ''} is not a finite number in {unit_of(variable)}"
        )
    return own


def _in_own_unit(
    label: str, text: str, unit: str, definitions: Mapping[str, UnitDefinition]
) -> float:
    """The number of a text such as "670 g", in the unit that the variable declares."""
    found = QUANTITY.fullmatch(text)
    given, own = (_written_unit(found[2]) if found else None), definitions.get(unit)
    own = own or _written_unit(unit)
    if found and given and own and unit != NO_UNIT and given.exponents == own.exponents:
        return float(f"{between(given, own)(float(found[1])):.15g}")
    number = "a number" if unit == NO_UNIT else f"a number in {unit}"
    wrong = not_in(unit) if found else "not a number"
    raise SystemFault(f'{label}: {wrong} ("{text}"), allowed is {number}')


def _written_unit(text: str) -> UnitDefinition | None:
    """What a unit is made of as people write it; None for what is no unit."""
    base = base_units(text)
    if base is None:
        return None
    exponents = tuple(int(base.get(name, 0)) for name in BASE_UNITS)
    return UnitDefinition(exponents, base.get("factor", 1.0), base.get("offset", 0.0))


def _conversion(
    units: Mapping[str, UnitEntry], participants: Mapping[str, Participant], link: Link
) -> tuple[Affine, str]:
    """All that happens to a value on its way, border after border, and what was not checked.

    At each border the unit is converted, then the transformation is applied (SSP, common content,
    LinearTransformation).
    """
    here = _end(units, participants, link.source)
    affine, remarks = IDENTITY, []
    for number, hop in enumerate(link.hops, 1):
        there = here
        if number == len(link.hops):
            there = _end(units, participants, link.sink)
        elif hop.unit is not None:
            there = Port(link.sink, hop.unit, Causality.INPUT, definition=hop.definition)
        if hop.converts:
            with naming(str(link)):
                step, remark = conversion(here, there)
            affine = affine.then(step)
            remarks.append(remark)
        affine = affine.then(hop.transformation)
        here = there
    return affine, "; ".join(dict.fromkeys(filter(None, remarks)))


def _receipt(participants: Mapping[str, Participant], link: Link) -> str | None:
    """Of joules into ``heat``, the output ``heat_received`` beside it, where there is one."""
    sink = Address.parse(link.sink)
    ports, name = participants[sink.participant].ports, f"{sink.port}_received"
    receipt = ports.get(name)
    if receipt is None or receipt.causality is not Causality.OUTPUT:
        return None
    return name if ports[sink.port].unit == receipt.unit == ENERGY_UNIT else None


def _end(
    units: Mapping[str, UnitEntry], participants: Mapping[str, Participant], text: str
) -> Port:
    """A port; where its unit says nothing of a unit, with what the system's file says."""
    address = Address.parse(text)
    port = find_port(participants, address)
    unit, definition = units[address.participant].ports.get(address.port, (NO_UNIT, None))
    if port.definition is None and port.unit in (NO_UNIT, unit):
        return Port(port.name, unit, port.causality, port.nominal, definition)
    return port


def _step(
    specification: SystemSpecification, descriptions: Mapping[str, ModelDescription]
) -> tuple[float, str]:
    """The macro step, s, and how it came about where the file names none."""
    run, chosen = specification.run, specification.coupling.macro_step
    if run.stop == NOT_GIVEN:
        raise SystemFault(
            f"{specification.source}: run.stop: missing, needed is the time (s) at which the run"
            " ends, for instance by --set run.stop=10"
        )
    length = run.stop - run.start
    stated = [each.defaultExperiment for each in descriptions.values() if each.defaultExperiment]
    sizes = [float(each.stepSize) for each in stated if each.stepSize is not None]
    advised = min((size for size in sizes if math.isfinite(size) and size > 0.0), default=None)
    step, why = length / STEPS_OF_A_RUN, "a thousandth of the run"
    if chosen != NOT_GIVEN:
        step, why = chosen, ""
    elif advised:
        step, why = advised, "as a unit advises"
    if length / step > MOST_STEPS:
        raise SystemFault(
            f"{specification.source}: coupling.macro_step: {step:g} s{why and f' ({why})'} cuts the"
            f" run into more than {MOST_STEPS} steps, allowed is at least {length / MOST_STEPS:g} s"
        )
    return step, why and f"coupling.macro_step is not given: {step:g} s, {why}"


def record_every(specification: SystemSpecification, macro_step: float) -> int:
    """Macro steps from one row of the results to the next; SystemFault where rows fall between."""
    interval = specification.run.output_interval
    if interval == NOT_GIVEN or specification.coupling.step_control != FIXED:
        return 1
    ratio = interval / macro_step
    if round(ratio) < 1 or abs(ratio - round(ratio)) > 1e-9 * ratio:
        raise SystemFault(
            f"{specification.source}: run.output_interval: {interval:g} s does not fall on the"
            f" macro steps, allowed is a multiple of coupling.macro_step = {macro_step:g} s"
        )
    return round(ratio)


def _methods(
    specification: SystemSpecification, system: CoupledSystem, macro_step: float
) -> tuple[Scheme, StepControl]:
    """Scheme and step control; an order, a tolerance, a bond or a step (s) that cannot be is
    refused."""
    source, settings, run = specification.source, specification.coupling, specification.run
    order = settings.order or tuple(system.participants)
    with naming(source, "coupling.order"):
        system.check_order(order)
    with naming(source, "coupling.absolute_tolerances"):
        Tolerance(absolute=settings.absolute_tolerances).check(system)
    with naming(source, "coupling"):
        scheme = scheme_of(settings, order)
        scheme.check(system)
    is_energy = settings.step_control == "energy"
    with naming(source, "coupling.power_bonds" if is_energy else "coupling"):
        control = control_of(settings, macro_step, settings.power_bonds)
        control.begin(run.start, run.stop, scheme)
        control.check(system)
    return scheme, control
