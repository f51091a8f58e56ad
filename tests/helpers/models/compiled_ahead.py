"""Fill numba's caches with what tests compile beside the kernel, by calling each once.

    python tests/helpers/models/compiled_ahead.py

What is left out, or changes, is compiled where it is used, by every worker that uses it.
"""

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
from blind.laboratory.apparatus import apparatus  # noqa: E402
from blind.laboratory.simulation import COLUMNS, simulate  # noqa: E402
from blind.motion import walk  # noqa: E402
from blind.simulator.hidden import Hidden, State  # noqa: E402


def compile_all() -> None:
    """Both foreign simulators."""
    simulate(apparatus(0.67, 20.0, 0.1, 0.1, 0.1, contact="jump"), np.zeros(COLUMNS), 1e-3)
    for plane in (False, True):
        walk(Hidden(), State(), plane, 1e-3, 1)


if __name__ == "__main__":
    compile_all()
