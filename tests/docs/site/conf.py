"""Sphinx: MyST pages, notebooks that are executed, equations as MathML, references made from code.

Built by `tests/docs/build_site.py`, which says where the checkout and the output are.
"""

import os
import sys
from importlib.metadata import version as installed_version
from pathlib import Path

from jupyter_cache import get_cache
from jupyter_cache.executors import utils as executors

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
CHECKOUT = Path(os.environ["STICKSLIP_CHECKOUT"])

project = "stickslip"
author = "The stickslip developers"
project_copyright = "The stickslip developers, BSD-3-Clause"
release = version = installed_version("stickslip")

extensions = ["myst_nb", "sphinx.ext.autodoc", "making.docstrings", "making.mathml", "making.pages"]
# parts of pages, which are taken in by these
exclude_patterns = ["made"]
myst_enable_extensions = ["dollarmath", "colon_fence", "deflist"]
myst_heading_anchors = 3

# every cell has been executed before Sphinx begins (notebooks.py), and is looked up here
nb_execution_mode = "force"
nb_execution_raise_on_error = True


def looked_up(notebook, **_):
    """In place of executing: a page that was not executed is an error, KeyError.

    Into the notebook itself: the extension's own cache shows what it holds, but has notebooks
    downloaded without it.
    """
    _, executed = get_cache(os.environ["STICKSLIP_NOTEBOOKS"]).merge_match_into_notebook(notebook)
    notebook.metadata.update(executed.metadata)
    for cell, done in zip(notebook.cells, executed.cells, strict=True):
        cell.update(done)


executors.executenb = looked_up

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_preserve_defaults = True

html_theme = "furo"
html_title = "stickslip"
html_math_renderer = "mathml"
html_show_sourcelink = False
html_theme_options = {"navigation_with_keys": True}
# boxes that scroll can be reached with the keyboard, as on the pages of the commands
html_static_path = ["static", str(CHECKOUT / "cosim" / "report" / "templates" / "page.js")]
html_js_files = [("page.js", {"defer": "defer"})]
html_css_files = ["site.css"]
