"""Before the first step: what its user should know, whether participants can go back, and values
that fit each other, loops without delay included.
"""

import math
import struct
from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import Any

import numpy as np

from cosim.coupling.exchange import Exchange
from cosim.coupling.participant import CouplingError, capabilities
from cosim.coupling.schemes import QuasiNewton, Scheme, Vector, ending_early_first
from cosim.coupling.step_control.control import HALVE, StepControl
from cosim.coupling.system import Address, CoupledSystem
from cosim.coupling.tolerance import bounds, nominals
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
        with suppress(Exception):  # what has failed in the step is what its user has to know
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


#: A chain has settled when no value changes by more than this part of itself: an iteration ends in
#: a flicker of the last bits.
SETTLED = 4 * math.ulp(1.0)
#: A loop is solved when its values change by less than this part of themselves, or of the nominal
#: value of a port: a solver stops earlier than a chain, which settles to the last bit.
LOOP = 1e-12
MOST_SWEEPS = 100


def initialise(exchange: Exchange, order: Sequence[str], start: float, stop: float) -> int:
    """Bring all participants to the start of a run from start to stop (s); sweeps that it took."""
    participants = exchange.system.participants
    for name in order:
        exchange.asked(name, participants[name].enter_initialisation, start, stop)
    sweeps = initial_exchange(exchange, order)
    for name in order:
        exchange.asked(name, participants[name].exit_initialisation)
        exchange.collect(name)
    return sweeps


def initial_exchange(exchange: Exchange, order: Sequence[str]) -> int:
    """Sweep over the participants in order until no connected output changes any more.

    One sweep carries a value one participant further, so a chain of n settles in n sweeps; a loop
    with direct feedthrough is iterated to a fixed point while that comes nearer, and else solved by
    quasi-Newton steps. Returns the number of sweeps; raises CouplingError with what still changes
    after `MOST_SWEEPS`.
    """
    for name in order:
        exchange.collect(name)
    sources, largest = exchange.system.sources, math.inf
    for sweep in range(1, MOST_SWEEPS + 1):
        before = exchange.values(sources)
        for name in order:
            exchange.deliver(name)
            exchange.collect(name)
        after = exchange.values(sources)
        changes = np.abs(after - before)
        changes[changes <= SETTLED * np.maximum(np.abs(after), np.abs(before))] = 0.0
        if not changes.any():
            return sweep
        if sweep > len(order) and changes.max() >= largest:
            return sweep + _solve_loops(exchange, order, MOST_SWEEPS - sweep)
        largest = changes.max()
    raise _not_settled(MOST_SWEEPS, sources, changes)


def _solve_loops(exchange: Exchange, order: Sequence[str], most: int) -> int:
    """Solve for all connected outputs at once; the evaluations that it took."""
    sources = exchange.system.sources
    scale, within = nominals(exchange.system, sources), bounds(exchange.system, sources)
    guess = exchange.values(sources)
    solver = QuasiNewton()
    solver.begin()
    for evaluation in range(1, most + 1):
        for source, value in zip(sources, guess.tolist(), strict=True):
            exchange.outputs[source.participant][source.port] = value
        for name in order:
            exchange.deliver(name)
        for name in order:
            exchange.collect(name)
        found = exchange.values(sources)
        change = np.abs(found - guess) / np.maximum(np.abs(found), scale)
        if change.max() <= LOOP:
            return evaluation
        guess = (scale * solver.next(guess / scale, found / scale)).clip(*within)
    raise _not_settled(most, sources, change)


def _not_settled(sweeps: int, sources: Sequence[Address], changes: Vector) -> CouplingError:
    worst = int(changes.argmax())
    return CouplingError(
        f"the initial exchange has not settled after {sweeps} sweeps: {sources[worst]} still "
        f"changes by {changes[worst]:.3g}; the loop through it has no solution near its start "
        "values, so break it or start from consistent values"
    )
