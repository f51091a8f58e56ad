"""What a unit logs: kept, and turned into exceptions where it says that a call failed."""

import itertools
from ctypes import byref

import fmpy
from fmpy.fmi2 import (
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
)
from fmpy.logging import addLoggerProxy

from cosim.coupling.messages import FAILURES, Messages

#: By FMI's numbers, the same in 2.0 and 3.0; the last is of 2.0 alone.
STATUSES = ("ok", "warning", "discard", "error", "fatal", "pending")

_numbers = itertools.count(1)
_logs: "dict[int, FmuLog]" = {}


class FmuLog:
    """The messages of one FMU instance.

    messages: where they are kept; those of status "ok" only with `debug`, some units log every
    call. callbacks: for FMI 2.0; log_message: for FMI 3.0.

    The logger behind all instances of FMI 2.0 is one function, since fmpy's proxy, which formats
    the variadic message in C, keeps a single one for the process; the component environment tells
    the instances apart.
    """

    def __init__(self, messages: Messages | None = None, debug: bool = False) -> None:
        self.messages = Messages("") if messages is None else messages
        self.failures: list[str] = []
        self._debug = debug
        self._number = next(_numbers)
        _logs[self._number] = self
        self.callbacks = fmi2CallbackFunctions()
        self.callbacks.logger = _logger
        self.callbacks.allocateMemory = _allocate
        self.callbacks.freeMemory = _free
        self.callbacks.componentEnvironment = self._number
        addLoggerProxy(byref(self.callbacks))

    def log_message(
        self, environment: object, status: int, category: bytes | None, message: bytes | None
    ) -> None:
        """Keep a message, and what reports a failure (discard, error or fatal) until it is asked.

        FMI 3.0's callback, called from C, through which no exception finds its way.
        """
        word = STATUSES[status] if 0 <= status < len(STATUSES) else "error"
        if word == "ok" and not self._debug:
            return
        said = self.messages.add(word, _text(category), _text(message))
        if word in FAILURES:
            self.failures.append(said.text)

    def take_errors(self) -> str:
        """The failures reported since the last call, in one line; "" when there were none."""
        text = "; ".join(dict.fromkeys(self.failures))
        self.failures.clear()
        return text

    def close(self) -> None:
        """Stop listening."""
        _logs.pop(self._number, None)


def _text(said: bytes | None) -> str:
    return "" if said is None else said.decode("utf-8", errors="replace")


def _dispatch(
    environment: int | None,
    instance_name: bytes | None,
    status: int,
    category: bytes | None,
    message: bytes | None,
) -> None:
    log = _logs.get(environment or 0)
    if log is not None:
        log.log_message(environment, status, category, message)


# Kept for the life of the process: C code holds pointers to them.
_logger = fmi2CallbackLoggerTYPE(_dispatch)
_allocate = fmi2CallbackAllocateMemoryTYPE(fmpy.calloc)
_free = fmi2CallbackFreeMemoryTYPE(fmpy.free)
