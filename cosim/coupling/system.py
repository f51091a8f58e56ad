"""The coupled system: participants, what connects them, and whether that makes sense."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from cosim.coupling.conversion import IDENTITY, Affine, conversion
from cosim.coupling.messages import Message, Messages
from cosim.coupling.participant import Causality, Closing, CouplingError, Participant, Port
from cosim.names import listed, unknown_name

ENERGY_UNIT = "J"
#: Whose remarks those of the master are.
MASTER = "(master)"


@dataclass(frozen=True)
class Address:
    """A port of the coupled system, written `participant.port`; a port's name may hold dots."""

    participant: str
    port: str

    @classmethod
    def parse(cls, text: str) -> "Address":
        participant, dot, port = text.partition(".")
        if not (participant and dot and port):
            raise CouplingError(f"{text!r} is not a port; written as 'participant.port'")
        return cls(participant, port)

    def __str__(self) -> str:
        return f"{self.participant}.{self.port}"


@dataclass(frozen=True)
class Connection:
    """An output that feeds an input, both written `participant.port`.

    Energy crosses as the joules handed over since the start. Such a connection names in `taken`
    the output of the sink's participant (J) that says how many of them it has taken up, so that
    the ledger can compare both sides.
    transformation: of the value in the sink's unit, before the sink gets it. converts: whether
    the units are compared and the value converted; without, the transformation is all.

    >>> Connection("brake.heat", "disc.heat", taken="heat_received").source.port
    'heat'
    """

    source: Address
    sink: Address
    taken: Address | None
    transformation: Affine
    converts: bool

    def __init__(
        self,
        source: str,
        sink: str,
        taken: str | None = None,
        *,
        transformation: Affine = IDENTITY,
        converts: bool = True,
    ):
        end = Address.parse(sink)
        vars(self).update(
            source=Address.parse(source),
            sink=end,
            taken=None if taken is None else Address(end.participant, taken),
            transformation=transformation,
            converts=converts,
        )

    def __str__(self) -> str:
        return f"{self.source} -> {self.sink}"


def find_port(participants: Mapping[str, Participant], address: Address) -> Port:
    """The port at an address; CouplingError with the nearest name when there is none."""
    if address.participant not in participants:
        raise CouplingError(unknown_name("participant", address.participant, participants))
    ports = participants[address.participant].ports
    if address.port not in ports:
        raise CouplingError(unknown_name(f"port of {address.participant}", address.port, ports))
    return ports[address.port]


def output_in_joule(participants: Mapping[str, Participant], address: Address, role: str) -> None:
    """Refuse an address that is not an output in J; role says what it was named for."""
    port = find_port(participants, address)
    if port.causality is not Causality.OUTPUT or port.unit != ENERGY_UNIT:
        raise CouplingError(
            f"{address} is an {port.causality} in {port.unit}; {role} is an output in {ENERGY_UNIT}"
        )


def _ends(participants: Mapping[str, Participant], connection: Connection) -> tuple[Port, Port]:
    """Ports at both ends; CouplingError where they are not those of a connection."""
    source = find_port(participants, connection.source)
    sink = find_port(participants, connection.sink)
    if source.causality is not Causality.OUTPUT:
        raise CouplingError(
            f"{connection}: {connection.source} is an input; a connection starts at an output"
        )
    if sink.causality is not Causality.INPUT:
        raise CouplingError(
            f"{connection}: {connection.sink} is an output; a connection ends at an input"
        )
    if connection.source.participant == connection.sink.participant:
        raise CouplingError(
            f"{connection}: a participant is not connected to itself, allowed is another's input"
        )
    return source, sink


def _conversion(connection: Connection, source: Port, sink: Port) -> tuple[Affine, str]:
    """What a connection does to its value, and a remark where units could not be compared."""
    unit, remark = IDENTITY, "units are not compared, as the system says"
    if connection.converts:
        try:
            unit, remark = conversion(source, sink)
        except CouplingError as error:
            raise CouplingError(f"{connection}: {error}") from None
    return unit.then(connection.transformation), remark


