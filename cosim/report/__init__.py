"""Results of a run: dataset, files, summary, figures and page.

>>> from cosim.report import run_dataset, trajectory_dataset, write_results
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from cosim.files import OutputError
    from cosim.report.contents import Views
    from cosim.report.dataset import run_dataset, trajectory_dataset
    from cosim.report.results import write_data, write_results
    from cosim.report.run_summary import summary

__all__ = [
    "OutputError",
    "Views",
    "run_dataset",
    "summary",
    "trajectory_dataset",
    "write_data",
    "write_results",
]

_HOME = {
    "OutputError": "cosim.files",
    "Views": "cosim.report.contents",
    "run_dataset": "cosim.report.dataset",
    "trajectory_dataset": "cosim.report.dataset",
    "write_data": "cosim.report.results",
    "write_results": "cosim.report.results",
    "summary": "cosim.report.run_summary",
}


def __getattr__(name: str) -> Any:
    """Import on first use: who wants words and style of a page needs no model of the motion."""
    if name in _HOME:
        return getattr(import_module(_HOME[name]), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
