"""Names of a package that are imported when they are first asked for.

Type checkers read none of this: beside it the package imports the same names under TYPE_CHECKING.
"""

from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any


def lazy(
    package: str, homes: Mapping[str, str]
) -> tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]:
    """What a package has as `__getattr__`, `__dir__` and `__all__`.

    homes: module, ".name" of one inside the package -> its names, blanks between them.
    """
    home = {name: module for module, names in homes.items() for name in names.split()}
    public = sorted(home)

    def named(name: str) -> Any:
        if name in home:
            return getattr(import_module(home[name], package), name)
        raise AttributeError(f"module {package!r} has no attribute {name!r}")

    return named, lambda: public, public
