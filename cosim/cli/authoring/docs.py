"""`stickslip docs`: the documentation in the browser."""

import subprocess
import sys
import webbrowser
from argparse import Namespace
from importlib.resources import files
from importlib.util import find_spec
from pathlib import Path

import cosim
from cosim.cli import DONE, BadInput, Failed
from cosim.cli.console import note

#: In a package that was released; in a checkout.
INSTALLED, BUILT = "documentation/index.html", "results/site/html/index.html"
BUILDER = "tests/docs/build_site.py"
#: What building needs, of the extra `docs`.
NEEDED = ("sphinx", "myst_nb", "furo", "latex2mathml")


def execute(arguments: Namespace) -> int:
    """Find it, or build it; say where it is, open it."""
    page = built() if arguments.build else found() or built()
    print(page)
    if not arguments.no_open and not webbrowser.open(page.resolve().as_uri()):
        print("no browser to be found: open it yourself")
    return DONE


def found() -> Path | None:
    """The start page of the installed copy, or of the one that was built here."""
    installed = Path(str(files("cosim") / INSTALLED))
    checkout = _checkout()
    places = [installed] if checkout is None else [installed, checkout / BUILT]
    return next((page for page in places if page.is_file()), None)


def built() -> Path:
    """The start page of a copy that is built now. BadInput where it cannot be."""
    checkout = _checkout()
    if checkout is None:
        raise BadInput(
            "the documentation: is neither installed, as a released wheel has it, nor in a "
            "checkout here, allowed is to run this in the folder where tests/docs is"
        )
    if lacking := [name for name in NEEDED if find_spec(name) is None]:
        raise BadInput(
            f"the documentation: building it needs {', '.join(lacking)}: pip install"
            f' "{checkout}[docs]"'
        )
    note("building the documentation, a minute or two the first time")
    page = checkout / BUILT
    done = subprocess.run(
        [sys.executable, checkout / BUILDER, page.parents[1]],
        stdout=subprocess.DEVNULL,
        check=False,
    )
    if done.returncode:
        raise Failed("the documentation: was not built, see above")
    return page


def _checkout() -> Path | None:
    """Where the sources are: the working directory, or where the package is used from."""
    places = (Path.cwd(), Path(cosim.__file__).resolve().parents[1])
    return next((place for place in places if (place / BUILDER).is_file()), None)
