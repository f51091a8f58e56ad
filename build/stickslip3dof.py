"""Makes StickSlip3DOF.fmu.

    python build/stickslip3dof.py [DIRECTORY]

makes DIRECTORY/StickSlip3DOF.fmu (DIRECTORY: where this file is). What goes in, and how it becomes
an FMU, is in `cosim.fmu.stickslip3dof`.
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "fmu_src")]

from cosim.fmu.stickslip3dof import build  # noqa: E402  (found by the path set above)

if __name__ == "__main__":
    print(build(Path(sys.argv[1]) if len(sys.argv) > 1 else HERE))
