"""The bar that a command shows while it computes."""

from __future__ import annotations

import sys
from typing import Any, TextIO

from tqdm import tqdm

from cosim.cli.console import is_quiet

#: Seconds between two lines where there is no terminal.
MINUTE = 60.0


class Bar(tqdm):  # type: ignore[type-arg]  # tqdm takes none when it runs
    """A bar on stderr, or where that is no terminal a line a minute; none with `-q`."""

    def __init__(self, *given: Any, **further: Any) -> None:
        how: dict[str, Any] = {"disable": is_quiet() or sys.stderr is None, "leave": False}
        if not how["disable"] and not sys.stderr.isatty():
            seldom = dict.fromkeys(("delay", "mininterval", "maxinterval"), MINUTE)
            how |= {"file": _Lines(sys.stderr), "ncols": 80, "miniters": 1, **seldom}
        super().__init__(*given, **{**how, **further})

    def reach(self, done: int, total: int) -> None:
        """So much is done of what may have grown or shrunk."""
        self.total = total
        self.update(done - self.n)


class _Lines:
    """What a bar writes over itself, as lines of their own."""

    def __init__(self, file: TextIO):
        self.file = file

    def write(self, text: str) -> None:
        """A line, unless a bar is but wiped out."""
        if told := text.strip("\r\n "):
            self.file.write(f"{told}\n")

    def flush(self) -> None:
        """Out with it: whoever follows a log waits for it."""
        self.file.flush()
