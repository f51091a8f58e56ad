"""C5 to C7 under every reading of the scheme that the study's two datasets leave standing."""

from __future__ import annotations

from dataclasses import dataclass

from .cases import many
from .claims.friction_level import Y_STIFFNESS, variant_of
from .claims.rotation import FACTOR, MEASURED
from .claims.spring_angles import ROTATES
from .readings import (
    AS_PRINTED,
    BALANCED,
    ENOUGH,
    MARKS,
    ROUNDED,
    Outcome,
    Reading,
    outcomes,
    reading_figures,
)

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


def misfit(reading: Reading, dataset: int) -> float:
    """Of the five observations, in their spreads."""
    stiffer = reading_figures(reading, dataset, stiffness=Y_STIFFNESS)
    return variant_of("", reading_figures(reading, dataset), stiffer).misfit


def attribution(reading: Reading) -> Attribution:
    """The three claims under a reading."""
    turns = [reading_figures(reading, dataset).max_rotation for dataset in (1, 2)]
    misfits = (misfit(reading, 1), misfit(reading, 2), misfit(reading.mended("F1"), 1))
    without = {
        fault: reading_figures(reading.mended(fault), 1).max_rotation for fault in ("F2", "F13")
    }
    far, near = turns[0] > 150.0 / FACTOR, turns[1] < FACTOR * MEASURED
    return Attribution(reading, turns[0] > ROTATES, without, misfits, far and near)


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
        of = {one.reading: one for one in self.outcomes}
        count, mean, second, first, _ = of[AS_PRINTED].values
        rounded, balanced = of[ROUNDED], of[BALANCED]
        most = max(sum(one.met) for one in self.outcomes)
        closest = [one.reading.name for one in self.outcomes if sum(one.met) == most]
        return (
            f"{'A' if self.found else 'No'} reading of the scheme gives both of the study's "
            f"datasets. As printed it gives the rotation of dataset #1 (up to {first:.0f}° in "
            "the 20 s after ten cycles of three runs, against the study's 150°) and nothing of "
            "dataset #2: "
            f"{count:.1f} oscillations in 20 s against 30 or 31, a mean of x of {mean:+.3f} m "
            f"against +0.004 m, {second:.0f}° against 15°. The scatter is not the reason. The "
            "printed scheme is unstable: whatever first turns the block grows until the springs' "
            f"angles bound it. In perfect balance it slides straight ({balanced.values[0]:.1f} "
            f"oscillations, {balanced.values[1]:+.4f} m, no rotation); with no scatter but "
            f"rounding it does so for {rounded.onset:.0f} s, and then it turns all the same, by "
            f"{rounded.values[2]:.0f}°. Closest to all {len(MARKS)} marks, with "
            f"{most} met: {'; '.join(closest)}. "
            + ("" if self.found else "The listing alone does not make the study's figures.")
        )

    @property
    def bears(self) -> str:
        """What it does to the three claims, in sentences."""
        turning = [one for one in self.attributions if one.rotates]
        ended = {
            fault: sum(one.without[fault] < ROTATES for one in turning) for fault in ("F2", "F13")
        }
        explained = [one for one in self.attributions if one.one_spring_explains]
        others = [one.reading.name for one in self.attributions if not one.one_spring_explains]
        both = [one.reading.name for one in self.attributions if one.both]
        several = len(self.attributions)
        return (
            f"C5: dataset #1 rotates in {len(turning)} of {several} readings; mending F2 ends that "
            f"in {ended['F2']} of them, mending F13 in {ended['F13']}. C6: µ full with F1 mended "
            f"fits better than the quarter in {len(explained)} of {several}"
            + (f"; not in: {', '.join(others)}" if others else "")
            + f". C7: both of its parts in {len(both)} of {several}"
            + (f": {', '.join(both)}" if both else "")
            + "."
        )


def datasets() -> Datasets:
    """Every reading beside the marks, and the claims under those that stand."""
    every = outcomes()
    standing = [one.reading for one in every if one.reading == AS_PRINTED or sum(one.met) >= ENOUGH]
    return Datasets(tuple(every), tuple(many(attribution, standing)))
