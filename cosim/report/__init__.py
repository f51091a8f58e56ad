"""Results of a run: dataset, files, summary, figures and page.

>>> from cosim.report import run_columns, trajectory_columns, write_results
"""

from stickslip.lazy import lazy

# who wants words and style of a page needs no model of the motion
__getattr__, __dir__, __all__ = lazy(__name__, __file__)
