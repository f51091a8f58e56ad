"""StickSlipThermal.ssp: both native units and what they exchange, for tools that run systems.

SSP 1.0. The system has no connectors of its own: libcosim and ecos cannot read one that has. The
values that make the mechanics that of the reference scenario are a parameter set in the component,
which libcosim takes by itself, and ecos by its name; fmpy takes one from a file only, so that it is
there as well, with the components' names before the parameters'.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path

from stickslip.catalogue import CATALOGUE, Catalogue
from stickslip.generation.platforms import PLATFORMS, Platform
from stickslip.scratch import scratch_folder
from stickslip.units import UNITS

from cosim.files import write_bytes
from cosim.fmu import exchange, native
from cosim.fmu.archive import packed
from cosim.fmu.description import STOP_TIME, xml_of
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
HERE = "cosim.fmu.thermal"


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
    before = f"{MECHANICS}."
    told = {"known": known, "chosen": _changed(known), "before": before, "set": SET}
    return xml_of("values.xml.j2", HERE, **told)


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
    mechanics = {each.name: each for each in exchange.variables(catalogue)}
    units, used = [], set()
    for name, fmu, known, chosen in (
        (MECHANICS, f"{native.NAME}.fmu", mechanics, _changed(mechanics)),
        (THERMAL, native_unit.FMU, {each.name: each for each in reduced()}, {}),
    ):
        ends = [port for connection in CONNECTIONS for of, port in connection if of == name]
        ends += [port for port in BALANCE if port in known]
        units.append((name, fmu, known, ends, chosen))
        used |= {known[key].unit or "" for key in (*ends, *chosen)} - {""}
    return xml_of(
        "system.xml.j2",
        HERE,
        set=SET,
        units=units,
        connections=CONNECTIONS,
        used={unit: UNITS[unit] or {} for unit in sorted(used)},
        stop=STOP_TIME,
    )
