"""The coupled system: participants and connections, checked before anything runs."""

from collections.abc import Iterable, Sequence
from types import MappingProxyType

from cosim.coupling.connections import Address, Connection, check_connections, output_in_joule
from cosim.coupling.errors import CouplingError
from cosim.coupling.participant import Participant
from cosim.names import unknown_name


class CoupledSystem:
    """Participants, what connects them, and where they state their own energy residual.

    participants: each with a name of its own, without a dot.
    residuals: outputs in J, `participant.port`, that should stay 0: the participant's own
    ledger, which the master adds to what is lost on the connections.
    Raises CouplingError when anything does not fit.
    """

    def __init__(
        self,
        participants: Sequence[Participant],
        connections: Iterable[Connection],
        residuals: Iterable[str] = (),
    ):
        self.participants = MappingProxyType(_by_name(participants))
        self.connections = tuple(connections)
        self.residuals = tuple(Address.parse(text) for text in residuals)
        check_connections(self.participants, self.connections)
        for address in self.residuals:
            output_in_joule(self.participants, address, "an energy residual")

    def check_order(self, order: Sequence[str]) -> None:
        """Refuse an order that does not name every participant exactly once."""
        for name in order:
            if name not in self.participants:
                raise CouplingError(unknown_name("participant", name, self.participants))
        repeated = [name for name in self.participants if order.count(name) > 1]
        if repeated:
            raise CouplingError(f"the order names {', '.join(repeated)} more than once")
        missing = [name for name in self.participants if name not in order]
        if missing:
            raise CouplingError(f"the order leaves out {', '.join(missing)}")

    def close(self) -> None:
        """Close every participant."""
        for participant in self.participants.values():
            participant.close()

    def __enter__(self) -> "CoupledSystem":
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()


def _by_name(participants: Sequence[Participant]) -> dict[str, Participant]:
    named: dict[str, Participant] = {}
    for participant in participants:
        name = participant.name
        if not name or "." in name:
            raise CouplingError(f"participant name {name!r}: must be non-empty and hold no dot")
        if name in named:
            raise CouplingError(f"two participants are named {name!r}")
        named[name] = participant
    if not named:
        raise CouplingError("a coupled system needs at least one participant")
    return named
