"""Names of a package that are imported when they are first asked for.

Where they are stands in the package's stub, `__init__.pyi`, which type checkers read, too.
"""

import re
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any


def lazy(
    package: str, file: str
) -> tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]:
    """What a package has as `__getattr__`, `__dir__` and `__all__`; file: its own."""
    stub = Path(file).with_suffix(".pyi").read_text(encoding="utf-8")
    home = {name: module for module, name in re.findall(r"(?m)^from (\S+) import (\w+) as", stub)}
    public = sorted(home)

    def named(name: str) -> Any:
        if name in home:
            return getattr(import_module(home[name]), name)
        raise AttributeError(f"module {package!r} has no attribute {name!r}")

    return named, lambda: public, public
