"""What a run's motion is worth: could a rig make it, and does another exist beside it?"""

from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from typing import Any, TypeVar

from ..parameters import Parameters
from .borders import COARSE_STEP, Border, PretensionBorders, nearest_borders, pretension_borders
from .live import DRY, Interface, OutOfWork, RunEnded, Work, steps_per_second, unwatched
from .regimes import Regime, coexisting, grouped, regimes
from .stability import Stability, stability

#: Part at constant speed that is looked at: the longest, s and in natural periods, of which the
#: longer holds, and the shortest, in natural periods.
LONGEST, PERIODS, FEWEST = 60.0, 40.0, 5.0
#: Internal steps after which nothing further is looked for: some ten seconds on a usual core.
MOST_STEPS = 1e6


@dataclass(frozen=True)
class Assessment:
    """Stability, regimes, and the pretension that would be stable.

    Attributes
    ----------
    stability : of the straight motion, or of the run's own where the rig has no straight one
    regimes : by the names of `regimes.STARTS`, the scenario's own first
    pretension : m, as it is
    borders : pretensions at which the motion is unstable; None where that takes too many steps
    whole : whether all starts were followed within the steps that are allowed
    steady : length of the run at constant speed, s
    near : the nearest border in each of the rig's numbers; None where that takes too many steps
    """

    stability: Stability
    regimes: dict[str, Regime]
    pretension: float
    borders: PretensionBorders | None
    whole: bool = True
    near: list[Border] | None = None
    steady: float = 0.0

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
                "other_growths": list(found.others),
                "watched": self.steady,
                "cycle": found.period,
                "time_to_grow": found.time_to_grow,
                "amplification": found.amplification if found.straight else None,
                "pretension": self.pretension,
                "least_pretension": None if borders is None else borders.least,
                "unstable_pretensions": None if borders is None else borders.windows,
                "pretension_resolution": None if borders is None else borders.resolution,
            },
            "regimes": {start: asdict(regime) for start, regime in self.regimes.items()},
            "other_regimes": list(self.coexisting),
            "same_regime": grouped(self.regimes),
            "all_starts_followed": self.whole,
            "nearest_borders": None
            if self.near is None
            else [border.as_dict() for border in self.near],
        }


def assess(
    parameters: Parameters,
    duration: float = 30.0,
    interface: Interface = DRY,
    *,
    most_steps: float = MOST_STEPS,
    look: Callable[[], None] = unwatched,
) -> Assessment | None:
    """Assess a run of ``duration`` (s), of which at most a minute, or 40 swings, at constant speed.

    interface: its temperature and the water in it. most_steps: internal steps that all runs may
    take, so that the answer depends on the rig alone. look: called between runs; may raise.
    None where the contact follows rate_and_state, whose runs take too long to be repeated, where
    the run is over before five swings or ends early, where nothing moves the block, and where its
    stability alone takes too many steps.
    """
    law = parameters.rate_and_state
    ramp = parameters.surface.run_up_time
    frequency = parameters.natural_frequency
    if law.direct != 0.0 or law.evolution != 0.0 or parameters.surface.speed == 0.0:
        return None
    if frequency == 0.0 or duration - ramp < FEWEST / frequency:
        return None
    steady = duration - ramp
    duration = min(duration, ramp + max(LONGEST, PERIODS / frequency))
    try:
        density = steps_per_second(parameters, duration, interface)
        interface = replace(interface, work=Work(most_steps, density, look))
        stable = stability(parameters, duration, interface)
        found = regimes(parameters, duration, interface)
    except (RunEnded, OutOfWork):
        return None
    whole = interface.work.left >= 0.0
    borders = near = None
    if whole:
        borders = _if_followed(lambda: _borders(parameters, duration, interface))
        near = _if_followed(lambda: nearest_borders(parameters, duration, interface))
    rig = parameters.rig
    pretension = rig.spring_length - rig.spring_natural_length
    return Assessment(stable, found, pretension, borders, whole, near, steady)


Found = TypeVar("Found")


def _if_followed(find: Callable[[], Found]) -> Found | None:
    """What is found; None where a motion cannot be followed, or no steps are left for that."""
    try:
        return find()
    except (RunEnded, OutOfWork):
        return None


def _borders(parameters: Parameters, duration: float, interface: Interface) -> PretensionBorders:
    if parameters.rig.degrees_of_freedom == ("x",):
        return PretensionBorders(())
    return pretension_borders(parameters, duration, interface, COARSE_STEP)
