"""The units' libraries for Windows, in the host written in C, under wine.

The libraries are those that an installed package brings, or that zig makes; the host is compiled
for Windows by MinGW, or by zig.
"""

import importlib.util
import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from native_unit import references
from plain_start import PLAIN
from stickslip import Parameters, simulate
from stickslip.generation.platforms import PLATFORMS, this_platform

from cosim.fmu import native
from cosim.fmu.build import THERMAL, FmuBuildError, build_fmu
from cosim.fmu.thermal import native_unit
from cosim.fmu.thermal.variables import reduced

HOST = Path(__file__).with_name("host.c")
(WINDOWS,) = (each for each in PLATFORMS if each.suffix == ".dll")
# exact in binary, so that host and simulation speak of the same instants
STEP, STEPS = 0.0078125, 640

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="for wine on Linux")


def windows_compiler():
    """Command of a compiler for Windows; where there is none, the test is skipped.

    MinGW's comes with its runtime; zig first compiles that, which takes it a minute.
    """
    if mingw := shutil.which("x86_64-w64-mingw32-gcc"):
        return [mingw]
    if importlib.util.find_spec("ziglang"):
        return [sys.executable, "-m", "ziglang", "cc", "-target", WINDOWS.target]
    return pytest.skip("needs a compiler for Windows: x86_64-w64-mingw32-gcc, or ziglang")


@pytest.fixture(scope="module")
def wine():
    """Wine's program, which Debian's wine64 does not put on the path."""
    places = os.pathsep.join([os.environ["PATH"], "/usr/lib/wine"])
    found = shutil.which("wine64", path=places) or shutil.which("wine", path=places)
    return found or pytest.skip("needs wine")


@pytest.fixture(scope="module")
def environment(tmp_path_factory):
    """Wine's variables, with a prefix that is two drives and no more.

    A whole one takes 8 s and 700 MB. As while one is made, all libraries are wine's own.
    """
    prefix = tmp_path_factory.mktemp("prefix")
    (prefix / "drive_c" / "windows" / "system32").mkdir(parents=True)
    (prefix / "dosdevices").mkdir()
    (prefix / "dosdevices" / "c:").symlink_to("../drive_c")
    (prefix / "dosdevices" / "z:").symlink_to("/")
    (prefix / ".update-timestamp").write_text("disable\n")
    own = {"WINEPREFIX": str(prefix), "WINEBOOTSTRAPMODE": "1", "WINEDEBUG": "-all"}
    return {"PATH": os.environ["PATH"]} | own


@pytest.fixture(scope="module")
def host(wine, tmp_path_factory):
    """The host as a program for Windows; not compiled where there is no wine to run it."""
    program = tmp_path_factory.mktemp("windows") / "host.exe"
    headers = f"-I{native.native_folder() / 'headers'}"
    # as the library is compiled, so that zig needs no second runtime
    options = ["-std=c99", "-O2", "-s", "-Wall", "-Wextra", "-Werror", "-static", headers]
    command = [*windows_compiler(), *options, HOST, "-o", program, "-lpthread"]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return program


class Windows:
    """A unit's library in the host under wine; called with what the host wants to know."""

    def __init__(self, program, environment, folder, made_by, places):
        library = folder / "binaries" / WINDOWS.fmi2 / f"{made_by.NAME}.dll"
        self.command = [*program, library, made_by.guid()]
        resources = f"file:///Z:{folder / 'resources'}"
        self.environment, self.places = environment | {"RESOURCES": resources}, places

    def __call__(self, output, steps, step, instances=1, threads=1, **values):
        numbers = [steps, step, self.places[output], instances, threads]
        numbers += [f"{self.places[name]}={value!r}" for name, value in values.items()]
        done = subprocess.run(
            list(map(str, [*self.command, *numbers])),
            capture_output=True,
            text=True,
            check=False,
            timeout=120,
            env=self.environment,
        )
        assert done.returncode == 0, done.stderr
        return [float.fromhex(line) for line in done.stdout.split()]


def unit_for(platforms, folder, *name):
    """A unit with libraries for platforms, and the folder into which it is unpacked."""
    try:
        fmu = build_fmu(folder, *name, platforms=platforms)
    except FmuBuildError as error:
        pytest.skip(str(error))
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(folder)
    if not [*folder.glob("binaries/*/*.dll")]:
        pytest.skip("needs the libraries of an installed package, or ziglang")
    return fmu


@pytest.fixture(scope="module")
def block(wine, host, environment, tmp_path_factory):
    folder = tmp_path_factory.mktemp("block")
    unit_for([WINDOWS], folder)
    return Windows([wine, host], environment, folder, native, references())


@pytest.fixture(scope="module")
def heat(wine, host, environment, tmp_path_factory):
    """The heat's unit as a file, and its library for Windows."""
    folder = tmp_path_factory.mktemp("heat")
    fmu = unit_for([this_platform(), WINDOWS], folder, THERMAL)
    return fmu, Windows([wine, host], environment, folder, native_unit, references(reduced()))


PLANAR = {"lateral_friction": {"ratio": 1.0}, "initial": {"phi": 0.05}}
WEAKENING = {"velocity_weakening": {"linear": 0.8}}


@pytest.mark.parametrize("output", ["x", "phi", "heat"])
@pytest.mark.parametrize("tables", [{}, PLANAR, WEAKENING], ids=["line", "plane", "weakening"])
def test_the_windows_library_moves_as_the_model_does(block, tables, output):
    parameters = Parameters(**tables)
    own = simulate(parameters, STEPS * STEP, STEP)[output][1:]
    values = PLAIN | {f"{table}.{key}": n for table in tables for key, n in tables[table].items()}
    # The sines of another C library differ in the last place, which comes to 4e-14 over these 5 s;
    # products that are rounded once with a sum instead of twice would come to more.
    np.testing.assert_allclose(block(output, STEPS, STEP, **values), own, rtol=0, atol=1e-12)


def test_instances_in_threads_of_windows_are_each_as_alone(block):
    alone = block("x", 200, STEP)[-1]
    assert block("x", 200, STEP, instances=2, threads=4) == [alone] * 8


@pytest.mark.parametrize("output", ["interface_temperature", "melted_mass"])
def test_the_windows_library_of_the_heat_is_that_of_this_machine(heat, output):
    fmu, under_wine = heat
    values = {"heat_flow": 20.0, "surface_speed": 0.5, "ambient.temperature_degC": -0.05}
    here = fmpy.simulate_fmu(
        str(fmu), start_values=values, stop_time=3.0, output_interval=0.01, output=[output]
    )[output][1:]
    assert abs(here[-1]) > 1e-5
    # 0.09 degC and 0.16 g are reached; what differs is rounding
    np.testing.assert_allclose(under_wine(output, 300, 0.01, **values), here, rtol=0, atol=1e-12)
