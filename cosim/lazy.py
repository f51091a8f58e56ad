"""Names of a package that are imported when they are first asked for.

They are declared once, where type checkers read them: imported under TYPE_CHECKING.
"""

import ast
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any


def lazy(
    package: str, file: str
) -> tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]:
    """What a package has as `__getattr__`, `__dir__` and `__all__`.

    file: of its text, in which what stands under an `if` is imported by the name alone.
    """
    blocks = ast.parse(Path(file).read_text(encoding="utf-8")).body
    imports = [each for block in blocks if isinstance(block, ast.If) for each in block.body]
    home = {
        name.name: each.module or ""
        for each in imports
        if isinstance(each, ast.ImportFrom)
        for name in each.names
    }
    public = sorted(home)

    def named(name: str) -> Any:
        if name in home:
            return getattr(import_module(home[name]), name)
        raise AttributeError(f"module {package!r} has no attribute {name!r}")

    return named, lambda: public, public
