"""What can go wrong in a coupled run, and how a name that does not exist is answered."""

import difflib
from collections.abc import Iterable


class CouplingError(ValueError):
    """The coupling as described cannot work: a port, a unit, a causality, an order, a step."""


class FmuError(ValueError):
    """A file is not an FMU that can be used here, or a value given to it is refused."""


class ParticipantError(RuntimeError):
    """A participant failed while it was being initialised or stepped.

    participant: its name; time: the macro step's start in s (None: before the first step).
    """

    def __init__(self, participant: str, time: float | None, message: str):
        when = "during initialisation" if time is None else f"in the step from t = {time:.9g} s"
        super().__init__(f"{participant}: failed {when}: {message}")
        self.participant = participant
        self.time = time


def unknown_name(kind: str, name: str, known: Iterable[str]) -> str:
    """One line on a name that does not exist, with the nearest that does.

    >>> unknown_name("parameter of brake", "mas", ["mass", "length"])
    "no parameter of brake is named 'mas'; nearest: 'mass'"
    """
    known = sorted(known)
    nearest = difflib.get_close_matches(name, known, n=1, cutoff=0.5)
    if nearest:
        return f"no {kind} is named {name!r}; nearest: {nearest[0]!r}"
    if len(known) > 12:
        known = [*known[:12], "..."]
    return f"no {kind} is named {name!r}; known: {', '.join(known) or 'none'}"
