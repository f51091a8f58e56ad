"""Pairs of connections whose product is a power, and whether it is one."""

from dataclasses import dataclass

from cosim.coupling.conversion import POWER, told_dimension
from cosim.coupling.exchange import Exchange
from cosim.coupling.participant import CouplingError
from cosim.coupling.system import Address, Connection, CoupledSystem, find_port

#: Exponents of a unit that count: the radian, the last of them, is a number.
COUNTED = 7


@dataclass(frozen=True)
class PowerBond:
    """A pair of connections whose product is a power.

    effort, flow : outputs (`participant.port`) that feed each other's participants: force and
    velocity, moment and rate of turn. What one side gives in a step the other has to take: with
    inputs that are extrapolated, their difference is energy that comes from nowhere.
    """

    effort: Address
    flow: Address

    def __init__(self, effort: str, flow: str):
        vars(self).update(effort=Address.parse(effort), flow=Address.parse(flow))

    def __str__(self) -> str:
        return f"{self.effort} with {self.flow}"

    def check(self, system: CoupledSystem) -> str:
        """A remark where nobody says what a unit means, else ""; CouplingError for no power bond.

        Both are connected, to each other's participants, and their product is a power, by what
        their units are made of.
        """
        for source, sink in ((self.effort, self.flow), (self.flow, self.effort)):
            find_port(system.participants, source)
            feed = _feed(system, source, sink.participant)
            if system.conversions[feed].factor == 0.0:
                raise CouplingError(
                    f"power bond {self}: {feed} has the factor 0, allowed is another"
                )
        ports = [find_port(system.participants, each) for each in (self.effort, self.flow)]
        units = " times ".join("no unit" if port.unit == "1" else port.unit for port in ports)
        first, second = (port.definition for port in ports)
        if first is None or second is None:
            return f"power bond {self}: whether {units} is a power is not checked: not defined"
        exponents = [a + b for a, b in zip(first.exponents, second.exponents, strict=True)]
        if tuple(exponents[:COUNTED]) != POWER[:COUNTED] or first.offset or second.offset:
            raise CouplingError(
                f"power bond {self}: {units} ({told_dimension(exponents)}) is no power, allowed "
                "are two outputs whose product is one, as force and velocity, in W or multiples"
            )
        return ""

    def watts(self, system: CoupledSystem) -> float:
        """W that the product of the two is in: 1000 of kN and m/s; 1 where nobody says."""
        ports = [find_port(system.participants, each) for each in (self.effort, self.flow)]
        first, second = (port.definition for port in ports)
        return 1.0 if first is None or second is None else first.factor * second.factor

    def values(self, exchange: Exchange) -> tuple[float, float, float, float]:
        """Effort given, effort got, flow given, flow got in the step that has just been made."""
        return (
            *_both_ends(exchange, self.effort, self.flow.participant),
            *_both_ends(exchange, self.flow, self.effort.participant),
        )


def _feed(system: CoupledSystem, source: Address, sink: str) -> Connection:
    for each in system.connections:
        if each.source == source and each.sink.participant == sink:
            return each
    raise CouplingError(f"power bond: {source} does not feed {sink}, allowed are outputs that do")


def _both_ends(exchange: Exchange, source: Address, sink: str) -> tuple[float, float]:
    """Value that a source gives, and what the participant at the other end stepped with.

    Both as the source counts: a force that is turned round on its way is the same force.
    """
    feed = _feed(exchange.system, source, sink)
    got = exchange.inputs[sink][feed.sink.port]
    way = exchange.system.conversions[feed]
    given = exchange.outputs[source.participant][source.port]
    return given, (got - way.offset) / way.factor
