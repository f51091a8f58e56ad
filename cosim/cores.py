"""How many processes can compute at once."""

import os
import sys

#: Cores that this process may use.
CORES = len(os.sched_getaffinity(0)) if sys.platform == "linux" else os.cpu_count() or 1
