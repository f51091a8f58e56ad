"""Which runs are kept for judging when the campaign does not say."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from cosim.gap.read.measured import MeasuredRun


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
