"""The exchange before the first step: every input agrees with the output that feeds it."""

from collections.abc import Sequence

from cosim.coupling.errors import CouplingError
from cosim.coupling.exchange import Exchange


def initial_exchange(
    exchange: Exchange, order: Sequence[str], tolerance: float, max_sweeps: int
) -> int:
    """Sweep over the participants in order until no connected output changes any more.

    One sweep carries a value one participant further, so a chain of n settles in n sweeps; a
    loop with direct feedthrough is iterated to a fixed point. `tolerance` is relative to the
    value itself and only there because such an iteration ends in a flicker of the last bits.
    Returns the number of sweeps; raises CouplingError with what still changes after
    `max_sweeps`.
    """
    for name in order:
        exchange.collect(name)
    changes: dict[str, float] = {}
    for sweep in range(1, max_sweeps + 1):
        before = _connected_outputs(exchange)
        for name in order:
            exchange.deliver(name)
            exchange.collect(name)
        changes = _changes(before, _connected_outputs(exchange), tolerance)
        if not changes:
            return sweep
    worst = max(changes, key=changes.__getitem__)
    raise CouplingError(
        f"the initial exchange has not settled after {max_sweeps} sweeps: {worst} still changes "
        f"by {changes[worst]:.3g}; the loop through it amplifies, so break it or start from "
        "consistent values"
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
