"""A port: all that the master knows of what a participant takes in or gives out."""

from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType


class Causality(StrEnum):
    """Which way a value crosses a port, seen from its participant."""

    INPUT = "input"
    OUTPUT = "output"


@dataclass(frozen=True)
class Port:
    """A scalar that crosses the border of a participant.

    name: unique within the participant; unit: its FMI 2 spelling, "1" for a plain number.
    """

    name: str
    unit: str
    causality: Causality


def inputs(**units: str) -> tuple[Port, ...]:
    """Input ports from name=unit, in the order given: `inputs(heat="J", x="m")`."""
    return tuple(Port(name, unit, Causality.INPUT) for name, unit in units.items())


def outputs(**units: str) -> tuple[Port, ...]:
    """Output ports from name=unit, in the order given."""
    return tuple(Port(name, unit, Causality.OUTPUT) for name, unit in units.items())


def port_table(ports: Iterable[Port]) -> MappingProxyType[str, Port]:
    """Name -> port, read-only, order kept; ValueError when a name comes twice."""
    table: dict[str, Port] = {}
    for port in ports:
        if port.name in table:
            raise ValueError(f"port {port.name!r} is declared twice")
        table[port.name] = port
    return MappingProxyType(table)
