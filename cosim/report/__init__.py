"""Results of a run: dataset, files, summary, figures and page.

>>> from cosim.report import run_dataset, trajectory_dataset, write_results
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from cosim.files import OutputError as OutputError
    from cosim.report.contents import Views as Views
    from cosim.report.dataset import run_dataset as run_dataset
    from cosim.report.dataset import trajectory_dataset as trajectory_dataset
    from cosim.report.results import write_data as write_data
    from cosim.report.results import write_results as write_results
    from cosim.report.run_summary import summary as summary

_HOMES = {
    "cosim.files": "OutputError",
    "cosim.report.contents": "Views",
    "cosim.report.dataset": "run_dataset trajectory_dataset",
    "cosim.report.results": "write_data write_results",
    "cosim.report.run_summary": "summary",
}
_HOME = {name: home for home, names in _HOMES.items() for name in names.split()}
__all__ = sorted(_HOME)


def __getattr__(name: str) -> Any:
    """Import on first use: who wants words and style of a page needs no model of the motion."""
    if name in _HOME:
        return getattr(import_module(_HOME[name]), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return __all__
