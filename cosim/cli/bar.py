"""The bar that a command shows while it computes."""

import sys
import threading
import time
from typing import Any, TextIO

from tqdm import tqdm

from cosim.cli.console import is_quiet

#: Seconds between two lines where there is no terminal, and at most between two looks of a bar.
MINUTE, SECOND = 60.0, 1.0


class Bar(tqdm):  # type: ignore[type-arg]  # tqdm takes none when it runs
    """A bar on stderr, or where that is no terminal a line a minute; none with `-q`.

    Its clock goes on within a step, however long that takes.
    """

    def __init__(self, *given: Any, **further: Any) -> None:
        self._closed, self._at_clock, clock = threading.Event(), threading.Lock(), SECOND
        how: dict[str, Any] = {"disable": is_quiet() or sys.stderr is None, "leave": False}
        if not how["disable"] and not sys.stderr.isatty():
            seldom = dict.fromkeys(("delay", "mininterval", "maxinterval"), MINUTE)
            how |= {"file": _Lines(sys.stderr), "ncols": 80, "miniters": 1, **seldom}
            clock = MINUTE
        super().__init__(*given, **{**how, **further})
        if not self.disable:
            threading.Thread(target=self._keep_time, args=(clock,), daemon=True).start()

    def _keep_time(self, interval: float) -> None:
        while not self._closed.wait(interval):
            with self._at_clock:
                is_late = time.time() - self.last_print_t >= interval
                if is_late and not self._closed.is_set():
                    self.refresh()

    def close(self) -> None:
        """Wiped out, and its clock stops."""
        with self._at_clock:
            self._closed.set()
        super().close()

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
