"""Whether there is enough: seconds of record, and runs.

Friction scatters from stretch to stretch of a run and from run to run, and an effect is what goes
beyond that. A standard deviation from n pieces is known to 1 / sqrt(2 (n - 1)) of itself: from two
pieces to 71 %, from one not at all.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from cosim.gap.data import Campaign, MeasuredRun
from cosim.gap.data.cycles import cycle_features
from cosim.gap.data.stick_remarks import never_slips
from cosim.gap.estimation.segments import CYCLES

from .doubt import Doubt, rounded

#: Fewest runs, and fewest stretches of `CYCLES` cycles beyond the first of each run.
RUNS, STRETCHES = 2, 2


def doubts_of_record(campaign: Campaign, runs: Sequence[MeasuredRun]) -> list[Doubt]:
    """Of the seconds in all runs, and of their number."""
    return [*_of_seconds(runs), *_of_runs(runs)]


def _of_seconds(runs: Sequence[MeasuredRun]) -> list[Doubt]:
    slipping = [run for run in runs if not never_slips(run)]
    if not slipping:
        return []
    cycles = {run.name: max(cycle_features(run).cycles, 0) for run in slipping}
    beyond = sum(max(count // CYCLES - 1, 0) for count in cycles.values())
    if beyond >= STRETCHES:
        return []
    seconds = sum(run.motion.duration for run in slipping)
    cycle = seconds / max(sum(cycles.values()), 1)
    wanted = cycle * CYCLES * (STRETCHES + len(slipping))
    nothing = max(cycles.values()) < CYCLES
    return [
        Doubt(
            "record",
            "",
            seconds,
            wanted,
            "s",
            f"all runs: {rounded(seconds)} s hold {sum(cycles.values())} whole cycles, expected "
            f"are {rounded(wanted)} s or more ({CYCLES * (STRETCHES + len(slipping))} cycles): how "
            "far friction scatters within a run is not known, and a missing effect not told from "
            "it",
            nothing,
        )  # fmt: skip
    ]


def _of_runs(runs: Sequence[MeasuredRun]) -> list[Doubt]:
    if len(runs) >= RUNS:
        return []
    return [
        Doubt(
            "runs",
            runs[0].name if runs else "",
            float(len(runs)),
            float(RUNS),
            "runs",
            f"{runs[0].name}: 1 run, expected are {RUNS} or more: what differs from run to run by "
            "itself is not known, nor what goes with speed, mass or springs, and nothing can be "
            "held out",
        )  # fmt: skip
    ]


def known_to(pieces: int) -> float:
    """Relative standard error of a standard deviation from so many pieces.

    >>> round(known_to(3), 2)
    0.5
    """
    return 1.0 / math.sqrt(2.0 * (pieces - 1)) if pieces > 1 else math.inf
