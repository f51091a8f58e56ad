"""What a campaign lacks, where no law takes away what the plain model leaves: a line each.

A reason for refusing a name: which runs or channels would have to be there, so that what differs
could be told from what scatters.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from cosim.gap.data import Campaign, MeasuredRun
from cosim.gap.data.stick_remarks import stick_speed_off
from cosim.gap.evidence.products import Spreads
from cosim.gap.selection.decision import SCATTERS


def lacking(campaign: Campaign, spreads: Spreads) -> tuple[str, ...]:
    """Of a campaign that no model fits, with the spreads of the best that there is."""
    runs = [run for run in campaign.runs if run.track is not None]
    lines = [*_of_repetition(runs, spreads), *_of_speed(runs), *_of_channels(campaign, runs)]
    return tuple(lines)


def _of_repetition(runs: Sequence[MeasuredRun], spreads: Spreads) -> list[str]:
    """Whether what differs within a run, and between two, comes back."""
    lines = []
    if spreads.stretch > SCATTERS:
        lines.append(
            f"friction differs by {100.0 * spreads.stretch:.2g} % from stretch to stretch of a "
            "run, and no law that the runs share takes that up: the same piece of surface, run "
            "over twice, would tell what belongs to the place from what comes by chance"
        )
    settings = Counter(run.operating_point for run in runs)
    if len(runs) > 1 and max(settings.values()) == 1:
        lines.append(
            f"each of the {len(settings)} settings was run once: what goes with mass, springs or "
            "speed cannot be told from what differs from run to run by itself"
        )
    return lines


def _of_speed(runs: Sequence[MeasuredRun]) -> list[str]:
    """How far sticks are from going with the surface, where they are."""
    off = [part for run in runs if (part := stick_speed_off(run)) is not None]
    if not off:
        return []
    parts = f"{min(off):.3g}" if len(off) == 1 else f"{min(off):.3g} to {max(off):.3g}"
    return [
        f"sticks move at {parts} of the speed given in {len(off)} of {len(runs)} runs: a speed "
        "that is measured, not set, would tell creep from a wrong scale of x"
    ]


def _of_channels(campaign: Campaign, runs: Sequence[MeasuredRun]) -> list[str]:
    """What a block that is free to move across was not seen to do."""
    free = set(campaign.rig.degrees_of_freedom) & {"y", "phi"}
    unseen = [run.name for run in runs if free and not free & set(run.motion.channels)]
    if not unseen:
        return []
    where = "any run" if len(unseen) == len(runs) else ", ".join(unseen)
    return [
        f"neither y nor phi was measured in {where}: whether the block left its line is not known"
    ]
