"""C5 to C7 under every reading of the scheme that the study's two datasets leave standing."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from . import readings
from .claims.friction_level import misfit, observed
from .claims.rotation import ROTATES, turns_far_and_near
from .readings import AS_PRINTED, MARKS, Outcome, Reading, reading_figures
from .sheet import WRITTEN

#: Claims that this bears on.
CLAIMS = ("C5", "C6", "C7")


@dataclass(frozen=True)
class Attribution:
    """What a reading makes of the claims, and which mended fault undoes it.

    rotates: #1 turns by more than the study's least (C5); without: #1's largest rotation with each
    of F2 and F13 mended, deg. misfits: with mu full, with a quarter, with mu full and F1 mended
    (C6). both: #1 turns far and #2 stays within what was measured (C7).
    """

    reading: Reading
    rotates: bool
    without: dict[str, float]
    misfits: tuple[float, float, float]
    both: bool

    @property
    def quarter_fits_better(self) -> bool:
        """As the study has it."""
        return self.misfits[1] < self.misfits[0]

    @property
    def one_spring_explains(self) -> bool:
        """Whether mu full with F1 mended fits better than the quarter."""
        return self.misfits[2] < self.misfits[1]


def attribution(reading: Reading) -> Attribution:
    """The three claims under a reading."""

    def fit(one: Reading, dataset: int) -> float:
        return misfit(observed(lambda k: reading_figures(one, dataset, stiffness=k)))

    first, second = (reading_figures(reading, dataset).max_rotation for dataset in (1, 2))
    without = {f: reading_figures(reading.mended(f), 1).max_rotation for f in ("F2", "F13")}
    misfits = fit(reading, 1), fit(reading, 2), fit(reading.mended("F1"), 1)
    both = turns_far_and_near(first, second)
    return Attribution(reading, first > ROTATES, without, misfits, both)


@dataclass(frozen=True)
class Datasets:
    """Whether the scheme gives the study's two datasets, in every reading."""

    outcomes: tuple[Outcome, ...]
    attributions: tuple[Attribution, ...]

    @property
    def found(self) -> bool:
        """Whether a reading meets every mark."""
        return any(all(one.met) for one in self.outcomes)

    @property
    def says(self) -> str:
        """What came of it, in sentences."""
        of, written = {one.reading: one for one in self.outcomes}, WRITTEN["datasets"]
        most = max(sum(one.met) for one in self.outcomes)
        said = written["says"].format(
            printed=of[AS_PRINTED].values,
            balanced=of[readings.BALANCED].values,
            rounded=of[readings.ROUNDED],
            marks=len(MARKS),
            most=most,
            closest=_names(one.reading for one in self.outcomes if sum(one.met) == most),
        )
        return str(written["found" if self.found else "none"]).format(said=said)

    @property
    def bears(self) -> str:
        """What it does to the three claims, in sentences."""
        every = self.attributions
        turning = [one.without for one in every if one.rotates]
        others = _names(one.reading for one in every if not one.one_spring_explains)
        both = [one.reading for one in every if one.both]
        return str(WRITTEN["datasets"]["bears"]).format(
            all=len(every),
            turning=len(turning),
            ended=[sum(one[fault] < ROTATES for one in turning) for fault in ("F2", "F13")],
            explained=sum(one.one_spring_explains for one in every),
            others=f"; not in: {others}" if others else "",
            both=len(both),
            both_in=f": {_names(both)}" if both else "",
        )


def _names(of: Iterable[Reading]) -> str:
    return "; ".join(one.name for one in of)


def datasets() -> Datasets:
    """Every reading beside the marks, and the claims as printed and under those that stand."""
    bearing = [AS_PRINTED, *(one for one in readings.standing() if one != AS_PRINTED)]
    return Datasets(tuple(readings.outcomes()), tuple(map(attribution, bearing)))
