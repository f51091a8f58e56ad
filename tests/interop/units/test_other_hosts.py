"""The native unit in tools that other people use: the same motion as in fmpy.

Each in a process of its own, with the lines of the scripts in `hosts`. A tool that is not installed
is skipped.
"""

import importlib.util
import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from foreign_tools import ecos_environment, tools

from cosim.fmu.build import PYTHON, build_fmu

SPEED, STEP, COUNT = 0.2, 0.01, 300
HOSTS = Path(__file__).with_name("hosts")


def needs(module):
    if importlib.util.find_spec(module) is None:
        pytest.skip(f"needs {module}")


def needs_ecospy():
    needs("ecospy")
    tool("tbb", "libtbb.so.12")


def tool(distribution, name):
    """A program that a package has brought."""
    found = tools(distribution, name)
    return found[0] if found else pytest.skip(f"needs {name} of {distribution}")


def output(command, **more):
    """What a command says; it works in a folder of its own, as tools leave logs where they are."""
    with tempfile.TemporaryDirectory() as scratch:
        done = subprocess.run(
            list(map(str, command)), **{"cwd": scratch} | more, capture_output=True, text=True,
            check=False, timeout=120,
        )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout + done.stderr


def x_by(script, fmu, **more):
    said = output([sys.executable, HOSTS / script, fmu, SPEED, STEP, COUNT], **more)
    return [float(line.split()[1]) for line in said.splitlines() if line.startswith("x ")]


def x_in_fmpy(fmu):
    result = fmpy.simulate_fmu(
        str(fmu), stop_time=COUNT * STEP, output_interval=STEP,
        start_values={"surface_speed": SPEED}, output=["x"],
    )  # fmt: skip
    return result["x"][1:]


@pytest.fixture(scope="module")
def expected(fmu):
    return x_in_fmpy(fmu)


@pytest.fixture(scope="module")
def without_integers(fmu, tmp_path_factory):
    """A copy whose integer outputs are not declared, for tools that read all outputs as real."""
    copy = tmp_path_factory.mktemp("real") / "real.fmu"
    changed = ["-remove-regexp", "^(mode|slip_count)$", "-output", copy]
    output([tool("fmu-manipulation-toolbox", "fmutool"), "-input", fmu, *changed])
    return copy


def same(x, expected, tolerance=1e-10):
    assert len(x) == len(expected)
    np.testing.assert_allclose(x, expected, rtol=0, atol=tolerance)


@pytest.mark.parametrize("unit", ["fmu", "fmu3"])
def test_ecospy(request, unit, expected):
    needs_ecospy()
    x = x_by("in_ecospy.py", request.getfixturevalue(unit), env=ecos_environment())
    same(x, expected)


def test_fmuloader(fmu, expected):
    needs("fmuloader")
    if fmpy.read_model_description(fmu).modelExchange is None:
        pytest.skip("fmuloader asks every unit for the functions of model exchange")
    same(x_by("in_fmuloader.py", fmu), expected)


def test_pathsim(without_integers, expected):
    needs("pathsim_fmi")
    same(x_by("in_pathsim.py", without_integers), expected)


def test_a_container_of_fmutool_runs_it(fmu, expected, tmp_path):
    program = tool("fmu-manipulation-toolbox", "fmucontainer")
    shutil.copy(fmu, tmp_path)
    described = {
        "name": "container.fmu", "fmu": [fmu.name], "step_size": STEP,
        "input": [["surface_speed", fmu.name, "surface_speed"]], "output": [[fmu.name, "x", "x"]],
    }  # fmt: skip
    (tmp_path / "container.json").write_text(json.dumps(described))
    output([program, "-fmu-directory", tmp_path, "-container", "container.json"], cwd=tmp_path)
    same(x_in_fmpy(tmp_path / "container.fmu"), expected)


@pytest.mark.parametrize("name", ["native", "python"])
def test_fmutool_finds_nothing_wrong(fmu, tmp_path, name):
    program = tool("fmu-manipulation-toolbox", "fmutool")
    file = fmu if name == "native" else build_fmu(tmp_path, PYTHON)
    said = output([program, "-input", file, "-check"])
    assert "seems to be compliant with FMI-2.0" in said and "No semantic error" in said
    assert "WARNING" not in said and "ERROR" not in said
