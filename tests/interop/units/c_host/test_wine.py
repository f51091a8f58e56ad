"""The units' libraries for Windows, in the host written in C, under wine.

Host and libraries are compiled by MinGW, the libraries as the package compiles them. Those that an
installed package brings, or that zig makes, are for `pytest -m slow`: zig first compiles a runtime
of its own, for more than a minute. (Where the tests run on Windows they are what all tests load.)
"""

import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from c_library import HOST, Host, unpacked
from c_unit import references
from plain_start import PLAIN
from stickslip import Parameters, simulate
from stickslip.generation.compiler import OPTIONS
from stickslip.generation.platforms import PLATFORMS, this_platform

from cosim.fmu import native
from cosim.fmu.build import NATIVE, THERMAL, FmuBuildError, build_fmu
from cosim.fmu.thermal import native_unit
from cosim.fmu.thermal.variables import reduced

(WINDOWS,) = (each for each in PLATFORMS if each.suffix == ".dll")
MINGW = "x86_64-w64-mingw32-gcc"
# exact in binary, so that host and simulation speak of the same instants
STEP, STEPS = 0.0078125, 640

pytestmark = [
    pytest.mark.skipif(sys.platform != "linux", reason="for wine on Linux"),
    pytest.mark.skipif(shutil.which(MINGW) is None, reason=f"needs {MINGW}"),
]


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
    return {"WINEPREFIX": str(prefix), "WINEBOOTSTRAPMODE": "1", "WINEDEBUG": "-all"}


def compiled(made, *arguments):
    command = [MINGW, "-std=c99", "-O2", "-s", "-static", *arguments, "-o", made]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return made


@pytest.fixture(scope="module")
def host(wine, environment, tmp_path_factory):
    """Folder and library -> the host with it; not compiled where there is no wine to run it."""
    program = tmp_path_factory.mktemp("windows") / "host.exe"
    headers = f"-I{native.native_folder() / 'headers'}"
    compiled(program, "-Wall", "-Wextra", "-Werror", headers, HOST, "-lpthread")

    return lambda library, made_by, resources, places: Host(
        [wine, program], library, made_by.guid(), places,
        **environment, RESOURCES=f"file:///Z:{resources}",
    )  # fmt: skip


def by_mingw(name, made_by, folder):
    """The unit for this machine, and a library of its sources for Windows."""
    fmu = build_fmu(folder, name, platforms=[this_platform()])
    sources = folder / "compiled"
    sources.mkdir()
    for file, content in made_by.sources().items():
        (sources / file).write_bytes(content)
    library = sources / f"{made_by.NAME}.dll"
    return fmu, compiled(library, *OPTIONS, "-shared", *sorted(sources.glob("*.c")))


def as_delivered(name, made_by, folder):
    """The unit with both libraries."""
    try:
        fmu = build_fmu(folder, name, platforms=[this_platform(), WINDOWS])
    except FmuBuildError as error:
        pytest.skip(str(error))
    library = f"binaries/{WINDOWS.fmi2}/{made_by.NAME}.dll"
    with zipfile.ZipFile(fmu) as archive:
        if library not in archive.namelist():
            pytest.skip("needs the libraries of an installed package, or ziglang")
        return fmu, Path(archive.extract(library, folder))


@pytest.fixture(
    scope="module", params=[by_mingw, pytest.param(as_delivered, marks=pytest.mark.slow)]
)
def made(request):
    return request.param


@pytest.fixture(scope="module")
def block(host, made, tmp_path_factory):
    folder = tmp_path_factory.mktemp("block")
    _, library = made(NATIVE, native, folder)
    return host(library, native, folder, references())


@pytest.fixture(scope="module")
def heat(host, made, tmp_path_factory):
    """The heat's unit as a file, and its library for Windows."""
    folder = tmp_path_factory.mktemp("heat")
    fmu, library = made(THERMAL, native_unit, folder)
    resources = unpacked(fmu, folder, "resources")
    return fmu, host(library, native_unit, resources, references(reduced()))


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
