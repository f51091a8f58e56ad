"""Hosts around the units: fmpy's simulation, one without numpy, one that wants to be warned."""

import subprocess
import sys
from pathlib import Path

import fmpy
from fmpy_instance import SLIDING

from cosim.scenario.defaults import stated


def test_simulate_fmu_runs_it(unit):
    result = fmpy.simulate_fmu(
        str(unit), stop_time=2.0, output_interval=0.01, start_values=SLIDING, output=["x", "heat"]
    )
    assert len(result) == 201 and result["heat"][-1] > 0


def test_a_host_without_numpy_runs_it(unit, tmp_path, block):
    description = fmpy.read_model_description(unit)
    folder = Path(fmpy.extract(unit, unzipdir=tmp_path / "bare"))
    slave = block.slave
    library = folder / Path(slave.dll._name).relative_to(tmp_path / "first")
    host = Path(__file__).with_name("bare_host.py")
    (x,) = (v.valueReference for v in description.modelVariables if v.name == "x")
    arguments = [str(folder), str(library), description.guid, str(x), "0.01", "100"]
    done = subprocess.run(
        [sys.executable, "-I", str(host), *arguments], capture_output=True, text=True, check=True
    )
    block.initialise(**stated())
    block.march(0, 100, 0.01)
    assert done.stdout.strip() == f"{block.get('x')!r} {{0}} False"
    assert done.stderr == ""


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
