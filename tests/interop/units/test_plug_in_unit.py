"""An effect from outside in the units: found by a host as any parameter, the same motion."""

import subprocess
import sys
from pathlib import Path

EFFECT = Path(__file__).resolve().parents[2] / "examples" / "effects" / "flash_heating.py"


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
