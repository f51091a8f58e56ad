"""The native unit in a host written in C: no Python anywhere in the process."""

import shutil
import subprocess
import sys
from pathlib import Path

import fmpy
import numpy as np
import pytest
from c_library import SANITIZERS, Host, compiled, compiler, host_in, unpacked
from c_unit import library_of, references
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
    return unpacked(fmu, tmp_path_factory.mktemp("unit"), "sources")


@pytest.fixture(scope="module")
def run(fmu, tmp_path_factory):
    """The host, compiled once; called with numbers of steps, instances and threads."""
    folder = tmp_path_factory.mktemp("host")
    return Host([host_in(folder)], library_of(fmu, folder), built_guid(fmu), references())


@pytest.mark.parametrize("output", ["x", "phi", "heat"])
def test_the_motion_is_that_of_the_kernel_to_the_last_bit(run, output):
    parameters = Parameters(lateral_friction={"ratio": 1.0}, initial={"phi": 0.05})
    kernel = simulate(parameters, 256 * STEP, STEP, interpreted=True)
    assert run(output, 256, STEP, **PLANAR) == kernel[output][1:].tolist()


@pytest.mark.parametrize(
    ("steps", "instances", "threads", "values"), [(200, 100, 1, {}), (500, 4, 8, PLANAR)]
)
def test_instances_are_each_as_alone_also_in_threads(run, steps, instances, threads, values):
    alone = run("x", steps, STEP, **values)[-1]
    assert run("x", steps, STEP, instances, threads, **values) == [alone] * instances * threads


@pytest.mark.parametrize(
    ("steps", "instances", "threads"), [(10_000, 1, 1), (5, 100, 1), (20, 2, 8)]
)
def test_memory_is_used_as_it_should_be(run, steps, instances, threads):
    """Nothing read that was not written, nothing beyond its end, and all given back."""
    if shutil.which("valgrind") is None:
        pytest.skip("needs valgrind")
    checked = run.under("valgrind", "-q", "--error-exitcode=9", "--leak-check=full")
    numbers = checked("x", steps, 1e-3, instances, threads)
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
    checked = Host([host_in(tmp_path, *SANITIZERS)], library, run.guid, run.places)
    assert checked("x", 2000, STEP, **PLANAR) == run("x", 2000, STEP, **PLANAR)
    assert checked("x", 20, STEP, 4, 8) == run("x", 20, STEP, 4, 8)


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
    np.testing.assert_allclose(result["x"][1:], run("x", 500, STEP), rtol=0, atol=1e-10)
