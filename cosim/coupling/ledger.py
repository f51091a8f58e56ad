"""The energy ledger of a coupled run: what was handed over, what was taken up, what is missing."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from cosim.coupling.system import Connection, CoupledSystem


@dataclass(frozen=True)
class EnergyFlow:
    """The joules that crossed one connection since the run's start, at the recorded times.

    handed, taken: arrays (n,) in J, both 0 at the start.
    """

    connection: Connection
    handed: np.ndarray
    taken: np.ndarray

    @property
    def in_transit(self) -> np.ndarray:
        """Handed over and not yet taken up, J, (n,)."""
        return self.handed - self.taken


@dataclass(frozen=True)
class Ledger:
    """Energy of the whole coupled system at the recorded times.

    flows: one for each connection that carries energy.
    residuals: `participant.port` -> what the participant's own ledger is off by, J, (n,).
    """

    flows: tuple[EnergyFlow, ...]
    residuals: Mapping[str, np.ndarray]

    @property
    def residual(self) -> np.ndarray:
        """What is in transit plus what the participants are off by, J, (n,); () with no record."""
        parts = [flow.in_transit for flow in self.flows] + list(self.residuals.values())
        return np.sum(parts, axis=0) if parts else np.zeros(0)

    @property
    def largest_residual(self) -> float:
        """Largest magnitude of the residual over the run, J."""
        return float(np.max(np.abs(self.residual), initial=0.0))

    @property
    def exchanged(self) -> float:
        """Joules handed over on all connections in the run, to measure a residual by."""
        return float(sum(abs(flow.handed[-1]) for flow in self.flows if flow.handed.size))


def ledger_of(system: CoupledSystem, values: Mapping[str, np.ndarray]) -> Ledger:
    """The ledger that the recorded values (`participant.port` -> (n,)) contain."""
    flows = tuple(
        EnergyFlow(
            connection,
            _since_start(values[str(connection.source)]),
            _since_start(values[str(connection.taken)]),
        )
        for connection in system.connections
        if connection.taken is not None
    )
    return Ledger(flows, {str(address): values[str(address)] for address in system.residuals})


def _since_start(values: np.ndarray) -> np.ndarray:
    return values - values[0] if values.size else values
