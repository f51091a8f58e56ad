"""The heat ledger: what friction produced, and where it went."""

from dataclasses import astuple, dataclass, fields

import numpy as np
from numpy.typing import NDArray


@dataclass
class HeatLedger:
    """Totals since the start, J.

    `received`: friction heat of the contact; `from_railing`: what entered the belt of the heat that
    its rubbing on the railing makes.
    `to_air` and `to_supports` are integrated along with the temperatures, `belt` and `ice` are
    read off the temperature fields, `meltwater` off the water that there is: none of them is
    inferred from the others, so `residual` can fail.
    """

    received: float = 0.0
    from_railing: float = 0.0
    from_contact_to_belt: float = 0.0
    to_air: float = 0.0
    to_supports: float = 0.0
    meltwater: float = 0.0
    belt: float = 0.0
    ice: float = 0.0

    @property
    def stored(self) -> float:
        """In belt, ice and melt water."""
        return self.belt + self.ice + self.meltwater

    @property
    def lost(self) -> float:
        """To air and supports, less what rubbing on the railing brings."""
        return self.to_air + self.to_supports - self.from_railing

    @property
    def residual(self) -> float:
        """Received less everything found: 0 up to rounding."""
        return self.received - (self.stored + self.lost)

    @property
    def belt_share(self) -> float:
        """Share of the friction heat that went into the belt so far; 0 before any."""
        return self.from_contact_to_belt / self.received if self.received > 0.0 else 0.0

    def array(self) -> NDArray[np.float64]:
        """The totals as numbers, for saving."""
        return np.array(astuple(self))

    def restore(self, numbers: NDArray[np.float64]) -> None:
        """Take totals that `array` returned."""
        for field, number in zip(fields(self), numbers, strict=True):
            setattr(self, field.name, float(number))
