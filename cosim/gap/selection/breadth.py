"""How many laws a search tries, from many at a screening fit to a few in earnest."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Breadth:
    """Of one search.

    Attributes
    ----------
    looked_at, fitted coarsely : so many laws are looked at after the screening fit, and so many of them fitted coarsely
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


#: Of a first effect; of one beside it; of a periodic one looked for once more beside another.
ALONE = Breadth(started=16, coarse=7, periods=4, seconds=1, everything=True)
BESIDE = Breadth(started=10, coarse=4, periods=3, seconds=0, everything=False)
ANEW = Breadth(started=10, coarse=4, periods=3, seconds=1, everything=False)
