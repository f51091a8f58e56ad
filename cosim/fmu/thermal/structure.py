"""StickSlipThermal.ssp: both native units and what they exchange, for tools that run systems.

SSP 1.0. The system has no connectors of its own: libcosim and ecos cannot read one that has. The
values that make the mechanics that of the reference scenario are a parameter set in the component,
which libcosim takes by itself, and ecos by its name; fmpy takes one from a file only, so that it is
there as well, with the components' names before the parameters'.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement, register_namespace

from stickslip.catalogue import CATALOGUE, Catalogue
from stickslip.generation.platforms import PLATFORMS, Platform
from stickslip.scratch import scratch_folder
from stickslip.units import UNITS

from cosim.files import write_bytes
from cosim.fmu import exchange, native
from cosim.fmu.archive import packed
from cosim.fmu.description import STOP_TIME, written
from cosim.fmu.thermal import native_unit
from cosim.fmu.thermal.variables import reduced
from cosim.fmu.variables import Variable

SSP = "StickSlipThermal.ssp"
MECHANICS, THERMAL = "mechanics", "thermal"
#: The set of values, and the file of it.
SET, SET_FILE = "reference", "resources/reference.ssv"
#: Output -> input: heat and travel of a step, and what the step leaves to the next.
CONNECTIONS = (
    ((MECHANICS, "heat"), (THERMAL, "heat")),
    ((MECHANICS, "surface_speed_actual"), (THERMAL, "surface_speed")),
    ((MECHANICS, "x"), (THERMAL, "x")),
    ((THERMAL, "interface_temperature"), (MECHANICS, "interface_temperature")),
)
#: Outputs that are not connected: with them, who runs the system checks the balance of the heat.
BALANCE = ("heat_received", "heat_stored", "heat_to_air")
_NAMES = {
    "ssd": "http://ssp-standard.org/SSP1/SystemStructureDescription",
    "ssc": "http://ssp-standard.org/SSP1/SystemStructureCommon",
    "ssv": "http://ssp-standard.org/SSP1/SystemStructureParameterValues",
}


def build(
    directory: Path,
    platforms: Sequence[Platform] = PLATFORMS,
    catalogue: Catalogue = CATALOGUE,
) -> Path:
    """Make the system of the reference scenario in a directory, its units inside.

    Raises CompilerError where there is no way to a library for any of the platforms.
    """
    with scratch_folder("ssp") as scratch:
        units = [
            native.build(Path(scratch), platforms, catalogue=catalogue),
            native_unit.build(Path(scratch), platforms),
        ]
        files = {f"resources/{fmu.name}": fmu.read_bytes() for fmu in units}
    files |= {"SystemStructure.ssd": description(catalogue), SET_FILE: values(catalogue)}
    return write_bytes(packed(files), directory / SSP)


def values(catalogue: Catalogue) -> bytes:
    """The set of values for tools that take it from a file."""
    for prefix, space in _NAMES.items():
        register_namespace(prefix, space)
    known = {each.name: each for each in exchange.variables(catalogue)}
    return written(_parameter_set(known, _changed(known), f"{MECHANICS}."))


def _changed(known: Mapping[str, Variable]) -> dict[str, float]:
    """What the reference scenario has otherwise than the mechanical unit."""
    from cosim.scenario import read_scenario  # the heat model, for who gets here

    scenario = read_scenario("reference")
    given = {"surface_speed": scenario.surface.speed, **scenario.mechanics.flat()}
    return {
        key: value for key, value in given.items() if key in known and known[key].start != value
    }


def description(catalogue: Catalogue) -> bytes:
    """SystemStructure.ssd."""
    mechanics = exchange.variables(catalogue)
    for prefix, space in _NAMES.items():
        register_namespace(prefix, space)
    root = Element(
        _of("ssd", "SystemStructureDescription"), {"name": "StickSlipThermal", "version": "1.0"}
    )
    system = SubElement(root, _of("ssd", "System"), name="StickSlipThermal")
    elements = SubElement(system, _of("ssd", "Elements"))
    used: set[str] = set()
    changed = _changed({each.name: each for each in mechanics})
    for name, fmu, declared, chosen in (
        (MECHANICS, f"{native.NAME}.fmu", mechanics, changed),
        (THERMAL, native_unit.FMU, reduced(), {}),
    ):
        used |= _add_component(elements, name, fmu, declared, chosen)
    connections = SubElement(system, _of("ssd", "Connections"))
    for (start, source), (end, sink) in CONNECTIONS:
        facts = zip(
            ("startElement", "startConnector", "endElement", "endConnector"),
            (start, source, end, sink),
            strict=True,
        )
        SubElement(connections, _of("ssd", "Connection"), dict(facts))
    _add_units(SubElement(root, _of("ssd", "Units")), used)
    SubElement(root, _of("ssd", "DefaultExperiment"), startTime="0", stopTime=STOP_TIME)
    return written(root)


def _of(space: str, name: str) -> str:
    return f"{{{_NAMES[space]}}}{name}"


def _add_component(
    elements: Element,
    name: str,
    fmu: str,
    declared: Sequence[Variable],
    chosen: Mapping[str, float],
) -> set[str]:
    """A unit with its connectors and the values that it starts from; the units it speaks in."""
    component = SubElement(
        elements,
        _of("ssd", "Component"),
        {"name": name, "type": "application/x-fmu-sharedlibrary", "source": f"resources/{fmu}"},
    )
    known = {each.name: each for each in declared}
    ends = [end for connection in CONNECTIONS for end in connection if end[0] == name]
    ends += [(name, port) for port in BALANCE if port in known]
    connectors = SubElement(component, _of("ssd", "Connectors"))
    for _, port in ends:
        variable = known[port]
        facts = {"name": port, "kind": variable.causality}
        connector = SubElement(connectors, _of("ssd", "Connector"), facts)
        SubElement(connector, _of("ssc", "Real"), unit=variable.unit or "1")
    if chosen:
        bindings = SubElement(component, _of("ssd", "ParameterBindings"))
        binding = SubElement(bindings, _of("ssd", "ParameterBinding"))
        place = SubElement(binding, _of("ssd", "ParameterValues"))
        place.append(_parameter_set(known, chosen))
    units = {known[port].unit for _, port in ends} | {known[key].unit for key in chosen}
    return {unit for unit in units if unit}


def _parameter_set(
    known: Mapping[str, Variable], chosen: Mapping[str, float], before: str = ""
) -> Element:
    """Values by the names of the variables, with something before each."""
    root = Element(_of("ssv", "ParameterSet"), name=SET, version="1.0")
    parameters = SubElement(root, _of("ssv", "Parameters"))
    for key, value in chosen.items():
        parameter = SubElement(parameters, _of("ssv", "Parameter"), name=before + key)
        if known[key].is_integer:
            SubElement(parameter, _of("ssv", "Integer"), value=str(int(value)))
        else:
            facts = {"value": repr(value)} | ({} if before else {"unit": known[key].unit or "1"})
            SubElement(parameter, _of("ssv", "Real"), facts)
    return root


def _add_units(element: Element, names: set[str]) -> None:
    for name in sorted(names):
        unit = SubElement(element, _of("ssc", "Unit"), name=name)
        facts = {key: repr(value) for key, value in (UNITS[name] or {}).items()}
        SubElement(unit, _of("ssc", "BaseUnit"), facts)
