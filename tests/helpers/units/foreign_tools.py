"""Programs and libraries that packages of other tools bring, wherever they are installed."""

import os
import shutil
from importlib.metadata import PackageNotFoundError, files
from pathlib import Path


def tools(distribution, name):
    """All places in which a package has put a program or a library."""
    try:
        found = [Path(each.locate()).resolve() for each in files(distribution) or ()]
    except PackageNotFoundError:
        found = []
    on_the_path = shutil.which(name)
    return [each for each in found if each.name == name] + [Path(p) for p in [on_the_path] if p]


def ecos_environment():
    """ecospy needs tbb, does not find it, and its programs come without the right to be run."""
    for name in ("ecos", "proxyfmu"):
        for program in tools("ecospy", name):
            program.chmod(0o755)
    libraries = tools("tbb", "libtbb.so.12")
    return os.environ | ({"LD_LIBRARY_PATH": str(libraries[0].parent)} if libraries else {})
