"""What a campaign lacks, where no law takes away what the plain model leaves: a line each.

A reason for refusing a name: which runs or channels would have to be there, so that what differs
could be told from what scatters.
"""

from __future__ import annotations

from collections import Counter

import numpy as np

from cosim.gap.data import Campaign, cycle_features
from cosim.gap.data.stick_remarks import SPEED_PART
from cosim.gap.evidence.products import Spreads
from cosim.gap.selection.decision import SCATTERS


def lacking(campaign: Campaign, spreads: Spreads) -> tuple[str, ...]:
    """Of a campaign that no model fits, with the spreads of the best that there is."""
    lines = [*_of_repetition(campaign, spreads), *_of_speed(campaign), *_of_channels(campaign)]
    return tuple(lines)


def _of_repetition(campaign: Campaign, spreads: Spreads) -> list[str]:
    """Whether what differs within a run, and between two, comes back."""
    lines = []
    if spreads.stretch > SCATTERS:
        lines.append(
            f"friction differs by {100.0 * spreads.stretch:.2g} % from stretch to stretch of a "
            "run, and no law that the runs share takes that up: the same piece of surface, run "
            "over twice, would tell what belongs to the place from what comes by chance"
        )
    settings = Counter((run.mass, run.stiffness, run.surface_speed) for run in campaign.runs)
    if settings and max(settings.values()) == 1:
        lines.append(
            f"each of the {len(settings)} settings was run once: what goes with mass, springs or "
            "speed cannot be told from what differs from run to run by itself"
        )
    return lines


def _of_speed(campaign: Campaign) -> list[str]:
    """How far sticks are from going with the surface."""
    parts = [
        cycle_features(run).stick_speed.value / run.surface_speed
        for run in campaign.runs
        if run.track is not None
    ]
    seen = [part for part in parts if np.isfinite(part)]
    if not seen or max(abs(part - 1.0) for part in seen) <= SPEED_PART:
        return []
    return [
        f"sticks move at {min(seen):.3g} to {max(seen):.3g} of the speeds given: a speed that is "
        "measured, not set, would tell creep from a wrong scale of x"
    ]


def _of_channels(campaign: Campaign) -> list[str]:
    """What of the motion and of its cause was not seen."""
    seen = {name for run in campaign.runs if run.track is not None for name in run.motion.channels}
    across = [name for name in ("y", "phi") if name not in seen]
    lines = []
    if across:
        names = " and ".join(across)
        lines.append(f"{names} not measured: whether the block leaves its line is not known")
    if not any(run.track is not None and "force" in run.motion.channels for run in campaign.runs):
        lines.append(
            "no force measured: friction is known from the springs' stated stiffness alone"
        )
    return lines
