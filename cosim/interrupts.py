"""Ctrl-C, and the signals that ask for the same: all that a command and a run do about them.

Outside the main thread signals do not arrive, and none of this changes anything.
"""

import signal
import threading
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from types import FrameType

#: What `signal.signal` takes and `signal.getsignal` gives.
Handler = Callable[[int, FrameType | None], object]
Installed = Handler | int | signal.Handlers | None

#: What asks a process to end: Ctrl-C, `kill`, a terminal that is closed (there is none on Windows).
REQUESTS: tuple[signal.Signals, ...] = tuple(
    getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)
)
#: A second request within this time (s) is the same wish: a key held down, or a batch system or
#: `timeout` that sends its signal to a process and then to the group that it is in.
SAME_WISH = 1.0


@contextmanager
def _handling(
    handlers: Mapping[signal.Signals, Handler], afterwards: Installed = None
) -> Iterator[None]:
    """Install handlers for the block; none outside the main thread.

    afterwards: what takes their place; left out, what was there before.
    """
    if threading.current_thread() is not threading.main_thread():
        handlers = {}
    before: dict[signal.Signals, Installed] = {
        number: signal.getsignal(number) for number in handlers
    }
    for number, handler in handlers.items():
        signal.signal(number, handler)
    try:
        yield
    finally:
        for number, former in before.items():
            # None: a handler that was not installed from Python, and cannot be put back by it
            signal.signal(number, afterwards or former or signal.SIG_DFL)


@contextmanager
def held_interrupts() -> Iterator[None]:
    """Let requests to end wait for the end of the block; they do there what they would have done.

    Other people's code (an import, the start of processes) does not survive a KeyboardInterrupt
    at any of its lines.
    """
    came: list[int] = []

    def keep(number: int, frame: FrameType | None) -> None:
        came.append(number)

    ours = [number for number in REQUESTS if signal.getsignal(number) is not None]
    try:
        with _handling(dict.fromkeys(ours, keep)):
            yield
    finally:
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
    before = signal.pthread_sigmask(signal.SIG_BLOCK, REQUESTS)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


class Interrupt:
    """requested: whether the user has asked for the end."""

    requested = False


@contextmanager
def deferred_interrupt() -> Iterator[Interrupt]:
    """Let the first Ctrl-C only set `requested`; the second one interrupts at once.

    A participant of a coupled run may be foreign code in the same process (an FMU written in
    Python, say): an exception in the middle of its step would leave it, or the process, in pieces.
    """
    interrupt = Interrupt()

    def request(number: int, frame: FrameType | None) -> None:
        interrupt.requested = True
        signal.signal(signal.SIGINT, signal.default_int_handler)

    with _handling({signal.SIGINT: request}):
        yield interrupt


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

    def handle(self, number: int, frame: FrameType | None) -> None:
        """What SIGINT does."""
        if self.holding:
            self.requested = True
        else:
            self._otherwise(number, frame)


@contextmanager
def patient_interrupts() -> Iterator[Patience]:
    """Let Ctrl-C wait for what it would destroy."""
    previous = signal.getsignal(signal.SIGINT)
    patience = Patience(previous if callable(previous) else signal.default_int_handler)
    with _handling({signal.SIGINT: patience.handle}):
        yield patience


@contextmanager
def interruptible(*, ending: bool) -> Iterator[None]:
    """Ctrl-C raises KeyboardInterrupt, and what else asks a process to end does as Ctrl-C does.

    ending: the process ends with this block, and what is asked for meanwhile says nothing more;
    else all is as it was before.
    """
    raising, passing = _Once(signal.default_int_handler), _Once(_pass_on)
    handlers: dict[signal.Signals, Handler] = {
        number: raising if number == signal.SIGINT else passing
        for number in REQUESTS
        # nohup and shell scripts have a command ignore what is not meant for it
        if number == signal.SIGTERM or signal.getsignal(number) != signal.SIG_IGN
    }
    with _handling(handlers, afterwards=signal.SIG_IGN if ending else None):
        yield


class _Once:
    """A handler that does not hear the same wish again."""

    def __init__(self, act: Handler) -> None:
        self._act, self._last = act, -SAME_WISH

    def __call__(self, number: int, frame: FrameType | None) -> None:
        now = time.monotonic()
        if now - self._last >= SAME_WISH:
            self._last = now
            self._act(number, frame)


def _pass_on(number: int, frame: FrameType | None) -> None:
    """Do as Ctrl-C does just now: a run saves what it has first."""
    handler = signal.getsignal(signal.SIGINT)
    (handler if callable(handler) else signal.default_int_handler)(number, frame)
