"""What the two processes of an isolated participant say to each other.

A request is `(told, call, arguments)`: calls without an answer that were put off until now, each
`(call, arguments)`, then the one that is answered. Answers are `MESSAGE` as often as there is one,
then `DONE` with what the call returned or `FAILED` with what it raised. One request, one answer: a
round trip costs more than all else, so a step brings the outputs along.
"""

from __future__ import annotations

import pickle
import sys
from collections.abc import Callable
from multiprocessing.connection import Connection
from typing import Any

if sys.platform != "win32":
    import select

DONE, FAILED, MESSAGE = "done", "failed", "message"
#: Calls that are answered with the outputs beside what they return.
WITH_OUTPUTS = ("exit_initialisation", "step")
#: The first call: makes the participant; its answer describes it.
START = "start"
#: The last one.
CLOSE = "close"


def packed(what: Any) -> bytes:
    """For the line."""
    return pickle.dumps(what, protocol=pickle.HIGHEST_PROTOCOL)


def waiter(line: Connection) -> Callable[[float], bool]:
    """A function that waits so many seconds at most, and says whether there is something to read.

    `Connection.poll` makes a selector anew each time, which is a good part of a round trip.
    """
    if sys.platform == "win32":
        return line.poll
    poll = select.poll()
    poll.register(line.fileno(), select.POLLIN)
    return lambda seconds: bool(poll.poll(1e3 * max(seconds, 0.0)))
