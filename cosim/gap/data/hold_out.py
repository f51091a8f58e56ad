"""Which runs are fitted and which are kept for judging; never the same data on both sides."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from cosim.gap.data.errors import CampaignError
from cosim.gap.data.measured import MeasuredRun

#: So many equal samples in a row are no coincidence of two measurements.
PATTERN = 16


def without_duplicates(
    runs: Sequence[MeasuredRun], source: str
) -> tuple[tuple[MeasuredRun, ...], list[str]]:
    """Runs whose data are in no earlier run, and a remark on each that was left out.

    Of two runs with the same data the fitted one stays: a copy tells nothing new, and a held-out
    copy of a fitted run would judge the fit by its own data. CampaignError where the same data are
    said to come from two operating points: one of them is wrong.
    """
    kept: list[MeasuredRun] = []
    remarks = []
    for run in sorted(runs, key=lambda run: run.hold_out):
        twin = next((other for other in kept if _same_data(run, other)), None)
        if twin is None:
            kept.append(run)
            continue
        if run.operating_point != twin.operating_point:
            raise CampaignError(
                f"{source}: {run.name} holds the same data as {twin.name}, but its mass, "
                "stiffness, surface_speed or ambient_degC differ; allowed is each measurement once"
            )
        copy = " and is not held out from it" if run.hold_out and not twin.hold_out else ""
        remarks.append(f"{run.name} holds the same data as {twin.name}{copy}: left out")
    order = {id(run): place for place, run in enumerate(runs)}
    return tuple(sorted(kept, key=lambda run: order[id(run)])), remarks


def _same_data(run: MeasuredRun, other: MeasuredRun) -> bool:
    """Whether one track is the other or a part of it."""
    if run.track is None or other.track is None:
        return run.summary is not None and run.summary == other.summary
    short, long = sorted((_present(run), _present(other)), key=len)
    if len(short) < PATTERN:
        return False
    starts = np.flatnonzero(long[: len(long) - len(short) + 1] == short[0])
    for place in range(1, PATTERN):
        starts = starts[long[starts + place] == short[place]]
    return any(np.array_equal(long[start : start + len(short)], short) for start in starts)


def _present(run: MeasuredRun) -> np.ndarray:
    return run.motion.x[np.isfinite(run.motion.x)]


def choose_hold_outs(runs: Sequence[MeasuredRun]) -> tuple[MeasuredRun, ...]:
    """The runs, every third of them held out, in the order of speed, mass and stiffness.

    The second, fifth, ... of that order: a held-out run then mostly lies between two that are
    fitted, and slow and fast ones are both judged. Of two runs the faster one is held out; a single
    run is not. Runs of which only figures are known stay for the fit.
    """
    order = sorted(
        (run for run in runs if run.track is not None),
        key=lambda run: (abs(run.surface_speed), run.mass, run.stiffness, run.name),
    )
    chosen = {id(run) for run in order[1::3]}
    return tuple(replace(run, hold_out=id(run) in chosen) for run in runs)
