"""Readings of the study's scheme: what its print leaves open, and what each makes of its datasets.

The study prints five marks of its two datasets. The scheme as printed meets one of them. Each
reading takes something otherwise, as another passage of the study has it or as the print leaves it
open, and is laid beside all five.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from stickslip.reference.scheme_errors import PRINTED, Faults

from cosim.studies.reproduction.cases import STUDY

from .cases import DATASET_1, DATASET_2, SCATTER, SEEDS, WEAKENING, Case, many, scheme
from .motion import Motion, MotionFigures, average, figures

SETTLING_CYCLES = 10  # section 5 of the study
STEADY = 20.0  # s
CYCLES, LONGEST = 80, 40.0  # s: ten cycles of #1 take 16 s
# an angle of the last digit of a double: what sums in another order leave of a perfect balance
ROUNDING = 1e-15
# rad; radius of the slab: not printed
SLAB_RADIUS = 0.5
WAY_OF_A_SLIP = 0.065  # m that the surface moves in one, at 0.15 m/s


@dataclass(frozen=True)
class Mark:
    """A printed figure of a dataset, and what counts as it; low and high in the figure's unit."""

    name: str
    unit: str
    dataset: int
    figure: str  # of `MotionFigures`, or the onset of a rotation that is seen
    printed: float | str
    low: float
    high: float
    place: str

    def met(self, value: float) -> bool:
        """Whether a reading's figure counts as the printed one."""
        return self.low <= value <= self.high


MEAN_2 = STUDY["mean_x_dataset_2"]
TURN_1, TURN_2 = STUDY["rotation_dataset_1"], STUDY["rotation_dataset_2"]
SETS_IN = STUDY["rotation_sets_in"]
SETS_IN_AFTER = 10.0  # s: before it there is barely any rotation, after it the block turns
FACTOR = 1.5
ENOUGH = 3  # a reading stands with most of the five marks
SEEN = 5.0  # deg: a rotation that shows in a plot of some hundred
#: A run turns by half as much again as another of the same kind; a window may cut an oscillation.
MARKS = (
    Mark(
        "oscillations in 20 s, #2",
        "1",
        2,
        "oscillations",
        "30 or 31",
        29.5,
        32.0,
        "one or two more than the 29 of §5.4, fig. 5.11c",
    ),
    Mark("mean of x, #2", "m", 2, "mean_x", MEAN_2.number, 0.0035, 0.0045, MEAN_2.place),
    Mark(
        "largest rotation, #2",
        "deg",
        2,
        "max_rotation",
        TURN_2.number,
        TURN_2.number / FACTOR,
        TURN_2.number * FACTOR,
        TURN_2.place,
    ),
    Mark(
        "largest rotation, #1",
        "deg",
        1,
        "max_rotation",
        TURN_1.number,
        TURN_1.number / FACTOR,
        TURN_1.number * FACTOR,
        TURN_1.place,
    ),
    Mark(
        "rotation sets in, #1",
        "s",
        1,
        "onset",
        SETS_IN.value,
        SETS_IN_AFTER / FACTOR,
        SETS_IN_AFTER * FACTOR,
        SETS_IN.place,
    ),
)


@dataclass(frozen=True)
class Reading:
    """A way to read the scheme.

    name: what is taken otherwise; place: where the study says so, empty where it leaves it open.
    faults: of the scheme; changes: of its other numbers; weakening: part of mu_k lost over the
    study's speeds; speed m/s, mu_s and mu_k of dataset #2: None as in the dataset; turned: rad, at
    the start.
    """

    name: str
    place: str = ""
    faults: Faults = PRINTED
    changes: tuple[tuple[str, float | str | bool], ...] = ()
    weakening: float = 0.0
    speed: float | None = None
    quarter: tuple[float, float] | None = None
    turned: float = ROUNDING

    def case(
        self, dataset: int, stiffness: float = DATASET_1.stiffness, mu_k: float | None = None
    ) -> Case:
        """The dataset as this reading has it, on springs of ``stiffness`` N/m; mu_k: another."""
        case = {1: DATASET_1, 2: DATASET_2}[dataset]
        case = case.changed(weakening=self.weakening, stiffness=stiffness)
        if self.quarter and dataset == 2:
            case = case.changed(mu_s=self.quarter[0], mu_k=self.quarter[1])
        if mu_k is not None:
            case = case.changed(mu_k=mu_k)
        return case if self.speed is None else case.changed(speed=self.speed)

    @property
    def seeds(self) -> tuple[int, ...]:
        """One where there is no chance in the reading."""
        chance = dict(self.changes).get("scatter") != 0.0 and not self.weakening
        return SEEDS if chance else SEEDS[:1]

    def mended(self, *faults: str) -> Reading:
        """This reading with some faults mended."""
        return replace(self, faults=self.faults.without(*faults))

    def motion(self, dataset: int, seed: int = 0, **case) -> Motion:
        """A whole run."""
        one = scheme(self.case(dataset, **case), self.faults, **dict(self.changes))
        return Motion.of_scheme(
            one.run(cycles=CYCLES, duration=LONGEST, seed=seed, turned=self.turned)
        )


