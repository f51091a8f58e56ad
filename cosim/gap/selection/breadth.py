"""How many laws a search tries, from many at a glance to a few in earnest."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Breadth:
    """Of one search.

    Attributes
    ----------
    looked_at, sketched : so many laws are looked at after the glance, and so many of them sketched
    periods, seconds : so many periods of a periodic effect, in time or along the surface, are
        tried, and so many of them with a second harmonic
    everything : whether laws that promise little are tried too, and those that do not from next to
        nothing as well as in full
    """

    looked_at: int
    sketched: int
    periods: int
    seconds: int
    everything: bool


#: Of a first effect; of one beside it; of a periodic one looked for once more beside another.
ALONE = Breadth(looked_at=16, sketched=7, periods=4, seconds=1, everything=True)
BESIDE = Breadth(looked_at=10, sketched=4, periods=3, seconds=0, everything=False)
ANEW = Breadth(looked_at=10, sketched=4, periods=3, seconds=1, everything=False)
