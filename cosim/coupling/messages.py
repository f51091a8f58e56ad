"""What participants say while they run: kept for a log file, whoever else hears it."""

from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass

#: Messages of one participant that are kept; of more, the newest.
KEPT = 1000
#: Characters of one message that are kept.
LONGEST = 4000
#: Statuses as FMI has them, by which one sees what is worth a look.
WARNING, FAILURES = "warning", ("discard", "error", "fatal")

#: Categories of remarks that whoever waits for the run should hear of at once.
SMALLEST, UNCONVERGED = "smallest step", "not converged"


@dataclass(frozen=True)
class Message:
    """Something that a participant said.

    source: the participant. time: start of the step under way in s, None before the first.
    status: "ok", "warning", "discard", "error", "fatal" or "pending" as FMI has them; "output" for
    a line that it wrote to the terminal. category: as the participant names it, may be empty.
    """

    source: str
    time: float | None
    status: str
    category: str
    text: str

    @property
    def when(self) -> str:
        """The time in words."""
        return "initialisation" if self.time is None else f"t = {self.time:.9g} s"

    def __str__(self) -> str:
        category = f" [{self.category}]" if self.category else ""
        return f"{self.source}: {self.when}: {self.status}{category}: {self.text}"


class Messages:
    """The messages of one participant, the newest `KEPT` of them; iterates from old to new.

    source: the participant. time: start of the step under way in s, for whoever adds messages.
    dropped: how many of the oldest are not kept any more. listeners: each is called with every
    message as it comes, for a log file.
    """

    def __init__(self, source: str, kept: int = KEPT):
        self.source = source
        self.time: float | None = None
        self.dropped: int = 0
        self.listeners: list[Callable[[Message], object]] = []
        self._kept: deque[Message] = deque(maxlen=kept)

    def add(self, status: str, category: str, text: str) -> Message:
        """Keep what was said now; in one line."""
        line = " ".join(text.split())
        if len(line) > LONGEST:
            line = line[:LONGEST] + " ..."
        return self.keep(Message(self.source, self.time, status, category, line))

    def keep(self, message: Message) -> Message:
        """Keep a message and tell the listeners."""
        if len(self._kept) == self._kept.maxlen:
            self.dropped += 1
        self._kept.append(message)
        for listener in self.listeners:
            listener(message)
        return message

    def __iter__(self) -> Iterator[Message]:
        return iter(tuple(self._kept))

    @property
    def said(self) -> int:
        """How many there were, kept or not."""
        return len(self._kept) + self.dropped

    def __len__(self) -> int:
        return len(self._kept)
