"""Hosts around the units: fmpy's simulation, one without numpy, one that wants to be warned."""

import os
import sys

import fmpy
from command_line import python

from cosim.scenario.defaults import stated

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
