"""Sphinx: MyST pages, notebooks that are executed, equations as MathML, references made from code.

Built by `tests/docs/build_site.py`, which says where the checkout and the output are.
"""

import os
import sys
from functools import partial
from importlib.metadata import version as installed_version
from pathlib import Path

from jupyter_cache.executors import utils as executors

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
CHECKOUT = Path(os.environ["STICKSLIP_CHECKOUT"])

project = "stickslip"
author = "The stickslip developers"
project_copyright = "The stickslip developers, BSD-3-Clause"
release = version = installed_version("stickslip")

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "making.docstrings",
    "making.mathml",
    "making.pages",
]
# parts of pages, which are taken in by these
exclude_patterns = ["made"]
myst_enable_extensions = ["dollarmath", "colon_fence", "deflist"]
myst_heading_anchors = 3

# every cell is executed, and one that fails is an error of the build
nb_execution_mode = "cache"
nb_execution_cache_path = str(Path(os.environ["STICKSLIP_SITE"]) / "cache")
nb_execution_in_temp = True
nb_execution_raise_on_error = True
nb_execution_timeout = 600
# what a command prints comes in pieces of a pipe; myst-nb's own merging would end lines there
executors.executenb = partial(executors.executenb, coalesce_streams=True)

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_preserve_defaults = True

html_theme = "furo"
html_title = "stickslip"
html_math_renderer = "mathml"
html_show_sourcelink = False
html_theme_options = {"navigation_with_keys": True}
html_static_path = ["static"]
html_css_files = ["tables.css"]
