"""How long an own belt must be: one drive of any material, its answer and how sure that is.

Two questions: does the belt come round cold, and is the interface steady? For each the shortest
belt of the nominal rig, the shortest in 5, 50 and 95 % of the rigs that may be meant, and in how
many of them the belt that is there is long enough.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

from cosim.scenario import Scenario

from .case import Case
from .drift import CAMERA, endless_belt, interface_drift, run_drift, steady_drift
from .lengths import LONGEST, Length, between, rounded_up, shortest_belt
from .rigs import MOST_MELTING, Rigs
from .scenario_priors import scenario_case
from .uncertainty import INTERVAL, quantiles
from .unknowns import ENTRY, INTERFACE, Melts

Array = NDArray[np.float64]

#: The rises of the two questions.
QUESTIONS = (ENTRY, INTERFACE)
#: Lengths at which the rigs are looked at, and how many rigs there are, a power of two.
POINTS, RIGS = 40, 2048
#: The lengths go from this part of the nominal shortest belt to this many times its length: the
#: sampled rigs need hardly less, and up to ten times as much.
_PART, _TIMES = 0.7, 16.0
#: And at least to this many times the belt that is there, where nearly any belt does.
_TIMES_OWN = 4.0
#: Smallest rise that is told apart from none, in parts of the limit.
_FLOOR = 0.03
#: Why there is no doubt where none was wanted.
NOT_ASKED = "no doubt was asked for"
#: The levels that are told, with what they are called.
LEVELS = (f"{INTERVAL[0]:.0%} level", "median", f"{INTERVAL[1]:.0%} level")


@dataclass(frozen=True)
class Question:
    """One question about a belt; lengths in m, rises in K.

    rise: on the case's own belt, nominal rig. shortest, for_ever: belts that keep it below
    the limit at the end of the runs, and in all time; None where none does up to the longest that
    is tried. low, median, high: shortest belts in 5, 50 and 95 % of the sampled rigs, rises:
    on the case's own belt at these levels; share: of these rigs in which the own belt is long
    enough. All four None where there is no doubt, `Answer.reason` says why.
    """

    rise: float
    shortest: float | None
    for_ever: float | None
    low: Length | None = None
    median: Length | None = None
    high: Length | None = None
    rises: tuple[float, float, float] | None = None
    share: float | None = None

    @property
    def levels(self) -> tuple[Length | None, Length | None, Length | None]:
        """Shortest belts in 5, 50 and 95 % of the rigs."""
        return self.low, self.median, self.high


@dataclass(frozen=True)
class Answer:
    """How long a belt must be, for one drive.

    Attributes
    ----------
    case : what was asked, with the length of the belt that is there
    limit : largest rise that is allowed, K
    run, interface : does the belt come round cold, is the interface steady
    lengths : m, (n,); of the sampled rigs
    levels : K, (2, 3, n): for both questions 5, 50 and 95 % of the rigs' rises over ``lengths``
    evaluations : runs of the model for the doubt; unexplained: share of the variance that is missed
        in its place, for both questions
    reason : why there is no doubt, "" where there is
    melts : share of the sampled rigs, on the case's own belt, in which the ice comes to melt;
        their rises are told as if it did not
    """

    case: Case
    limit: float
    run: Question
    interface: Question
    lengths: Array
    levels: Array
    evaluations: int = 0
    unexplained: tuple[float, float] = (0.0, 0.0)
    reason: str = ""
    rigs: Rigs | None = None
    melts: float = 0.0

    def as_dict(self) -> dict[str, object]:
        """Everything but the rigs, for JSON."""
        return {
            "speed": self.case.speed,
            "length": self.case.length,
            "limit": self.limit,
            "run": asdict(self.run),
            "interface": asdict(self.interface),
            "evaluations": self.evaluations,
            "unexplained": list(self.unexplained),
            "reason": self.reason,
            "melts": self.melts,
            "lengths": self.lengths.tolist(),
            "levels": self.levels.tolist(),
        }

    def __repr__(self) -> str:
        run = self.run
        least = "no belt" if run.shortest is None else f"{rounded_up(run.shortest)[0]} m"
        sure = f", {run.low.says} to {run.high.says} m" if run.low and run.high else ""
        return (
            f"<Answer: {least}{sure} for {self.limit:g} K at {self.case.speed:g} m/s; on"
            f" {self.case.length:g} m {run.rise:.2g} K>"
        )


def how_long(
    asked: Case | Scenario,
    limit: float = CAMERA,
    *,
    samples: int = 128,
    jobs: int = 1,
    lengths: Sequence[float] = (),
) -> Answer:
    """How long the belt must be that meets the ice less than a limit above the air.

    Parameters
    ----------
    asked : a scenario, whose belt (layers, width, rollers, railing), block, contact, air, ramp and
        run are taken, what it does not say being in doubt; or a `Case`. Elements, cells and strips
        are the study's own; where no heat transfer to the air is said, it is that of a belt moving
        through still air (`Case.film`), not the scenario's default
    limit : largest rise that is allowed, K, > 0, such as what a camera tells apart
    samples : runs of the model for the doubt, a power of two from 32; 0 for none
    jobs : processes
    lengths : of further belts, m, on which the sampled rigs are to be known

    Returns an `Answer`. Raises StudyError in one line for a scenario without a belt, or whose belt
    never slides; ParameterError for what has no room on its belt; NoSteadyState where nothing
    takes the heat for ever.

    >>> from cosim import read_scenario
    >>> from cosim.studies.belt_length import how_long
    >>> steel = {"thickness": 5e-4, "density": 7850.0, "heat_capacity": 470.0, "conductivity": 45.0}
    >>> own = read_scenario().changed({"belt": {"length": 2.0, "layers": [steel]}})
    >>> how_long(own, limit=0.05, samples=0)
    <Answer: 0.37 m for 0.05 K at 0.15 m/s; on 2 m 0.0085 K>
    """
    case = scenario_case(asked) if isinstance(asked, Scenario) else asked
    endless = endless_belt(case).length
    shortest = shortest_belt(case, limit, interface_drift, min(LONGEST, endless))
    run = Question(
        run_drift(case),
        shortest_belt(case, limit, run_drift),
        shortest_belt(case, limit, steady_drift),
    )
    interface = Question(interface_drift(case), shortest, None)
    if not samples:
        return _without(case, limit, run, interface, NOT_ASKED)
    tried = run.shortest or LONGEST
    belts = [case.length, *lengths]
    low = max(case.shortest, min(_PART * tried, min(belts)))
    # farther than the belt goes in all runs nothing changes
    farthest = max(_TIMES * tried, _TIMES_OWN * case.length)
    high = max(min(farthest, 1.2 * endless, LONGEST), 1.01 * max(belts), 1.5 * low)
    try:
        rigs = Rigs(case, samples, (low, high), _FLOOR * limit, jobs)
    except Melts:
        return _without(case, limit, run, interface, "the air is as warm as melting ice")
    return _doubted(case, limit, run, interface, rigs, np.geomspace(low, high, POINTS))


def _without(
    case: Case, limit: float, run: Question, interface: Question, why: str, melts: float = 0.0
) -> Answer:
    nothing = np.empty((2, 3, 0))
    return Answer(case, limit, run, interface, np.empty(0), nothing, reason=why, melts=melts)


def _doubted(
    case: Case, limit: float, run: Question, interface: Question, rigs: Rigs, lengths: Array
) -> Answer:
    drawn = qmc.Sobol(len(rigs.unknowns), rng=2).random(RIGS)
    melts = rigs.melting(drawn, case.length)
    if melts > MOST_MELTING:
        why = f"in {melts:.0%} of the sampled rigs the ice comes to melt"
        return _without(case, limit, run, interface, why, melts)
    levels = {
        rise: np.array([quantiles(rigs.rise(rise, drawn, length)) for length in lengths]).T
        for rise in QUESTIONS
    }

    def sure(question: Question, rise: int) -> Question:
        own = rigs.rise(rise, drawn, case.length)
        low, median, high = (
            between(lengths.tolist(), each.tolist(), limit, name)
            for each, name in zip(levels[rise], LEVELS, strict=True)
        )
        return replace(
            question,
            low=low,
            median=median,
            high=high,
            rises=quantiles(own),
            share=float(np.mean(own <= limit)),
        )

    return Answer(
        case,
        limit,
        sure(run, ENTRY),
        sure(interface, INTERFACE),
        lengths,
        np.array([levels[rise] for rise in QUESTIONS]),
        rigs.evaluations,
        (rigs.unexplained[ENTRY], rigs.unexplained[INTERFACE]),
        rigs=rigs,
        melts=melts,
    )
