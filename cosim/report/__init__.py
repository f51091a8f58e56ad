"""Results of a run: dataset, files, summary, figures and page.

>>> from cosim.report import run_dataset, trajectory_dataset, write_results
"""

from typing import TYPE_CHECKING

from cosim.lazy import lazy

if TYPE_CHECKING:
    from cosim.files import OutputError as OutputError
    from cosim.report.contents import Views as Views
    from cosim.report.dataset import run_dataset as run_dataset
    from cosim.report.dataset import trajectory_dataset as trajectory_dataset
    from cosim.report.results import write_data as write_data
    from cosim.report.results import write_results as write_results
    from cosim.report.run_summary import summary as summary

# who wants words and style of a page needs no model of the motion
__getattr__, __dir__, __all__ = lazy(
    __name__,
    {
        "cosim.files": "OutputError",
        "cosim.report.contents": "Views",
        "cosim.report.dataset": "run_dataset trajectory_dataset",
        "cosim.report.results": "write_data write_results",
        "cosim.report.run_summary": "summary",
    },
)
