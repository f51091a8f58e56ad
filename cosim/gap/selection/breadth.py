"""How many laws a search tries, from many in the screening to a few fits to the end."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Breadth:
    """Of one search.

    Attributes
    ----------
    started, coarse : so many laws start a coarse fit after the screening, and so many complete it
    periods, seconds : so many periods of a periodic effect, in time or along the surface, are
        tried, and so many of them with a second harmonic
    everything : whether laws that promise little are tried too, and those that do not from next to
        nothing as well as in full
    """

    started: int
    coarse: int
    periods: int
    seconds: int
    everything: bool


#: Of a first effect; of one beside it; of a periodic one searched for once more beside another.
ALONE = Breadth(started=16, coarse=7, periods=4, seconds=1, everything=True)
BESIDE = Breadth(started=10, coarse=4, periods=3, seconds=0, everything=False)
ANEW = Breadth(started=10, coarse=4, periods=3, seconds=1, everything=False)
