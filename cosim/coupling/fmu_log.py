"""What an FMU says while it is called, sorted to the instance that said it."""

import itertools
from ctypes import byref

import fmpy
from fmpy.fmi2 import (
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    fmi2Discard,
    fmi2Pending,
)
from fmpy.logging import addLoggerProxy

_numbers = itertools.count(1)
_logs: dict[int, "FmuLog"] = {}


class FmuLog:
    """The messages of one FMU instance.

    The logger behind all instances is one function, since fmpy's proxy, which formats the
    variadic message in C, keeps a single one for the process; the component environment tells
    the instances apart.
    """

    def __init__(self) -> None:
        self._errors: list[str] = []
        self._number = next(_numbers)
        _logs[self._number] = self
        self.callbacks = fmi2CallbackFunctions()
        self.callbacks.logger = _logger
        self.callbacks.allocateMemory = _allocate
        self.callbacks.freeMemory = _free
        self.callbacks.componentEnvironment = self._number
        addLoggerProxy(byref(self.callbacks))

    def add(self, status: int, message: str) -> None:
        """Keep a message that reports a failure (discard, error or fatal)."""
        if fmi2Discard <= status < fmi2Pending:
            self._errors.append(" ".join(message.split()))

    def take_errors(self) -> str:
        """The failures reported since the last call, in one line; "" when there were none."""
        text = "; ".join(dict.fromkeys(self._errors))
        self._errors.clear()
        return text

    def close(self) -> None:
        """Stop listening."""
        _logs.pop(self._number, None)


def _dispatch(environment, instance_name, status, category, message):
    log = _logs.get(environment or 0)
    if log is not None and message is not None:
        log.add(status, message.decode("utf-8", errors="replace"))


# Kept for the life of the process: C code holds pointers to them.
_logger = fmi2CallbackLoggerTYPE(_dispatch)
_allocate = fmi2CallbackAllocateMemoryTYPE(fmpy.calloc)
_free = fmi2CallbackFreeMemoryTYPE(fmpy.free)
