"""Whether a participant really comes back to where it was: tried, since several do not."""

from __future__ import annotations

import struct
from collections.abc import Mapping
from contextlib import suppress
from typing import Any

from cosim.coupling.participant import capabilities


def restores_exactly(participant: Any, time: float, size: float) -> bool:
    """Make a step from time, of length size (s), go back, make it again: bit for bit the same?

    For a participant that is initialised and stands at `time`; True leaves it there. False where it
    says that it cannot go back, where the second step differs from the first, or where anything
    about states raises; it then may stand anywhere and is to be initialised anew before it is used.
    What the first step raises is another matter, and raised.
    """
    if not capabilities(participant).restores:
        return False
    try:
        before = _bits(participant.read())
        state = participant.get_state()
    except Exception:
        return False
    try:
        first = _stepped(participant, time, size)
    except Exception:
        with suppress(Exception):
            participant.free_state(state)
        raise
    try:
        participant.set_state(state)
        same = _bits(participant.read()) == before
        same = same and _stepped(participant, time, size) == first
        participant.set_state(state)
    except Exception:
        with suppress(Exception):
            participant.free_state(state)
        return False
    try:
        participant.free_state(state)
    except Exception:
        return False
    return same


def _stepped(participant: Any, time: float, size: float) -> tuple[float | None, dict[str, bytes]]:
    reached = participant.step(time, size)
    return reached, _bits(participant.read())


def _bits(values: Mapping[str, float]) -> dict[str, bytes]:
    """As bits, since a value that is no number equals nothing, and 0 equals -0."""
    return {name: struct.pack("d", value) for name, value in values.items()}
