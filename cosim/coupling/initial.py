"""The exchange before the first step: values that fit each other, loops without delay included."""

import math
from collections.abc import Sequence

import numpy as np

from cosim.coupling.exchange import Exchange
from cosim.coupling.participant import CouplingError
from cosim.coupling.schemes.acceleration import QuasiNewton, Vector
from cosim.coupling.system import Address
from cosim.coupling.tolerance import bounds, nominals

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
