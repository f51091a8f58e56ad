"""Every check on a campaign, before anything is fitted."""

from __future__ import annotations

from cosim.gap.data import Campaign

from .direction import doubts_of_direction
from .doubt import Doubt
from .force import doubts_of_force
from .record import doubts_of_record
from .sampling import doubts_of_sampling
from .short_sticks import doubts_of_short_sticks
from .springs import doubts_of_springs
from .stick_speed import doubts_of_stick_speed


def doubts_of(campaign: Campaign) -> tuple[Doubt, ...]:
    """Of the runs that have a track, in the order of the checks.

    A run whose x or speed is in doubt is not asked for more: all that follows takes them as they
    are.
    """
    runs = [run for run in campaign.runs if run.track is not None]
    doubts = [*doubts_of_sampling(campaign, runs)]
    for check in (doubts_of_direction, doubts_of_stick_speed):
        found = check(campaign, runs)
        doubted = {doubt.run for doubt in found}
        runs = [run for run in runs if run.name not in doubted]
        doubts += found
    springs = doubts_of_springs(campaign, runs)
    doubted = {name for doubt in springs for name in doubt.run.split(", ")}
    runs = [run for run in runs if run.name not in doubted]
    doubts += [*springs, *doubts_of_short_sticks(campaign, runs)]
    every = [run for run in campaign.runs if run.track is not None]
    doubts += doubts_of_force(campaign, every)
    return (*doubts, *doubts_of_record(campaign, every))
