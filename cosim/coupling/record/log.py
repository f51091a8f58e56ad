"""What was said in a run, as a file beside its results: there also after a crash or a kill."""

import threading
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from datetime import UTC, datetime
from io import FileIO
from pathlib import Path

from cosim.coupling.messages import FAILURES, WARNING, Message
from cosim.coupling.participant import Closing

LOG = "messages.log"
COLUMNS = ("wall time (UTC)", "simulated time (s)", "who", "status", "category", "text")
_HEAD = "# " + "\t".join(COLUMNS) + "\n"
_GONE_ON = "# the run was cut off, and goes on from its newest checkpoint\n"
#: A unit that logs at every call is not to fill the disk; what comes then is counted.
MOST_BYTES = 100_000_000


class MessageLog(Closing):
    """A file with a line for every message, columns apart by tabs; none where nobody says anything.

    path: of the file. resumed: go on behind what an earlier process has left; else that is removed.
    shown: is given each message in a line, for a terminal.
    counts: status -> messages, an earlier process's too.

    `add` raises nothing, it is called from C: what the disk refuses is said by `told`.
    """

    def __init__(
        self,
        path: Path,
        resumed: bool = False,
        shown: Callable[[str], object] | None = None,
        most_bytes: int = MOST_BYTES,
    ):
        self.path, self.counts = path, Counter[str]()
        self._shown, self._most, self._size = shown, most_bytes, 0
        self._left_out, self._refused = 0, ""
        self._file: FileIO | None = None
        self._lock = threading.RLock()  # a library may log from a thread of its own
        self._first = _GONE_ON if resumed and path.is_file() else _HEAD
        with self._noting_refusal():
            if not resumed:
                path.unlink(missing_ok=True)
            elif path.is_file():
                self._count_earlier()

    def _count_earlier(self) -> None:
        line, place = "\n", COLUMNS.index("status")
        with self.path.open(encoding="utf-8", errors="replace", newline="\n") as lines:
            for line in lines:
                columns = line.split("\t")
                if len(columns) == len(COLUMNS) and not line.startswith("#"):
                    self.counts[columns[place]] += 1
        if not line.endswith("\n"):  # a kill in the middle of it
            self._first = "\n" + self._first

    def add(self, message: Message) -> None:
        """Write a message, with the operating system when this returns."""
        with self._lock:
            self.counts[message.status] += 1
            with self._noting_refusal():
                self._write(_line(message))
            if self._shown is not None:
                with suppress(OSError, ValueError):  # a terminal that is gone
                    self._shown(_printable(str(message)))

    def _write(self, line: str) -> None:
        if self._file is None:
            self._file = FileIO(self.path, "a")
            self._size = self.path.stat().st_size
            line = self._first + line
        content = line.encode("utf-8", errors="replace")
        if self._left_out or self._size + len(content) > self._most:
            self._left_out += 1
            return
        self._size += len(content)
        self._file.write(content)

    @contextmanager
    def _noting_refusal(self) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            self._refused = error.strerror or str(error)

    def told(self) -> str:
        """How many messages there are, and where; "" where none is a warning or a failure."""
        warnings, failures = self.counts[WARNING], sum(self.counts[each] for each in FAILURES)
        if not (warnings or failures or self._refused):
            return ""
        counts = ((warnings, "warning"), (failures, "error"))
        parts = ", ".join(f"{n} {word}{'s' * (n != 1)}" for n, word in counts if n)
        total = self.counts.total()
        said = f"{total} message{'s' * (total != 1)}" + (f" ({parts})" if parts else "")
        said += f" in {self.path}"
        if self._left_out:
            said += f", the last {self._left_out} left out"
        return said + (f", not all: {self._refused}" if self._refused else "")

    def close(self) -> None:
        """Let go of the file; may be called twice."""
        if self._file is not None:
            self._file.close()


def _line(message: Message) -> str:
    now = datetime.now(UTC).isoformat(timespec="milliseconds").replace("+00:00", "Z")
    time = "" if message.time is None else repr(float(message.time))
    columns = (now, time, message.source, message.status, message.category, message.text)
    return "\t".join(map(_printable, columns)) + "\n"


def _printable(text: str) -> str:
    """In one line, and without what would move a terminal's cursor."""
    return "".join(letter if letter.isprintable() else " " for letter in text)
