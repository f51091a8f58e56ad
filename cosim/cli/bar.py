"""The bar that a command shows while it computes."""

from __future__ import annotations

from typing import Any

from tqdm import tqdm

from cosim.cli.console import is_quiet


class Bar(tqdm):
    """A bar on stderr: none with `-q`, and none where stderr is no terminal."""

    def __init__(self, *given: Any, **further: Any) -> None:
        how = {"disable": True if is_quiet() else None, "leave": False}
        super().__init__(*given, **{**how, **further})
