"""What the FMU did of a run, from its start to its end."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True)
class Reproduced:
    """A run, from one initial state, by the FMU.

    Attributes
    ----------
    name : of the run
    time : (n,) s, the data's samples
    first : how many of them there are up to where the fit started anew from the data
    motion : channel -> (n,) by the FMU, the tracker's zero included, m or rad
    measured : channel -> (n,) the data
    gap : root mean square of measured less FMU over all channels of the first segment, units of
        the noise
    whole : the same over the whole run, in which small errors of the period add up
    plain_gap : of the plain model, fitted, in the first segment
    apart : largest difference between the FMU and the compiled kernel in any channel of the first
        segment, noise units
    """

    name: str
    time: np.ndarray = field(repr=False)
    motion: dict[str, np.ndarray] = field(repr=False)
    measured: dict[str, np.ndarray] = field(repr=False)
    gap: float
    plain_gap: float
    apart: float
    first: int
    whole: float
