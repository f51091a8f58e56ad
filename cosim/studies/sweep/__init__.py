"""Parameter sweeps: every combination of some values, on all cores or a Dask cluster.

>>> from cosim.studies.sweep import sweep
>>> from cosim import read_scenario
>>> vary = {"rig.mass": [0.67, 2.03], "surface.speed": [0.15, 0.5]}
>>> short = read_scenario().changed({"run.duration": 2.0})
>>> sweep(short, vary, folder="results/sweep").x_mean.shape
(2, 2)
"""

from .axis import SweepError
from .combination import Run, SweepStopped
from .features import FEATURES, features
from .grid import Grid, product_grid
from .run import run_grid, sweep

__all__ = [
    "FEATURES",
    "Grid",
    "Run",
    "SweepError",
    "SweepStopped",
    "features",
    "product_grid",
    "run_grid",
    "sweep",
]
