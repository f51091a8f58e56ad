"""Data are checked before fitting: the record, and the numbers stated of the rig.

A fit turns every number that it may, so a rig that is not as stated, or a record that cannot hold
the motion, may come out as a missing effect, or as none. Each doubt names the runs, the figure and
what would be expected of it. On campaigns that are as stated each check raises one in `LEVEL` of
them at most, of campaigns whose noise, zeros and set-points scatter as said. A severe doubt is one
beside which nothing can be concluded.
"""

from __future__ import annotations

from collections.abc import Sequence

from cosim.gap.data import Campaign, MeasuredRun
from cosim.gap.result import Doubt
from cosim.gap.windows.windows import cycle

from . import motion
from .level import LEVEL
from .tracker import digits_evidence, doubts_of_noise, doubts_of_sampling, with_rounding

__all__ = ["ANSWERABLE", "LEVEL", "blocking", "digits_evidence", "doubts_of", "with_rounding"]

#: Severe doubts that findings may answer: swings that springs alone have not, and sticks at the
#: crests or the troughs of a drive that is not steady.
ANSWERABLE = ("springs", "speed")

#: Cycles of a window, and fewest windows beyond the first of each run: a standard deviation from
#: two pieces is known to 71 % of itself, from one not at all.
CYCLES, WINDOWS = 3, 2


def doubts_of(campaign: Campaign) -> tuple[Doubt, ...]:
    """Of the runs that have a track, in the order of the checks.

    A run whose units, samples, direction or speed are in doubt is not asked for more: what follows
    takes them as they are.
    """
    every = [run for run in campaign.runs if run.track is not None]
    doubts = motion.doubts_of_units(every)
    runs = _but(every, doubts)
    doubts += _of_record(runs)
    for check in (doubts_of_sampling, motion.doubts_of_direction, motion.doubts_of_speed):
        found = check(campaign, runs)
        runs = _but(runs, [doubt for doubt in found if not doubt.text.startswith("all runs")])
        doubts += found
    for check in (motion.doubts_of_springs, motion.doubts_of_force, doubts_of_noise):
        doubts += check(campaign, runs) if runs else []
    return tuple(doubts)


def blocking(doubts: Sequence[Doubt]) -> tuple[Doubt, ...]:
    """Severe doubts that no finding can answer: nothing is named beside them."""
    return tuple(one for one in doubts if one.severe and one.check not in ANSWERABLE)


def _but(runs: Sequence[MeasuredRun], doubts: Sequence[Doubt]) -> list[MeasuredRun]:
    """Runs without those in doubt."""
    doubted = {name for doubt in doubts for name in doubt.runs}
    return [run for run in runs if run.name not in doubted]


def _of_record(runs: Sequence[MeasuredRun]) -> list[Doubt]:
    """Of the cycles in all runs, and of their number.

    Friction scatters from stretch to stretch and from run to run, and an effect is what goes beyond
    that.
    """
    doubts, names = [], tuple(run.name for run in runs)
    cycles = [int(run.motion.duration / cycle(run)) for run in runs]
    beyond = sum(max(count // CYCLES - 1, 0) for count in cycles)
    if runs and beyond < WINDOWS:
        text = (
            f"all runs: {sum(run.motion.duration for run in runs):.3g} s hold {sum(cycles)} "
            f"cycles, expected are {CYCLES * (WINDOWS + len(runs))}: how far friction scatters "
            "within a run is not known"
        )
        doubts.append(Doubt("record", text, names, max(cycles) < CYCLES))
    if len(runs) == 1:
        alone = "a single run: how far friction scatters from run to run is not known"
        doubts.append(Doubt("runs", f"{names[0]}: {alone}, and nothing is held out", names))
    return doubts
