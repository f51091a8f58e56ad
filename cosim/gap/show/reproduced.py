"""What the FMU did of a run."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True)
class Reproduced:
    """A run's first segment, from one initial state, by the FMU.

    Attributes
    ----------
    name : of the run
    time : (n,) s, the data's samples up to where the fit started anew from the data
    motion : channel -> (n,) by the FMU, the tracker's zero included, m or rad
    measured : channel -> (n,) the data
    gap : root mean square of measured less FMU over all channels, units of the noise
    plain_gap : of the plain model, fitted, in the same segment
    apart : largest difference between the FMU and the compiled kernel in any channel, noise units
    """

    name: str
    time: np.ndarray = field(repr=False)
    motion: dict[str, np.ndarray] = field(repr=False)
    measured: dict[str, np.ndarray] = field(repr=False)
    gap: float
    plain_gap: float
    apart: float
