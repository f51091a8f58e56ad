"""Ctrl-C, and the signals that ask for the same, at a time that suits."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from multiprocessing import resource_tracker

#: What asks a process to end: Ctrl-C, `kill`, a terminal that is closed (there is none on Windows).
REQUESTS = tuple(
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)
)


@contextmanager
def held_interrupts() -> Iterator[None]:
    """Let requests to end wait for the end of the block; they do there what they would have done.

    Other people's code (an import, the start of processes) does not survive a KeyboardInterrupt
    at any of its lines. Outside the main thread signals do not arrive and nothing is changed.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    came: list[int] = []
    # None: a handler that was not installed from Python, and cannot be put back by it
    before = {
        number: handler for number in REQUESTS if (handler := signal.getsignal(number)) is not None
    }
    for number in before:
        signal.signal(number, lambda number, frame: came.append(number))
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        if came:
            signal.raise_signal(came[0])


@contextmanager
def unheard_by_children() -> Iterator[None]:
    """What is started here never gets the signals that ask to end: they are for us.

    A terminal sends Ctrl-C to all processes of a command, and one that is just starting, or in the
    middle of its work, would answer with a traceback.
    """
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    resource_tracker.ensure_running()  # its start would unblock them
    before = signal.pthread_sigmask(signal.SIG_BLOCK, REQUESTS)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
