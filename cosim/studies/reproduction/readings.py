"""Readings of the study's scheme: what its print leaves open, and what each makes of its datasets.

The study prints five marks of its two datasets. The scheme as printed meets one of them. Each
reading (`readings.toml`) takes something otherwise, as another passage of the study has it or as
the print leaves it open, and is laid beside all five.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any, Self

import numpy as np
from stickslip.packaged import packaged_tables
from stickslip.reference.scheme_options import PRINTED, Faults

from .cases import DATASETS, SEEDS, scheme
from .claim import FAR, OPEN, STUDY
from .motion import Motion, figures

SETTLING_CYCLES = 10  # section 5 of the study
STEADY = 20.0  # s
CYCLES, LONGEST = 80, 40.0  # s: ten cycles of #1 take 16 s
ENOUGH = 3  # a reading stands with most of the five marks
SEEN = 5.0  # deg: a rotation that shows in a plot of some hundred
WRITTEN = packaged_tables(__package__, "readings.toml")


def _mark(study: str = "", **written: Any) -> dict[str, Any]:
    """A mark as it is written; the number is the study's of that name, where there is one."""
    return written | (dict(zip(("printed", "place"), STUDY[study], strict=True)) if study else {})


#: Printed figures of a dataset, and what counts as each, low to high in its unit: a run turns by
#: half as much again as another of the same kind; a window may cut an oscillation. figure: of
#: `reading_figures`.
MARKS = [_mark(**written) for written in WRITTEN["mark"]]


@dataclass(frozen=True, eq=False)
class Reading:
    """A way to read the scheme.

    name: what is taken otherwise; place: where the study says so, empty where it leaves it open.
    faults: of the scheme; changes: of its other numbers; both, second: numbers of both datasets,
    and of #2 alone; turned: rad, at the start: the last digit of a double is what sums in another
    order leave of a perfect balance.
    """

    name: str
    place: str = ""
    faults: Faults = PRINTED
    changes: dict[str, Any] = field(default_factory=dict)
    both: dict[str, float] = field(default_factory=dict)
    second: dict[str, float] = field(default_factory=dict)
    turned: float = 1e-15

    @property
    def weight(self) -> str:
        """What a change to it is to the study."""
        return OPEN if self.place else FAR

    @property
    def seeds(self) -> tuple[int, ...]:
        """One where there is no chance in the reading."""
        chance = self.changes.get("scatter") != 0.0 and "weakening" not in self.both
        return SEEDS if chance else SEEDS[:1]

    def mended(self, *faults: str) -> Self:
        """This reading with some faults mended."""
        return replace(self, faults=self.faults.without(*faults))

    def motion(self, dataset: int, seed: int = 0, **changes: float) -> Motion:
        """A whole run of a dataset as this reading has it, with further changes of its numbers."""
        own = self.both | (self.second if dataset == 2 else {})
        one = scheme(DATASETS[dataset].changed(**own | changes), self.faults, **self.changes)
        run = one.run(cycles=CYCLES, duration=LONGEST, seed=seed, turned=self.turned)
        return Motion.of_scheme(run)


READINGS = [
    Reading(faults=PRINTED.without(*written.pop("mended", ())), **written)
    for written in WRITTEN["reading"]
]
AS_PRINTED, ROUNDED, BALANCED = READINGS[0], READINGS[3], READINGS[4]


def steady(motion: Motion) -> Motion:
    """The 20 s after the first ten cycles, or what there is."""
    cycles = motion.phases[motion.phases[:, 2] == 1, 1]
    start = cycles[:SETTLING_CYCLES][-1]
    return motion.between(start, min(start + STEADY, motion.time[-1]))


@cache
def reading_figures(reading: Reading, dataset: int, **changes: float) -> dict[str, float]:
    """Steady figures, mean over seeds where the reading has chance in it; largest rotation of all.

    onset: of a rotation that is seen, s, in the whole runs, NaN if one never turns. changes: of
    `Reading.motion`.
    """
    whole = [reading.motion(dataset, seed, **changes) for seed in reading.seeds]
    runs = [steady(run) for run in whole]
    found = figures(*runs) | {"max_rotation": max(run.rotation for run in runs)}
    return found | {"onset": float(np.mean([onset(run, SEEN) for run in whole]))}


def rotation(reading: Reading, dataset: int) -> float:
    """Largest steady rotation, deg."""
    return reading_figures(reading, dataset)["max_rotation"]


def onset(motion: Motion, angle: float = 1.0) -> float:
    """When phi first exceeds ``angle`` (deg), s; NaN where it never does."""
    turned = np.flatnonzero(np.abs(motion.phi_deg) > angle)
    return float(motion.time[turned[0]]) if len(turned) else float("nan")


@cache
def outcome(reading: Reading) -> dict[str, Any]:
    """A reading laid beside the marks, as JSON and page have it; s until #2 turns by 1°."""
    values = tuple(reading_figures(reading, mark["dataset"])[mark["figure"]] for mark in MARKS)
    found = {"values": values, "met": met(values), "reading": reading.name}
    return found | {"place": reading.place, "turned_by_1deg_after_s": onset(reading.motion(2))}


def met(values: Sequence[float]) -> tuple[bool, ...]:
    """Which of `MARKS` are met, by values in their order."""
    return tuple(
        mark["low"] <= value <= mark["high"] for mark, value in zip(MARKS, values, strict=True)
    )


def standing() -> list[Reading]:
    """The readings that meet most marks."""
    return [one for one in READINGS if sum(outcome(one)["met"]) >= ENOUGH]
