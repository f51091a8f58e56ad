"""A campaign's runs as flights, in long windows and in short ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from cosim.gap.read import Campaign, MeasuredRun

from .flight import Flight
from .preparation import SHORT_CYCLES, prepare


@dataclass(frozen=True)
class Data:
    """The flights of a campaign: for fitting and held out, in long and in short windows.

    Every long window starts where a short one does.
    """

    fit: tuple[Flight, ...]
    short: tuple[Flight, ...]
    held_out: tuple[Flight, ...]
    held_out_short: tuple[Flight, ...]


def prepared(
    campaign: Campaign, fit: Sequence[MeasuredRun], held_out: Sequence[MeasuredRun], planar: bool
) -> Data:
    """Runs with a track. planar: the model moves across and turns as the rig allows."""
    return Data(
        prepare(campaign, fit, planar),
        prepare(campaign, fit, planar, SHORT_CYCLES),
        prepare(campaign, held_out, planar),
        prepare(campaign, held_out, planar, SHORT_CYCLES),
    )
