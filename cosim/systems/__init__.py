"""Systems of units from files: SSP, or TOML; knows of a unit its file and its ports, no model.

>>> from cosim.systems import read_system, run_system
"""

from cosim.systems.run import SystemRun, read_system, run_system
from cosim.systems.specification import SystemFault

__all__ = ["SystemFault", "SystemRun", "read_system", "run_system"]
