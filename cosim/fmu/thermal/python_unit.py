"""BeltIceThermal-python.fmu: the whole heat model, by way of pythonfmu.

The slave travels; the package `thermal`, with numpy, scipy and scikit-fem, is that of the host's
Python. `cosim.fmu.python_unit` says how a unit is known by its content.
"""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Any

from stickslip.quantity import details
from stickslip.units import UNITS

from cosim.fmu import python_unit
from cosim.fmu.thermal.reference_run import of_heat, reference_parameters
from cosim.fmu.thermal.variables import DESCRIPTION, NAME, REFERENCE, STARTS, inputs, outputs
from cosim.fmu.variables import Variable, bounds_of, names
from thermal import ThermalParameters

FMU = f"{NAME}-python.fmu"
MODULE, PACKAGE = "beltice_thermal", "beltice"
DOOR = '''"""BeltIceThermal, for hosts with a Python that has the heat model."""

import sys

if sys.version_info < (3, 11):
    raise ImportError(
        "BeltIceThermal needs Python 3.11 or newer, this host has %d.%d" % sys.version_info[:2]
    )

import ctypes

try:
    from thermal import BeltIceModel
except ImportError as error:
    raise ImportError(
        "BeltIceThermal-python.fmu needs the package `stickslip` in the host's Python, %s: %s; "
        "BeltIceThermal.fmu needs no Python" % (sys.executable, error)
    ) from None

from beltice.slave import BeltIceThermal

# see the door of StickSlip3DOF
if locals() is not globals():
    ctypes.pythonapi.Py_IncRef(ctypes.py_object(globals()))
'''


def parameters() -> list[Variable]:
    """Every number among the parameters of the heat model; a mesh and layers are no numbers."""
    defaults = ThermalParameters()
    found = []
    for table in ThermalParameters.model_fields:
        block = getattr(defaults, table)
        for key in type(block).model_fields:
            if isinstance(getattr(block, key), int | float):
                found.append(_parameter(f"{table}.{key}", block, key))
    return found


def _parameter(name: str, block: Any, key: str) -> Variable:
    field = type(block).model_fields[key]
    start = REFERENCE.get(name, getattr(block, key))
    whole = field.annotation is int
    unit = None if whole else details(field)["unit"]
    if unit is not None and unit not in UNITS:
        raise ValueError(f"{name} is in {unit!r}, a unit that UNITS lacks")
    bounds = bounds_of(field)
    return Variable(
        name,
        "parameter",
        unit,
        None if whole else abs(start) or 1.0,
        field.description or "",
        min=bounds.get("gt", bounds.get("ge")),
        max=bounds.get("lt", bounds.get("le")),
        above_min="gt" in bounds,
        start=start,
    )


def variables() -> list[Variable]:
    """All of them, in the order of their value references."""
    return [*inputs(), *outputs(), *parameters()]


def sources() -> dict[str, bytes]:
    """Path inside the FMU's resources -> content, before anything is renamed."""
    travel = {"slave": "thermal_slave", "unit_slave": "unit_slave"}
    return {
        f"{MODULE}.py": DOOR.encode(),
        f"{PACKAGE}/__init__.py": b'"""The slave of BeltIceThermal, as it travels."""\n',
        **{
            f"{PACKAGE}/{name}.py": python_unit.slave_file(file).read_bytes()
            for name, file in travel.items()
        },
    }


def build(directory: Path) -> Path:
    """Make the unit in a directory and return its path."""
    declared, files = variables(), sources()
    recipe = {f"recipe/{file.name}": file.read_bytes() for file in python_unit.RECIPE_FILES}
    recipe["recipe/thermal.py"] = Path(__file__).read_bytes()
    content = python_unit.hash_of(files | recipe, [asdict(each) for each in declared])
    said = f"{DESCRIPTION}. Finite elements; for hosts with a Python that has stickslip"
    facts = python_unit.facts_of(NAME, content, said, starts=STARTS)
    tells = {
        "BUILD": content,
        "GUID": facts.guid,
        "INPUTS": [
            (each.name, each.name, each.start, each.min, each.max, each.nominal)
            for each in declared
            if each.causality == "input"
        ],
        "OUTPUTS": [(name, name, "Real") for name in names(declared, "output")],
        "PARAMETERS": [asdict(each) for each in declared if each.causality == "parameter"],
    }
    return python_unit.made(
        python_unit.Recipe(
            facts=facts,
            module=MODULE,
            package=PACKAGE,
            files=files | {f"{PACKAGE}/variables.py": python_unit.module_of(tells)},
            variables=declared,
            content=content,
            documentation=of_heat(reference_parameters(), declared),
        ),
        directory / FMU,
    )
