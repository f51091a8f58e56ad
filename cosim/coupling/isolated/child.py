"""A participant in the process that it lives in, and what is done with it there.

A request has calls without an answer that were put off until now, each `(call, arguments)`, then
the one that is answered: a round trip costs more than all else, so a step brings the outputs along.
"""

import sys
from collections.abc import Callable, Sequence
from typing import Any

from cosim.coupling.messages import Messages
from cosim.coupling.participant import capabilities
from cosim.processes import say

#: Calls that are answered with the outputs beside what they return.
WITH_OUTPUTS = ("exit_initialisation", "step")
#: The first call: makes the participant; its answer describes it. And the last one.
START, CLOSE = "start", "close"
BEGIN = "enter_initialisation"
#: A call that is put off, and its arguments.
Told = tuple[str, tuple[Any, ...]]


class Served:
    """The participant, and its states: what crosses of these is their number."""

    def __init__(self) -> None:
        self._participant: Any = None
        self._states: dict[int, Any] = {}

    def do(self, call: str, arguments: tuple[Any, ...]) -> Any:
        """What a call returns."""
        own: Callable[..., Any] | None = getattr(self, f"_{call}", None)
        if own is not None:
            return own(*arguments)
        if call == BEGIN:
            self._states.clear()  # of the run before
        returned = getattr(self._participant, call)(*arguments)
        return (returned, self._participant.read()) if call in WITH_OUTPUTS else returned

    def _start(
        self, factory: Callable[..., Any], given: tuple[Any, ...], named: dict[str, Any]
    ) -> Any:
        participant = self._participant = factory(*given, **named)
        messages = getattr(participant, "messages", None)
        if isinstance(messages, Messages):
            messages.listeners.append(say)
        return participant.name, tuple(participant.ports.values()), capabilities(participant)

    def _close(self) -> None:
        if self._participant is not None:
            self._participant.close()
        sys.stdout.flush()

    def _get_state(self, number: int) -> None:
        self._states[number] = self._participant.get_state()

    def _set_state(self, number: int) -> None:
        self._participant.set_state(self._states[number])

    def _free_state(self, number: int) -> None:
        self._participant.free_state(self._states.pop(number))


_served = Served()


def carry_out(told: Sequence[Told], call: str, arguments: tuple[Any, ...]) -> Any:
    """What was put off, then the call that is answered."""
    for each, given in told:
        _served.do(each, given)
    return _served.do(call, arguments)
