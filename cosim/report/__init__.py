"""Results of a run: dataset, files, summary, figures and page.

>>> from cosim.report import run_dataset, trajectory_dataset, write_results
"""

from cosim.lazy import lazy

__getattr__, __dir__, __all__ = lazy(__name__, __file__)
