"""Model exchange in a host written in C, with an integrator of its own: FMI 2.0 and 3.0.

The surface's speed is raised by the host. The motion is that of the unit in co-simulation, which is
given the speed with its rate.
"""

import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from c_library import compiler
from fmpy_slave import fmpy_slave
from plain_start import PLAIN
from stickslip.generation.platforms import this_platform

from cosim.fmu.exchange import INDICATORS, states, variables
from cosim.fmu.native import NAME, built_guid, native_folder

STOP, RATE = 6.0, 0.025  # s; m/s2
SHOWN = ("x", "vx", "heat", "slip_count")
STARTS = PLAIN | {"rig.spring_natural_length": 0.17, "lateral_friction.ratio": 1.0}
HOST = Path(__file__).with_name("exchange_host.c")
PLACES = {each.name: place for place, each in enumerate(variables())}

pytestmark = [
    pytest.mark.skipif(sys.platform != "linux", reason="the host is written for Linux"),
    pytest.mark.skipif(not compiler(), reason="needs a C compiler"),
]


@pytest.fixture(scope="module")
def exact(fmu, tmp_path_factory):
    """In co-simulation."""
    with fmpy_slave(fmu, tmp_path_factory.mktemp("unit")) as (_, slave, _log):
        slave.setReal([PLACES[name] for name in STARTS], [*STARTS.values()])
        slave.setReal([PLACES["surface_speed"]], [0.0])
        slave.setupExperiment()
        slave.enterInitializationMode()
        slave.exitInitializationMode()
        for n in range(round(STOP / 1e-3)):
            slave.setReal([PLACES["surface_speed"]], [RATE * n * 1e-3])
            slave.setRealInputDerivatives([PLACES["surface_speed"]], [1], [RATE])
            slave.doStep(n * 1e-3, 1e-3)
        return slave.getReal([PLACES[name] for name in SHOWN])


def hosted(fmu, version, folder, step):
    """What the host prints."""
    platform = this_platform()
    place = platform.fmi2 if version == 2 else platform.name
    with zipfile.ZipFile(fmu) as archive:
        library = archive.extract(f"binaries/{place}/{NAME}{platform.suffix}", folder)
    program = folder / "host"
    options = ["-std=c11", "-O1", "-Wall", "-Wextra", "-Werror", f"-DFMI={version}"]
    made = [*compiler(), *options, f"-I{native_folder() / 'headers'}", HOST, "-o", program]
    subprocess.run([*map(str, made), "-ldl", "-lm"], check=True)
    numbers = (len(states()), INDICATORS, step, STOP, RATE, PLACES["surface_speed"])
    shown = [f"{PLACES[name]}{'i' * (name == 'slip_count')}" for name in SHOWN]
    given = [f"{PLACES[name]}={value!r}" for name, value in STARTS.items()]
    command = [program, library, built_guid(fmu), *numbers, *shown, "--set", *given]
    done = subprocess.run([*map(str, command)], capture_output=True, text=True, check=False)
    assert done.returncode == 0 and done.stderr == "", done.stderr
    *values, events = done.stdout.split()
    return [float.fromhex(value) for value in values], int(events)


@pytest.mark.parametrize("version", [2, 3])
def test_a_host_in_c_moves_the_block_as_co_simulation_does(fmu, fmu3, exact, version, tmp_path):
    """Its integrator is of fourth order, and events are found to 1e-13 s."""
    unit = fmu if version == 2 else fmu3
    errors = []
    for step in (4e-3, 2e-3):
        found, events = hosted(unit, version, tmp_path, step)
        assert found[3] == exact[3] > 5 and events >= 2 * exact[3] - 1
        errors.append(max(abs(a - b) for a, b in zip(found[:3], exact[:3], strict=True)))
    assert errors[1] < 1e-6 and errors[1] < 0.5 * errors[0]
