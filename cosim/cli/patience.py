"""Ctrl-C that loses nothing."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager

Handler = Callable[[int, object], object]


class Patience:
    """Ctrl-C works at once while there is nothing to lose; what there is, is saved first.

    holding: whether there are results that are not on disk. requested: whether Ctrl-C came
    meanwhile. otherwise: what it does while there is nothing to lose.
    """

    def __init__(self, otherwise: Handler = signal.default_int_handler) -> None:
        self.holding = False
        self.requested = False
        self._otherwise = otherwise

    def hold(self) -> None:
        """From now on there is something to lose."""
        self.holding = True

    def release(self) -> None:
        """All is on disk; raises KeyboardInterrupt when that was asked for meanwhile."""
        self.holding = False
        if self.requested:
            raise KeyboardInterrupt

    def handle(self, number: int, frame: object) -> None:
        """What SIGINT does."""
        if self.holding:
            self.requested = True
        else:
            self._otherwise(number, frame)


@contextmanager
def patient_interrupts() -> Iterator[Patience]:
    """Let Ctrl-C wait for what it would destroy; outside the main thread nothing is changed."""
    previous = signal.getsignal(signal.SIGINT)
    patience = Patience(previous if callable(previous) else signal.default_int_handler)
    if threading.current_thread() is not threading.main_thread():
        yield patience
        return
    signal.signal(signal.SIGINT, patience.handle)
    try:
        yield patience
    finally:
        signal.signal(signal.SIGINT, previous or signal.default_int_handler)
