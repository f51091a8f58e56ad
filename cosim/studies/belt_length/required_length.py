"""How long an own belt must be: one drive of any material, its answer and how sure that is.

Two questions: does the belt come round cold, and is the interface steady? For each the shortest
belt of the nominal rig, the shortest in 5, 50 and 95 % of the rigs that may be meant, and in how
many of them the belt that is there is long enough.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from cosim.processes import processes
from cosim.result import Result
from cosim.scenario import Scenario, as_scenario
from thermal.arrays import Array

from .case import Case
from .drift import CAMERA, endless_belt, interface_drift, run_drift
from .lengths import LONGEST, Length, Levels, between, rounded_up, shortest_belts
from .rigs import MOST_MELTING, Rigs
from .uncertainty import INTERVAL, quantiles
from .unknowns import ENTRY, INTERFACE, Melts, scenario_case

#: Further belts, on which a part of the rigs is run: that many over the whole range, and at most so
#: many where a level of the rigs' rises is at the limit, until none is farther off, relative.
_SPREAD, _NEAR, _NEAR_ENOUGH = 3, 4, 0.05
FEWER = 4
#: The lengths go from this part of the nominal shortest belt to this many times its length: the
#: sampled rigs need hardly less, and up to ten times as much.
_PART, _TIMES = 0.7, 16.0
#: And at least to this many times the belt that is there, where nearly any belt does.
_TIMES_OWN = 4.0
#: Why there is no doubt where none was wanted.
NOT_ASKED = "no doubt was asked for"
#: The levels that are told, with what they are called.
LEVELS = (f"{INTERVAL[0]:.0%} level", "median", f"{INTERVAL[1]:.0%} level")
#: Of an answer, what JSON has, beside speed and length.
TOLD = (
    "limit", "run", "interface", "evaluations", "reason", "melts", "lengths",
    "levels",
)  # fmt: skip


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
class Answer(Result):
    """How long a belt must be, for one drive.

    Attributes
    ----------
    case : what was asked, with the length of the belt that is there
    limit : largest rise that is allowed, K
    run, interface : does the belt come round cold, is the interface steady
    lengths : m, (n,); of belts on which sampled rigs were run
    levels : K, (2, 3, n): for both questions 5, 50 and 95 % of the rigs' rises over ``lengths``
    evaluations : runs of the model for the doubt
    reason : why there is no doubt, "" where there is
    melts : share of the sampled rigs, on the case's own belt, in which the ice comes to melt;
        their rises are told as if it did not
    scenario : that was asked about, as TOML; "" of a `Case`
    """

    case: Case
    limit: float
    run: Question
    interface: Question
    lengths: Array
    levels: Array
    evaluations: int = 0
    reason: str = ""
    rigs: Mapping[float, Rigs] = field(default_factory=dict, repr=False)
    melts: float = 0.0
    scenario: str = field(default="", repr=False)

    def summary(self) -> dict[str, Any]:
        """What `stickslip belt-length --json` prints of the scenario."""
        return self._study.summary()

    @cached_property
    def _study(self) -> Result:
        """The study that the command makes of the question: with the row of the belt there is."""
        study = import_module(f"{__package__}.study")
        options = study.Options(self.limit, samples=self.evaluations)
        made: Result = study.Study(options, answers=[self], scenario=self.scenario)
        study.work_off(made, [self.case], 1)
        return made

    def _answer(self) -> tuple[str, Sequence[tuple[str, str]]]:
        return self._study._answer()

    def _page(self) -> str:
        return self._study._page()

    def _write(self, folder: Path) -> None:
        self._study.save(folder)

    def as_dict(self) -> dict[str, Any]:
        """Everything but the rigs, for JSON."""
        told: dict[str, Any] = {"speed": self.case.speed, "length": self.case.length}
        return told | {name: getattr(self, name) for name in TOLD}

    def shortest_in_doubt(self) -> Levels:
        """Shortest belts of the sampled rigs by rise and level."""
        unknown = Length(None, "", self.reason)
        return {
            rise: {name: getattr(question, name) or unknown for name in ("low", "median", "high")}
            for rise, question in (("run", self.run), ("interface", self.interface))
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
    asked: Case | Scenario | str | Path,
    limit: float = CAMERA,
    *,
    samples: int = 128,
    jobs: int = 1,
    lengths: Sequence[float] = (),
    progress: Callable[[int], object] = lambda count: None,
) -> Answer:
    """How long the belt must be that meets the ice less than a limit above the air.

    Parameters
    ----------
    asked : a scenario (or the name of a packaged one, or a TOML file), whose belt (layers, width,
        rollers, railing), block, contact, air, ramp and run are taken, what it does not say being
        in doubt; or a `Case`. Elements, cells and strips are the study's own; where no heat
        transfer to the air is said, it is that of a belt moving through still air (`Case.film`),
        not the scenario's default
    limit : largest rise that is allowed, K, > 0, such as what a camera tells apart
    samples : rigs of the doubt on each belt asked about, a power of two from 32, each a run of the
        model; a quarter of them on up to seven others; 0 for none
    jobs : processes
    lengths : of further belts, m, on which as many rigs are to be known
    progress : called with the number of runs for the doubt that are done since it was

    Returns an `Answer`. Raises StudyError in one line for a scenario without a belt, or whose belt
    never slides; ParameterError for what has no room on its belt; NoSteadyState where nothing
    takes the heat for ever.

    >>> from cosim import read_scenario
    >>> from cosim.studies.belt_length import how_long
    >>> steel = {"thickness": 5e-4, "density": 7850.0, "heat_capacity": 470.0, "conductivity": 45.0}
    >>> own = read_scenario().changed({"belt": {"length": 2.0, "layers": [steel]}})
    >>> found = how_long(own, limit=0.05, samples=0)
    >>> found
    <Answer: 0.37 m for 0.05 K at 0.15 m/s; on 2 m 0.0085 K>
    >>> found.save("results/belt").name
    'belt'
    """
    if not isinstance(asked, Case):
        asked = as_scenario(asked)
    case = scenario_case(asked) if isinstance(asked, Scenario) else asked
    cold, for_ever, steady = shortest_belts(case.drive, limit)
    plain = Answer(
        case,
        limit,
        Question(run_drift(case), cold, for_ever),
        Question(interface_drift(case), steady, None),
        np.empty(0),
        np.empty((2, 3, 0)),
        scenario=asked.to_toml() if isinstance(asked, Scenario) else "",
    )
    if not samples:
        return replace(plain, reason=NOT_ASKED)
    belts = sorted({case.length, *lengths})
    with processes(jobs) as mapped:

        def sampled(length: float, count: int) -> Rigs:
            return Rigs(case.with_length(length), count, mapped, progress)

        try:
            own = sampled(case.length, samples)
        except Melts:
            return replace(plain, reason="the air is as warm as melting ice")
        if own.melting > MOST_MELTING:
            why = f"in {own.melting:.0%} of the sampled rigs the ice comes to melt"
            return replace(plain, reason=why, melts=own.melting)
        rigs = {one: own if one == case.length else sampled(one, samples) for one in belts}
        found = dict(rigs)
        for one in np.geomspace(*_range(case, cold or LONGEST, belts), _SPREAD).tolist():
            found[one] = sampled(one, samples // FEWER)
        for _ in range(_NEAR):
            answer = _doubted(plain, found)
            length = _farthest(answer)
            if length is None:
                break
            found[length] = sampled(length, samples // FEWER)
    return replace(_doubted(plain, found), rigs=rigs)


def runs_for(samples: int, belts: int) -> int:
    """Most runs of the model for rigs on so many belts that are asked about."""
    return belts * samples + (_SPREAD + _NEAR) * (samples // FEWER)


def _range(case: Case, shortest: float, belts: Sequence[float]) -> tuple[float, float]:
    """Lengths between which the sampled rigs are looked at, m; belts: lengths among them."""
    low = max(case.shortest, min(_PART * shortest, *belts))
    # farther than the belt goes in all runs nothing changes
    farthest = max(_TIMES * shortest, _TIMES_OWN * case.length)
    high = min(farthest, 1.2 * endless_belt(case).length, LONGEST)
    return low, max(high, 1.01 * max(belts), 1.5 * low)


def _farthest(answer: Answer) -> float | None:
    """The shortest belt of a level, m, that is farthest off the belts on which rigs were run."""
    told = [
        one.length
        for question in (answer.run, answer.interface)
        for one in question.levels
        if one is not None and one.length is not None
    ]
    off = [float(np.min(np.abs(np.log(answer.lengths / length)))) for length in told]
    return told[int(np.argmax(off))] if off and max(off) > _NEAR_ENOUGH else None


def _doubted(plain: Answer, rigs: Mapping[float, Rigs]) -> Answer:
    """An answer with what the sampled rigs say, on belts of some lengths (m)."""
    lengths = np.array(sorted(rigs))

    def sure(question: Question, rise: int) -> tuple[Question, Array]:
        levels = np.array([quantiles(rigs[one].rises(rise)) for one in lengths.tolist()]).T
        belts = (
            between(lengths.tolist(), each.tolist(), plain.limit, name)
            for each, name in zip(levels, LEVELS, strict=True)
        )
        found: Any = dict(zip(("low", "median", "high"), belts, strict=True))
        own = rigs[plain.case.length].rises(rise)
        share = float(np.mean(own <= plain.limit))
        return replace(question, rises=quantiles(own), share=share, **found), levels

    run, run_levels = sure(plain.run, ENTRY)
    interface, interface_levels = sure(plain.interface, INTERFACE)
    return replace(
        plain,
        run=run,
        interface=interface,
        lengths=lengths,
        levels=np.array([run_levels, interface_levels]),
        evaluations=sum(one.samples for one in rigs.values()),
        melts=rigs[plain.case.length].melting,
    )
