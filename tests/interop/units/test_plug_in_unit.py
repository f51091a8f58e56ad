"""An effect from outside in the units: found by a host as any parameter, the same motion."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

EFFECT = Path(__file__).resolve().parents[2] / "examples" / "effects" / "flash_heating.py"
#: Builds a unit and runs it through fmpy, beside the model in this process, interpreted.
PROGRAM = """
import json, sys
import numpy as np
from fmpy import read_model_description, simulate_fmu
from stickslip import Parameters, simulate
from cosim.fmu.build import build_fmu
from stickslip.generation.platforms import this_platform

Own = Parameters.with_effects(sys.argv[1])
fmu = build_fmu(sys.argv[2], sys.argv[3], [this_platform()], Own.catalogue)
parameters = Own(
    rig={"spring_natural_length": 0.17},
    initial={"vx": 0.15},
    flash_heating={"fall": 0.6, "onset": 0.06},
)
model = simulate(parameters, 1.0, 0.02, interpreted=True)
plain = simulate(parameters.model_copy(update={"flash_heating": Own().flash_heating}),
    1.0, 0.02, interpreted=True)
unit = simulate_fmu(str(fmu), stop_time=1.0, step_size=0.02, output_interval=0.02,
    start_values=parameters.flat() | {"surface_speed": 0.15}, output=["x", "heat", "phi"])
shown = [each for each in read_model_description(str(fmu)).modelVariables
    if each.name.startswith("flash_heating.")]
print(json.dumps({
    "shown": {each.name: [each.unit, each.start] for each in shown},
    "differ": max(float(np.abs(unit[name] - model[name]).max()) for name in ("x", "heat", "phi")),
    "felt": float(np.abs(plain["x"] - model["x"]).max()),
}))
"""


def run(folder, unit, **variables):
    return subprocess.run(
        [sys.executable, "-c", PROGRAM, EFFECT, folder, unit],
        capture_output=True, text=True, cwd=folder, env=os.environ | variables,
    )  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("unit", ["StickSlip3DOF.fmu", "StickSlip3DOF-python.fmu"])
def test_the_unit_moves_as_the_model_does(unit, tmp_path):
    done = run(tmp_path, unit)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout.splitlines()[-1])
    assert found["felt"] > 1e-3
    # the same text, at steps that a host cuts: rounding alone, as without the effect
    assert found["differ"] < 1e-9
    assert found["shown"] == {
        "flash_heating.fall": ["1", "0.0"],
        "flash_heating.onset": ["m/s", "0.1"],
    }


WITHOUT = """
import sys
from stickslip import Parameters
from stickslip.generation import compiler
compiler.has_zig = lambda: False
compiler.system_compiler = lambda: None
from cosim.fmu.build import FmuBuildError, build_fmu
try:
    build_fmu(sys.argv[2], catalogue=Parameters.with_effects(sys.argv[1]).catalogue)
except FmuBuildError as error:
    print(error)
"""


def test_without_a_compiler_the_remedy_is_said(tmp_path):
    done = subprocess.run(
        [sys.executable, "-c", WITHOUT, EFFECT, tmp_path], capture_output=True, text=True
    )
    (line,) = done.stdout.splitlines()
    assert "pip install ziglang" in line and "StickSlip3DOF-python.fmu" in line, done.stderr
