"""The exchange before the first step: values that fit each other, loops without delay included."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cosim.coupling.exchange import Exchange
from cosim.coupling.participant import CouplingError
from cosim.coupling.schemes.acceleration import QuasiNewton
from cosim.coupling.tolerance import bounds, nominals

#: A loop is solved when its values change by less than this part of themselves, or of the nominal
#: value of a port: a solver stops earlier than a chain, which settles to the last bit.
LOOP = 1e-12


def initial_exchange(
    exchange: Exchange, order: Sequence[str], tolerance: float, max_sweeps: int
) -> int:
    """Sweep over the participants in order until no connected output changes any more.

    One sweep carries a value one participant further, so a chain of n settles in n sweeps; a loop
    with direct feedthrough is iterated to a fixed point while that comes nearer, and else solved by
    quasi-Newton steps. `tolerance` is relative to the value itself and only there because such an
    iteration ends in a flicker of the last bits. Returns the number of sweeps; raises CouplingError
    with what still changes after `max_sweeps`.
    """
    for name in order:
        exchange.collect(name)
    largest = np.inf
    for sweep in range(1, max_sweeps + 1):
        before = _connected_outputs(exchange)
        for name in order:
            exchange.deliver(name)
            exchange.collect(name)
        changes = _changes(before, _connected_outputs(exchange), tolerance)
        if not changes:
            return sweep
        if sweep > len(order) and max(changes.values()) >= largest:
            return sweep + _solve_loops(exchange, order, max_sweeps - sweep)
        largest = max(changes.values())
    raise _not_settled(max_sweeps, changes)


def _solve_loops(exchange: Exchange, order: Sequence[str], most: int) -> int:
    """Solve for all connected outputs at once; the evaluations that it took."""
    sources = tuple(dict.fromkeys(c.source for c in exchange.system.connections))
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
    raise _not_settled(most, dict(zip(map(str, sources), change.tolist(), strict=True)))


def _not_settled(sweeps: int, changes: dict[str, float]) -> CouplingError:
    worst = max(changes, key=changes.__getitem__)
    return CouplingError(
        f"the initial exchange has not settled after {sweeps} sweeps: {worst} still changes "
        f"by {changes[worst]:.3g}; the loop through it has no solution near its start values, so "
        "break it or start from consistent values"
    )


def _connected_outputs(exchange: Exchange) -> dict[str, float]:
    sources = [connection.source for connection in exchange.system.connections]
    return {str(source): exchange.outputs[source.participant][source.port] for source in sources}


def _changes(
    before: dict[str, float], after: dict[str, float], tolerance: float
) -> dict[str, float]:
    """`participant.port` -> size of the change, of every output that changed."""
    return {
        port: abs(new - before[port])
        for port, new in after.items()
        if abs(new - before[port]) > tolerance * max(abs(new), abs(before[port]))
    }
