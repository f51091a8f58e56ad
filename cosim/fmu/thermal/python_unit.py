"""BeltIceThermal-python.fmu: the whole heat model, by way of pythonfmu.

The slave travels; the package `thermal`, with numpy, scipy and scikit-fem, is that of the host's
Python. `cosim.fmu.python_unit` says how a unit is known by its content.
"""

from pathlib import Path

from cosim.files import write_bytes
from cosim.fmu import python_unit
from cosim.fmu.thermal.reference_run import of_heat, reference_parameters
from cosim.fmu.thermal.variables import DESCRIPTION, NAME, REFERENCE, STARTS, inputs, outputs
from cosim.fmu.variables import Variable, declared
from thermal import ThermalParameters

FMU = f"{NAME}-python.fmu"
MODULE, PACKAGE = "beltice_thermal", "beltice"
#: What the door asks for.
NEEDS = """
try:
    from thermal import BeltIceModel
except ImportError as error:
    raise ImportError(
        "BeltIceThermal-python.fmu needs the package `stickslip` in the host's Python, %s: %s; "
        "BeltIceThermal.fmu needs no Python" % (sys.executable, error)
    ) from None
"""


def parameters() -> list[Variable]:
    """Every number among the parameters of the heat model; a mesh and layers are no numbers."""
    found = []
    for table, block in ThermalParameters():
        for key, field in type(block).model_fields.items():
            if isinstance(getattr(block, key), int | float):
                name = f"{table}.{key}"
                start, told = REFERENCE.get(name, getattr(block, key)), declared(field, name)
                nominal = None if told["unit"] is None else abs(start) or 1.0
                found.append(Variable(name, "parameter", start=start, nominal=nominal, **told))
    return found


def variables() -> list[Variable]:
    """All of them, in the order of their value references."""
    return [*inputs(), *outputs(), *parameters()]


def sources() -> dict[str, bytes]:
    """Path inside the FMU's resources -> content, before anything is renamed."""
    travel = {"slave": "thermal_slave", "unit_slave": "unit_slave"}
    return {
        f"{MODULE}.py": python_unit.door(NAME, PACKAGE, 11, "has the heat model", NEEDS),
        f"{PACKAGE}/__init__.py": b'"""The slave of BeltIceThermal, as it travels."""\n',
        **{
            f"{PACKAGE}/{name}.py": python_unit.slave_file(file).read_bytes()
            for name, file in travel.items()
        },
    }


def build(directory: Path) -> Path:
    """Make the unit in a directory and return its path."""
    every = variables()
    said = f"{DESCRIPTION}. Finite elements; for hosts with a Python that has stickslip"
    places = {each.name: each.name for each in every}
    facts, raw = python_unit.by_pythonfmu(
        NAME, said, sources(), (MODULE, PACKAGE), every, places, starts=STARTS
    )
    made = python_unit.finished(raw, facts, every, of_heat(reference_parameters(), every))
    return write_bytes(made, directory / FMU)
