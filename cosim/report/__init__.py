"""Results of a run: dataset, files, summary, figures and page.

>>> from cosim.report import run_dataset, trajectory_dataset, write_results
"""

from cosim.files import OutputError

from .dataset import run_dataset, trajectory_dataset
from .results import Views, write_data, write_results
from .summary import summary

__all__ = [
    "OutputError",
    "Views",
    "run_dataset",
    "summary",
    "trajectory_dataset",
    "write_data",
    "write_results",
]
