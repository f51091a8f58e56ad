"""What a coupled run returns, also before its end.

To every result belongs its energy ledger: what was handed over, what was taken up, what is missing.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from cosim.coupling.exchange import Statistics
from cosim.coupling.system import Connection, CoupledSystem
from cosim.names import unknown_name

if TYPE_CHECKING:
    import xarray

Status = Literal["complete", "interrupted", "failed"]


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
        found: np.ndarray = self.handed - self.taken
        return found


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


@dataclass(frozen=True, repr=False)
class CoupledResult:
    """A coupled run up to where it came.

    time: recorded times in s, (n,). values: `participant.port` -> (n,), all outputs and the
    connected inputs. units: same keys -> unit. ledger: energy at the same times.
    status: "complete"; "interrupted" (by the user); "failed" (error holds the exception).
    reason: one line on why it is not complete, else "". wall_time: of the steps, s.
    sweeps: how many sweeps the initial exchange took. steps: macro steps accepted. statistics: of
    the participants and the scheme. remarks: what of the settings could not be checked or comes to
    something else than they say, a line each.
    """

    time: np.ndarray
    values: Mapping[str, np.ndarray]
    units: Mapping[str, str]
    ledger: Ledger
    status: Status
    reason: str
    error: Exception | None
    wall_time: float
    sweeps: int
    steps: int
    statistics: Statistics
    remarks: tuple[str, ...] = ()

    @property
    def converged(self) -> bool:
        """Whether no step was accepted whose iteration had not converged."""
        return not self.statistics.unconverged

    def __getitem__(self, name: str) -> np.ndarray:
        """The recorded values of `participant.port`, (n,)."""
        if name not in self.values:
            raise KeyError(unknown_name("recorded variable", name, self.values))
        return self.values[name]

    def __repr__(self) -> str:
        """What it is of, in one line."""
        reached = f"{self.time[-1]:.6g} s" if self.time.size else "no time"
        ended = f" ({self.reason})" if self.reason else ""
        return (
            f"<CoupledResult, {self.status}{ended}: {reached} in {self.steps} macro steps, "
            f"{self.time.size} rows of {len(self.values)} variables>"
        )

    def to_xarray(self) -> "xarray.Dataset":
        """Every recorded variable over ``time`` (n,), by its name `participant.port`, with units;
        ``energy_residual``: that of the ledger, J."""
        import xarray  # only for who asks for it

        variables = {
            name: ("time", values, {"units": self.units[name]})
            for name, values in self.values.items()
        } | {"energy_residual": ("time", self.ledger.residual, {"units": "J"})}
        time = ("time", self.time, {"units": "s", "long_name": "time"})
        return xarray.Dataset(
            variables, {"time": time}, {"status": self.status, "reason": self.reason}
        )


def ledger_of(system: CoupledSystem, values: Mapping[str, np.ndarray]) -> Ledger:
    """The ledger that the recorded values (`participant.port` -> (n,)) contain."""
    flows = tuple(
        EnergyFlow(
            connection,
            # what goes over this connection, where a factor splits a source among several
            system.conversions[connection].factor * _since_start(values[str(connection.source)]),
            _since_start(values[str(connection.taken)]),
        )
        for connection in system.connections
        if connection.taken is not None
    )
    return Ledger(flows, {str(address): values[str(address)] for address in system.residuals})


def _since_start(values: np.ndarray) -> np.ndarray:
    return values - values[0] if values.size else values
