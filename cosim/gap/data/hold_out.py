"""Which runs are fitted and which are kept for judging; never the same data on both sides."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

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
        same = f"{run.name} holds the same data as {twin.name}"
        if run.operating_point != twin.operating_point:
            raise CampaignError(
                f"{source}: {same}, but its mass, stiffness, surface_speed or ambient_degC differ; "
                "allowed is each measurement once"
            )
        copy = " and is not held out from it" if run.hold_out and not twin.hold_out else ""
        remarks.append(f"{same}{copy}: left out")
    return tuple(run for run in runs if run in kept), remarks


def _same_data(run: MeasuredRun, other: MeasuredRun) -> bool:
    """Whether one track is the other or a part of it."""
    if run.track is None or other.track is None:
        return run.summary is not None and run.summary == other.summary
    present = [one.motion.x[np.isfinite(one.motion.x)] for one in (run, other)]
    short, long = sorted(present, key=len)
    if len(short) < PATTERN:
        return False
    begins = sliding_window_view(long, PATTERN)[: len(long) - len(short) + 1]
    starts = np.flatnonzero((begins == short[:PATTERN]).all(axis=1))
    return any(np.array_equal(long[start : start + len(short)], short) for start in starts)


def with_hold_outs(
    runs: tuple[MeasuredRun, ...], source: str
) -> tuple[tuple[MeasuredRun, ...], list[str]]:
    """As marked, else by rule, and a remark on it; CampaignError where nothing is left to fit."""
    if all(run.hold_out for run in runs):
        nothing = "hold_out: true in every run, there is nothing to fit"
        raise CampaignError(f"{source}: {nothing}; allowed is false in at least one")
    if any(run.hold_out for run in runs):
        return runs, []
    runs = choose_hold_outs(runs)
    held = [run.name for run in runs if run.hold_out]
    if held:
        return runs, [f"no run is marked hold_out; held out by rule: {', '.join(held)}"]
    judged = "is the only one with a track: the model is judged by what it was fitted to"
    return runs, [f"no run is held out, {run.name} {judged}" for run in runs if run.track]


def choose_hold_outs(runs: Sequence[MeasuredRun]) -> tuple[MeasuredRun, ...]:
    """The runs, every third of them held out, in the order of speed, mass and stiffness.

    The second, fifth, ... of that order: a held-out run then mostly lies between two that are
    fitted, and slow and fast ones are both judged. Of two runs the faster one is held out; a single
    run is not. Runs of which only figures are known stay for the fit.
    """
    tracks = [run for run in runs if run.track is not None]
    tracks.sort(key=lambda run: (abs(run.surface_speed), run.mass, run.stiffness, run.name))
    return tuple(replace(run, hold_out=run in tracks[1::3]) for run in runs)
