"""Parameter sweeps: every combination of some values, on all cores or a Dask cluster.

>>> from cosim.studies.sweep import sweep
>>> from cosim import read_scenario
>>> vary = {"rig.mass": [0.67, 2.03], "surface.speed": [0.15, 0.5]}
>>> short = read_scenario().changed({"run.duration": 2.0})
>>> sweep(short, vary, folder="results/sweep").x_mean.shape
(2, 2)
"""

from .axis import SweepError as SweepError
from .combination import Run as Run
from .combination import SweepStopped as SweepStopped
from .features import FEATURES as FEATURES
from .features import features as features
from .grid import Grid as Grid
from .grid import product_grid as product_grid
from .run import run_grid as run_grid
from .run import sweep as sweep
