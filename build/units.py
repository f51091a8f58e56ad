"""Makes the units.

    python build/units.py [DIRECTORY]

makes the units and the system of them in DIRECTORY (default: where this file is).
What goes in, and how it becomes a unit, is in `cosim.fmu`.
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "fmu_src")]

from cosim.fmu.build import build_fmu  # noqa: E402  (found by the path set above)
from cosim.fmu.unit_files import UNITS  # noqa: E402

if __name__ == "__main__":
    for name in UNITS:
        print(build_fmu(Path(sys.argv[1]) if len(sys.argv) > 1 else HERE, name))
