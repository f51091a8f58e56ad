"""What a run's motion is worth: could a rig make it, and does another exist beside it?"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

from ..parameters import Parameters
from .live import DRY, Interface, RunEnded
from .pretension import COARSE, PretensionBorders, pretension_borders
from .regimes import Regime, coexisting, regimes
from .stability import Stability, stability

#: Part at constant speed that is looked at: the longest, s and in natural periods, of which the
#: longer holds, and the shortest, in natural periods.
LONGEST, PERIODS, FEWEST = 60.0, 40.0, 5.0
#: Time after which borders that are not found yet are not looked for any longer, s.
PATIENCE = 10.0


@dataclass(frozen=True)
class Assessment:
    """Stability, regimes, and the pretension that would be stable.

    Attributes
    ----------
    stability : of the straight motion, or of the run's own where the rig has no straight one
    regimes : by the names of `regimes.STARTS`, the scenario's own first
    pretension : m, as it is
    borders : pretensions at which the motion is unstable; None where that takes too long
    """

    stability: Stability
    regimes: dict[str, Regime]
    pretension: float
    borders: PretensionBorders | None

    @property
    def coexisting(self) -> dict[str, Regime]:
        """Regimes from other starts that differ from the run's own."""
        return coexisting(self.regimes)

    def as_dict(self) -> dict[str, Any]:
        """Plain numbers, SI: ``stability``, ``regimes`` and ``other_regimes``; None: not known."""
        found, borders = self.stability, self.borders
        return {
            "stability": {
                "verdict": found.verdict,
                "motion": "along the line" if found.straight else "its own",
                "growth": found.growth,
                "cycle": found.period,
                "time_to_grow": found.time_to_grow,
                "amplification": found.amplification if found.straight else None,
                "pretension": self.pretension,
                "least_pretension": None if borders is None else borders.least,
                "unstable_pretensions": None if borders is None else borders.windows,
            },
            "regimes": {start: asdict(regime) for start, regime in self.regimes.items()},
            "other_regimes": list(self.coexisting),
        }


def assess(
    parameters: Parameters,
    duration: float = 30.0,
    interface: Interface = DRY,
    *,
    look: Callable[[], None] | None = None,
) -> Assessment | None:
    """Assess a run of ``duration`` (s), of which at most a minute, or 40 swings, at constant speed.

    interface: its temperature and the water in it.
    look: called between runs, and raises TimeoutError when there is no time for more; left out, it
    does so after `PATIENCE`. None where the contact follows rate_and_state, whose runs take too
    long to be repeated, where the run is over before five swings or ends early, where nothing
    moves the block, and where there is no time.
    """
    law = parameters.rate_and_state
    ramp = parameters.surface.run_up_time
    frequency = parameters.natural_frequency
    if law.direct != 0.0 or law.evolution != 0.0 or parameters.surface.speed == 0.0:
        return None
    if frequency == 0.0 or duration - ramp < FEWEST / frequency:
        return None
    duration = min(duration, ramp + max(LONGEST, PERIODS / frequency))
    look = look or deadline(PATIENCE)
    try:
        look()
        return Assessment(
            stability(parameters, duration, interface, look),
            regimes(parameters, duration, interface, look),
            parameters.rig.spring_length - parameters.rig.spring_natural_length,
            _borders(parameters, duration, interface, look),
        )
    except (RunEnded, TimeoutError):
        return None


def deadline(patience: float) -> Callable[[], None]:
    """What raises TimeoutError when it is called after ``patience`` (s)."""
    end = time.monotonic() + patience

    def look() -> None:
        if time.monotonic() > end:
            raise TimeoutError

    return look


def _borders(parameters, duration, interface, look) -> PretensionBorders | None:
    if parameters.rig.degrees_of_freedom == ("x",):
        return PretensionBorders(())
    try:
        return pretension_borders(parameters, duration, interface, step=COARSE, look=look)
    except (RunEnded, TimeoutError):
        return None
