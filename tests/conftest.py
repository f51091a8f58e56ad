"""Every worker computes on its own core: the matrices here are too small to be shared out.

BLAS would start a thread for each core of the machine in each worker of a parallel run, and they
would wait for each other. Set before anything imports numpy, which reads it once.
"""

import os

for library in ("OPENBLAS", "MKL", "OMP"):
    os.environ.setdefault(f"{library}_NUM_THREADS", "1")
