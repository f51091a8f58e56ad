"""What a coupled run returns, also when it did not reach its end."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from cosim.coupling.ledger import Ledger
from cosim.names import unknown_name

Status = Literal["complete", "interrupted", "failed"]


@dataclass(frozen=True)
class CoupledResult:
    """A coupled run up to where it came.

    time: recorded times in s, (n,). values: `participant.port` -> (n,), all outputs and the
    connected inputs. units: same keys -> unit. ledger: energy at the same times.
    status: "complete"; "interrupted" (by the user); "failed" (error holds the exception).
    reason: one line on why it is not complete, else "". wall_time: of the steps, s.
    sweeps: how many sweeps the initial exchange took. steps: macro steps made.
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

    def __getitem__(self, name: str) -> np.ndarray:
        """The recorded values of `participant.port`, (n,)."""
        if name not in self.values:
            raise KeyError(unknown_name("recorded variable", name, self.values))
        return self.values[name]
