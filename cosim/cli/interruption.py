"""What Ctrl-C and `kill` do to a command."""

from __future__ import annotations

import signal
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from cosim.interrupts import REQUESTS

#: A second request within this time (s) is the same wish: a key held down, or a batch system or
#: `timeout` that sends its signal to a process and then to the group that it is in.
SAME_WISH = 1.0


@contextmanager
def interruptible(*, ending: bool) -> Iterator[None]:
    """Ctrl-C raises KeyboardInterrupt, and what else asks a process to end does as Ctrl-C does.

    ending: the process ends with this block, and what is asked for meanwhile says nothing more;
    else all is as it was before. Outside the main thread nothing is changed.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    raising, passing = _Once(_raise), _Once(_pass_on)
    handlers = dict.fromkeys(REQUESTS, passing) | {signal.SIGINT: raising}
    before = {number: signal.getsignal(number) for number in handlers}
    for number, handler in handlers.items():
        # nohup and shell scripts have a command ignore what is not meant for it
        if number == signal.SIGTERM or before[number] != signal.SIG_IGN:
            signal.signal(number, handler)
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, signal.SIG_IGN if ending else handler or signal.SIG_DFL)


class _Once:
    """A handler that does not hear the same wish again."""

    def __init__(self, act) -> None:
        self.act, self.last = act, -SAME_WISH

    def __call__(self, number: int, frame: FrameType | None) -> None:
        now = time.monotonic()
        if now - self.last >= SAME_WISH:
            self.last = now
            self.act(number, frame)


def _raise(number: int, frame: FrameType | None) -> None:
    raise KeyboardInterrupt


def _pass_on(number: int, frame: FrameType | None) -> None:
    """Do as Ctrl-C does just now: a run saves what it has first."""
    handler = signal.getsignal(signal.SIGINT)
    (handler if callable(handler) else _raise)(number, frame)