def _check_receipt(
    participants: Mapping[str, Participant], connection: Connection, unit: str, receipts: bool
) -> None:
    if connection.taken is None:
        if unit == ENERGY_UNIT and receipts:
            raise CouplingError(
                f"{connection} carries energy; name in taken= the output of "
                f"{connection.sink.participant} that says how many joules it has taken up"
            )
        return
    if unit != ENERGY_UNIT:
        raise CouplingError(f"{connection}: taken= belongs to a connection in {ENERGY_UNIT}")
    output_in_joule(participants, connection.taken, "what the sink has taken up")


class CoupledSystem(Closing):
    """Participants, what connects them, and where they state their own energy residual.

    participants: each with a name of its own, without a dot.
    residuals: outputs in J, `participant.port`, that should stay 0: the participant's own
    ledger, which the master adds to what is lost on the connections.
    receipts: refuse a connection in J of which nobody says how many were taken up; without, it is
    left out of the ledger.
    `messages`: what the master has to remark on a run. `conversions`: what each connection does to
    its value. `sources`: all connected outputs. `remarks`: what could not be checked, a line each.
    Raises CouplingError when anything does not fit.
    """

    def __init__(
        self,
        participants: Sequence[Participant],
        connections: Iterable[Connection],
        residuals: Iterable[str] = (),
        *,
        receipts: bool = True,
    ):
        self.participants: Mapping[str, Participant] = MappingProxyType(_by_name(participants))
        self.connections: tuple[Connection, ...] = tuple(connections)
        self.residuals: tuple[Address, ...] = tuple(map(Address.parse, residuals))
        self.sources: tuple[Address, ...] = tuple(dict.fromkeys(c.source for c in self.connections))
        ends = self._checked_ends(receipts)
        converts, remarks = {}, []
        for each, both in ends.items():
            converts[each], remark = _conversion(each, *both)
            remarks += [f"{each}: {remark}"] if remark else []
        self.conversions: Mapping[Connection, Affine] = MappingProxyType(converts)
        self.remarks: tuple[str, ...] = tuple(remarks)
        self.messages: Messages = Messages(MASTER)
        for address in self.residuals:
            output_in_joule(self.participants, address, "an energy residual")

    def _checked_ends(self, receipts: bool) -> dict[Connection, tuple[Port, Port]]:
        """Ports at the ends of all connections, which fit; no input is fed twice."""
        ends: dict[Connection, tuple[Port, Port]] = {}
        fed: dict[Address, Address] = {}
        for each in self.connections:
            ends[each] = _ends(self.participants, each)
            _check_receipt(self.participants, each, ends[each][0].unit, receipts)
            if each.sink in fed:
                raise CouplingError(
                    f"{each.sink} is fed twice: by {fed[each.sink]} and by {each.source}, "
                    "allowed is one connection to an input"
                )
            fed[each.sink] = each.source
        return ends

    def check_order(self, order: Sequence[str]) -> None:
        """Refuse an order that does not name every participant exactly once."""
        for name in order:
            if name not in self.participants:
                raise CouplingError(unknown_name("participant", name, self.participants))
        repeated = [name for name in self.participants if order.count(name) > 1]
        if repeated:
            raise CouplingError(f"the order names {listed(repeated)} more than once")
        missing = [name for name in self.participants if name not in order]
        if missing:
            raise CouplingError(
                f"the order leaves out {listed(missing)}, allowed is every participant once"
            )

    def listen(self, heard: Callable[[Message], object]) -> None:
        """Hand over what participants and master say, as it comes, until they are gone.

        heard: is given each message, first those that are there already; it raises nothing.
        """
        sources = [getattr(each, "messages", None) for each in self.participants.values()]
        for messages in (*sources, self.messages):
            if isinstance(messages, Messages):
                for message in messages:
                    heard(message)
                messages.listeners.append(heard)

    def close(self) -> None:
        """Close every participant."""
        for participant in self.participants.values():
            participant.close()


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
