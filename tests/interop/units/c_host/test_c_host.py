"""The native unit in a host written in C: no Python anywhere in the process."""

import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from c_library import SANITIZERS, compiled, compiler, host_in
from native_unit import library_of, references
from plain_start import PLAIN
from stickslip import Parameters, simulate

from cosim.fmu.native import NAME, built_guid

# exact in binary, so that host and simulation speak of the same instants
STEP = 0.0078125
PLANAR = {**PLAIN, "lateral_friction.ratio": 1.0, "initial.phi": 0.05}

pytestmark = [
    pytest.mark.skipif(sys.platform != "linux", reason="the host is written for Linux"),
    pytest.mark.skipif(not compiler(), reason="needs a C compiler"),
]


@pytest.fixture(scope="module")
def sources(fmu, tmp_path_factory):
    """Folder of the sources that the unit brings along."""
    folder = tmp_path_factory.mktemp("unit")
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(
            folder, [name for name in archive.namelist() if name.startswith("sources/")]
        )
    return folder / "sources"


@pytest.fixture(scope="module")
def run(fmu, tmp_path_factory):
    """The host, compiled once; called with numbers of steps, instances and threads."""
    folder = tmp_path_factory.mktemp("host")
    return Host([host_in(folder)], library_of(fmu, folder), built_guid(fmu))


class Host:
    def __init__(self, command, library, guid):
        self.command, self.library, self.guid = command, library, guid

    def under(self, *tool):
        """The same host inside another program."""
        return Host([*tool, *self.command], self.library, self.guid)

    def __call__(self, steps, instances=1, threads=1, size=STEP, output="x", **values):
        places = references()
        command = [
            *self.command,
            *(self.library, self.guid, steps, size, places[output], instances, threads),
            *(f"{places[name]}={value!r}" for name, value in values.items()),
        ]
        done = subprocess.run(
            list(map(str, command)),
            capture_output=True,
            text=True,
            check=False,
            env={"PATH": os.environ["PATH"]},
        )
        assert done.returncode == 0, done.stderr
        return [float.fromhex(line) for line in done.stdout.split()]


def simulated(steps, interpreted, output="x"):
    parameters = Parameters(lateral_friction={"ratio": 1.0}, initial={"phi": 0.05})
    trajectory = simulate(parameters, steps * STEP, STEP, interpreted=interpreted)
    return trajectory[output][1:]


@pytest.mark.parametrize("output", ["x", "phi", "heat"])
def test_the_motion_is_that_of_the_kernel_to_the_last_bit(run, output):
    assert run(256, output=output, **PLANAR) == simulated(256, True, output).tolist()


def test_a_hundred_instances_are_each_as_alone(run):
    alone = run(200)[-1]
    assert run(200, instances=100) == [alone] * 100


def test_instances_in_eight_threads_are_each_as_alone(run):
    alone = run(500, **PLANAR)[-1]
    assert run(500, instances=4, threads=8, **PLANAR) == [alone] * 32


@pytest.mark.parametrize(
    ("steps", "instances", "threads"), [(10_000, 1, 1), (5, 100, 1), (20, 2, 8)]
)
def test_memory_is_used_as_it_should_be(run, steps, instances, threads):
    """Nothing read that was not written, nothing beyond its end, and all given back."""
    if shutil.which("valgrind") is None:
        pytest.skip("needs valgrind")
    checked = run.under("valgrind", "-q", "--error-exitcode=9", "--leak-check=full")
    numbers = checked(steps, instances, threads, size=1e-3)
    assert len(set(numbers)) == (steps if instances == 1 else 1)


def test_sources_have_no_undefined_behaviour(run, sources, tmp_path):
    """The sanitizers of gcc, which end the process at the first finding."""
    tried = [*compiler(), *SANITIZERS, "-x", "c", "-", "-o", str(tmp_path / "tried")]
    if subprocess.run(tried, input=b"int main(void){return 0;}", capture_output=True).returncode:
        pytest.skip("needs a compiler with sanitizers")
    library = tmp_path / "unit.so"
    written = sorted(sources.glob("*.c"))
    strict = ["-std=c99", "-ffp-contract=off", "-fPIC", "-shared"]
    compiled(*SANITIZERS, *strict, "-o", library, *written, "-lm", folder=sources)
    # the host, since a library that brings its own runtime must be the first that is loaded
    checked = Host([host_in(tmp_path, *SANITIZERS)], library, run.guid)
    assert checked(2000, **PLANAR) == run(2000, **PLANAR)
    assert checked(20, 4, 8) == run(20, 4, 8)


def test_sources_compile_without_a_warning(sources, tmp_path):
    strict = ["-std=c99", "-O1", "-fPIC", "-shared", "-Wall", "-Wextra", "-Wpedantic", "-Werror"]
    made = tmp_path / f"{NAME}.so"
    compiled(*strict, "-o", made, *sorted(sources.glob("*.c")), "-lm", folder=sources)


def test_fmpy_compiles_the_sources(fmu, run, tmp_path):
    if shutil.which("cmake") is None:
        pytest.skip("needs cmake")
    copy = Path(shutil.copy(fmu, tmp_path))
    command = [sys.executable, "-m", "fmpy", "compile", str(copy)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    assert library_of(copy, tmp_path / "made").read_bytes() != run.library.read_bytes()
    # in fmpy, since it does not link the mathematical library, which Python has anyway
    result = fmpy.simulate_fmu(str(copy), stop_time=500 * STEP, output_interval=STEP, output=["x"])
    np.testing.assert_allclose(result["x"][1:], run(500), rtol=0, atol=1e-10)
