"""What the rows of a campaign are asked for, all runs together."""

from __future__ import annotations

from collections.abc import Sequence

from cosim.gap.data import Campaign
from cosim.gap.weak_form.arguments import Arguments
from cosim.gap.weak_form.camera_faults import camera_faults
from cosim.gap.weak_form.rows import RunRows
from cosim.gap.weak_form.system import System
from cosim.gap.weak_form.unknowns import Unknown

#: effect, fault or other finding -> its variants.
Unknowns = dict[str, list[Unknown]]


def asked_of(campaign: Campaign, rows: Sequence[RunRows]) -> tuple[System, Arguments, Unknowns]:
    """Rows of all runs, held out or not, their arguments, and these with the camera's faults."""
    system = System(campaign, rows, every=True)
    arguments = Arguments(campaign, system.runs, system.level)
    return system, arguments, {**arguments.unknowns(), **camera_faults(system.rung())}