READINGS = (
    Reading("as printed, scatter of µ_k 0.02", "§4.4.1, appendix B"),
    Reading("scatter 0.001", changes=(("scatter", 1e-3),)),
    Reading("scatter 0.000001", changes=(("scatter", 1e-6),)),
    Reading("no scatter: rounding alone turns it", changes=(("scatter", 0.0),)),
    Reading("no scatter, perfectly balanced", changes=(("scatter", 0.0),), turned=0.0),
    Reading("one draw for all strips", changes=(("common_scatter", True),)),
    Reading("µ_s drawn anew every cycle too, 0.01", "§4.4.3",
            changes=(("static_scatter", 0.5 * SCATTER),)),
    Reading("µ_k falls with speed, straight belt", "§4.4.2, §5.4", weakening=WEAKENING),
    Reading("µ_k falls with speed, slab of 0.5 m", "§4.4.2, §5.4", weakening=WEAKENING,
            changes=(("curvature", 1.0 / SLAB_RADIUS),)),
    Reading("exact quarters, µ_s 0.0704, µ_k 0.0522", "§4.6.3",
            quarter=(DATASET_1.mu_s / 4.0, DATASET_1.mu_k / 4.0)),
    Reading("surface at 0.05 m/s", "appendix B", speed=0.05),
    Reading("four springs in stick (F1 mended)", "eq. 4.21", PRINTED.without("F1")),
    Reading("r in the rise (F2 mended)", "eq. 4.6", PRINTED.without("F2")),
    Reading("mirrored angles (F13 mended)", "", PRINTED.without("F13")),
    Reading("velocities handed over (F12 mended)", "", PRINTED.without("F12")),
    Reading("re-stick located (F6 mended)", "", PRINTED.without("F6")),
    Reading("slips never cut (F14 mended)", "", PRINTED.without("F14")),
    Reading("angles fixed at 0", "§4.2.2", changes=(("treatment", "zero"),)),
    Reading("r in the rise, scatter 0.05 that lasts a slip", "", PRINTED.without("F2", "F5"),
            changes=(("scatter", 0.05), ("correlation_length", WAY_OF_A_SLIP))),
    Reading("clean switching: r in the rise, events located, velocities handed over (F2, F6, F12)",
            "", PRINTED.without("F2", "F6", "F12")),
    Reading("clean switching, slips never cut (F14 too)", "",
            PRINTED.without("F2", "F6", "F12", "F14")),
    Reading("clean switching, scatter 0.1 that lasts a slip", "",
            PRINTED.without("F2", "F5", "F6", "F12"),
            changes=(("scatter", 0.1), ("correlation_length", WAY_OF_A_SLIP))),
)  # fmt: skip
AS_PRINTED, ROUNDED, BALANCED = READINGS[0], READINGS[3], READINGS[4]


def steady_figures(motion: Motion) -> MotionFigures:
    """Of the 20 s after the first ten cycles, or of what there is."""
    cycles = motion.phases[motion.phases[:, 2] == 1, 1]
    start = cycles[min(SETTLING_CYCLES, len(cycles)) - 1]
    end = min(start + STEADY, motion.time[-1])
    return figures(motion.between(start, end))


@cache
def reading_figures(reading: Reading, dataset: int, **case) -> MotionFigures:
    """Steady figures, mean over seeds where the reading has chance in it; largest rotation of all.

    case: of `Reading.case`.
    """
    runs = [steady_figures(reading.motion(dataset, seed, **case)) for seed in reading.seeds]
    return replace(average(runs), max_rotation=max(one.max_rotation for one in runs))


@dataclass(frozen=True)
class Outcome:
    """A reading beside the marks; values in the order of `MARKS`. onset: s until #2 turns by 1°."""

    reading: Reading
    values: tuple[float, ...]
    onset: float

    @property
    def met(self) -> tuple[bool, ...]:
        """Which marks it meets."""
        return tuple(mark.met(value) for mark, value in zip(MARKS, self.values, strict=True))


def onset(motion: Motion, angle: float = 1.0) -> float:
    """When phi first exceeds ``angle`` (deg), s; NaN where it never does."""
    turned = np.flatnonzero(np.abs(np.degrees(motion.phi)) > angle)
    return float(motion.time[turned[0]]) if len(turned) else float("nan")


@cache
def outcome(reading: Reading) -> Outcome:
    """A reading laid beside the marks."""
    return Outcome(
        reading, tuple(_value(reading, mark) for mark in MARKS), onset(reading.motion(2))
    )


def _value(reading: Reading, mark: Mark) -> float:
    """The reading's figure for a mark; an onset is the mean over seeds, NaN if one never turns."""
    if mark.figure != "onset":
        return getattr(reading_figures(reading, mark.dataset), mark.figure)
    return float(np.mean([onset(reading.motion(mark.dataset, s), SEEN) for s in reading.seeds]))


def outcomes() -> list[Outcome]:
    """Every reading laid beside the marks, in the order of `READINGS`."""
    return many(outcome, READINGS)
