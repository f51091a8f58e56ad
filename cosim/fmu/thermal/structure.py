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
    directory: Path, platforms: Sequence[Platform] = PLATFORMS, catalogue: Catalogue = CATALOGUE
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
    root = _root("ssd:SystemStructureDescription", name="StickSlipThermal", version="1.0")
    system = _add(root, "ssd:System", name="StickSlipThermal")
    elements = _add(system, "ssd:Elements")
    mechanics = {each.name: each for each in exchange.variables(catalogue)}
    used: set[str | None] = set()
    for name, fmu, known, chosen in (
        (MECHANICS, f"{native.NAME}.fmu", mechanics, _changed(mechanics)),
        (THERMAL, native_unit.FMU, {each.name: each for each in reduced()}, {}),
    ):
        component = _add(
            elements,
            "ssd:Component",
            name=name,
            type="application/x-fmu-sharedlibrary",
            source=f"resources/{fmu}",
        )
        used |= _fill(component, name, known, chosen)
    connections = _add(system, "ssd:Connections")
    ends = ("startElement", "startConnector", "endElement", "endConnector")
    for source, sink in CONNECTIONS:
        _add(connections, "ssd:Connection", **dict(zip(ends, (*source, *sink), strict=True)))
    units = _add(root, "ssd:Units")
    for unit in sorted(filter(None, used)):
        facts = {key: repr(value) for key, value in (UNITS[unit] or {}).items()}
        _add(_add(units, "ssc:Unit", name=unit), "ssc:BaseUnit", **facts)
    _add(root, "ssd:DefaultExperiment", startTime="0", stopTime=STOP_TIME)
    return written(root)


def _of(tag: str) -> str:
    space, _, name = tag.partition(":")
    return f"{{{_NAMES[space]}}}{name}"


def _root(tag: str, /, **facts: str) -> Element:
    for prefix, space in _NAMES.items():
        register_namespace(prefix, space)
    return Element(_of(tag), facts)


def _add(parent: Element, tag: str, /, **facts: str) -> Element:
    return SubElement(parent, _of(tag), facts)


def _fill(
    component: Element, name: str, known: Mapping[str, Variable], chosen: Mapping[str, float]
) -> set[str | None]:
    """Give a unit its connectors and the values that it starts from; the units it speaks in."""
    ends = [port for connection in CONNECTIONS for of, port in connection if of == name]
    ends += [port for port in BALANCE if port in known]
    connectors = _add(component, "ssd:Connectors")
    for port in ends:
        connector = _add(connectors, "ssd:Connector", name=port, kind=known[port].causality)
        _add(connector, "ssc:Real", unit=known[port].unit or "1")
    if chosen:
        binding = _add(_add(component, "ssd:ParameterBindings"), "ssd:ParameterBinding")
        _add(binding, "ssd:ParameterValues").append(_parameter_set(known, chosen))
    return {known[key].unit for key in (*ends, *chosen)}


def _parameter_set(
    known: Mapping[str, Variable], chosen: Mapping[str, float], before: str = ""
) -> Element:
    """Values by the names of the variables, with something before each."""
    root = _root("ssv:ParameterSet", name=SET, version="1.0")
    parameters = _add(root, "ssv:Parameters")
    for key, value in chosen.items():
        parameter = _add(parameters, "ssv:Parameter", name=before + key)
        if known[key].is_integer:
            _add(parameter, "ssv:Integer", value=str(int(value)))
        else:
            unit = {} if before else {"unit": known[key].unit or "1"}
            _add(parameter, "ssv:Real", value=repr(value), **unit)
    return root
