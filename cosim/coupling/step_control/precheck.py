"""Before the first step: what its user should know, and whether participants can go back."""

import struct
from collections.abc import Mapping
from contextlib import suppress
from typing import Any

from cosim.coupling.exchange import Exchange
from cosim.coupling.participant import CouplingError, capabilities
from cosim.coupling.schemes.scheme import Scheme, ending_early_first
from cosim.coupling.step_control.control import HALVE, StepControl
from cosim.coupling.system import CoupledSystem
from cosim.names import listed


def remarks_of(
    system: CoupledSystem, scheme: Scheme, control: StepControl, length: float
) -> list[str]:
    """What of the settings comes to something else than they say, a line each.

    length: of the run, s.
    """
    size, found = control.first_size, []
    if size > length * (1.0 + 1e-9):
        found.append(
            f"macro_step = {size:g} s is longer than the run, which is one step of {length:g} s"
        )
    fed = {connection.sink.participant for connection in system.connections}
    for name, participant in system.participants.items():
        order = capabilities(participant).input_order
        if scheme.accuracy == 3 and name in fed and order is not None and order < 2:
            found.append(
                f"{name} takes no more than first derivatives of its inputs: they are linear over"
                " a step there, not quadratic"
            )
    return found


def check_restore(
    system: CoupledSystem, scheme: Scheme, control: StepControl, on_divergence: str
) -> bool:
    """Whether steps are marked to be taken back; CouplingError where they must and cannot."""
    able = {name: capabilities(each) for name, each in system.participants.items()}
    cannot = [name for name, can in able.items() if not can.restores]
    early = [name for name, can in able.items() if can.ends_early]
    order = ending_early_first(system, scheme.order) if scheme.free_order else scheme.order
    late = [name for name in early if name != order[0]]
    reasons = {
        f"the scheme {type(scheme).__name__}": scheme.needs_restore,
        f"the step control {type(control).__name__}": control.needs_restore,
        f"on_divergence = {on_divergence!r}": on_divergence == HALVE,
        f"{listed(late)}, which may end a step that others have made,": bool(late),
    }
    for reason, needs in reasons.items():
        if needs and cannot:
            raise CouplingError(
                f"{listed(cannot)}: cannot go back to an earlier state, and {reason} takes steps"
                " back; allowed are Jacobi and GaussSeidel with fixed steps"
            )
    taken_back = bool(late) or (scheme.needs_restore and bool(early))
    return taken_back or on_divergence == HALVE


def try_restore(exchange: Exchange, start: float, size: float) -> None:
    """Refuse a participant that says that it can go back, and does not bit for bit."""
    for name, participant in exchange.system.participants.items():
        if not exchange.asked(name, restores_exactly, participant, start, size):
            raise CouplingError(
                f"{name}: says that it can go back to an earlier state, and tried with a step of "
                f"{size:g} s it does not come back exactly; allowed are Jacobi and GaussSeidel "
                "with fixed steps"
            )


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
        try:
            participant.set_state(state)
            same = _bits(participant.read()) == before
            same = same and _stepped(participant, time, size) == first
            participant.set_state(state)
        finally:
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
