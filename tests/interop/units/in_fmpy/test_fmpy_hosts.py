"""Hosts around the units: fmpy's simulation, one without numpy, one that wants to be warned."""

import os
import sys

import fmpy
from command_line import python
from fmpy_instance import SLIDING

from cosim.scenario.defaults import stated


def test_simulate_fmu_runs_it(unit):
    result = fmpy.simulate_fmu(
        str(unit), stop_time=2.0, output_interval=0.01, start_values=SLIDING, output=["x", "heat"]
    )
    assert len(result) == 201 and result["heat"][-1] > 0


#: A host with nothing but ctypes, and numpy out of its reach.
BARE = """
import os, sys
from pathlib import Path
sys.modules["numpy"] = None
sys.path[:0] = sys.argv[1].split(os.pathsep)
from native_unit import Unit
unit, folder = map(Path, sys.argv[2:])
with Unit(unit, folder).instance(resources=(folder / "resources").as_uri().encode()) as block:
    block.begin(surface_speed=0.15)
    block.march(range(100), 0.01)
    print(*block.get("x"))
"""


def test_a_host_without_numpy_runs_it(unit, tmp_path, block):
    folder = fmpy.extract(unit, unzipdir=tmp_path / "bare")
    helpers = os.pathsep.join(each for each in sys.path if "helpers" in each)
    said = python(BARE, helpers, unit, folder)
    block.initialise(**stated())
    block.march(0, 100, 0.01)
    assert said.strip() == repr(block.get("x"))


def test_a_surface_that_the_creep_keeps_up_with_is_warned_of_once(unit):
    """With logging on; the run goes on, and sticks for ever."""
    said = []
    found = fmpy.simulate_fmu(
        str(unit),
        stop_time=0.5,
        output_interval=0.05,
        output=["mode"],
        debug_logging=True,
        start_values={"surface_speed": 0.15, "friction.stick_creep": 0.2},
        logger=lambda component, name, status, category, message: said.append((status, message)),
    )
    ((status, message),) = said
    assert status == 1 and b"surface_speed = 0.15 m/s is not above friction.stick_creep" in message
    assert not found["mode"].any()
