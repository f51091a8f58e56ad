"""Tables that ship with the package, beside the code that reads them."""

import tomllib
from importlib.resources import files
from typing import Any


def packaged_tables(package: str | None, name: str) -> dict[str, Any]:
    """A TOML file of a package; package: as a module's `__package__`."""
    return tomllib.loads((files(package or "") / name).read_text(encoding="utf-8"))
