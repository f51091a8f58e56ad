"""The figures that are known of a campaign's runs, and what a model makes of them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from cosim.gap.data import Campaign, MeasuredRun
from cosim.gap.data.errors import CampaignError

from .exact_model import exact_motion
from .motion import Motion, figures
from .study_model import study_motion

# which way the reporter's y axis points is not known, nor which way a symmetric rig swerves
MIRRORED = ("mean_y",)


@dataclass(frozen=True)
class Observation:
    """A published figure: of which run (place in the campaign), value and standard deviation."""

    run: int
    name: str
    figure: str
    value: float
    sd: float

    @property
    def size(self) -> float:
        """The value without a sign that says nothing."""
        return abs(self.value) if self.figure in MIRRORED else self.value


def observations(campaign: Campaign) -> tuple[Observation, ...]:
    """All figures of all runs that have a ``summary``; CampaignError where there is none."""
    found = tuple(
        Observation(i, run.name, figure, value, sd)
        for i, run in enumerate(campaign.runs)
        if run.summary
        for figure, (value, sd) in run.summary.items()
    )
    if not found:
        raise CampaignError(f"{campaign.path}: run: no run has a summary, allowed is at least one")
    return found


def predict(
    campaign: Campaign, seen: tuple[Observation, ...], values: Mapping[str, float], seed: int
) -> np.ndarray:
    """(n,) what a model with ``values`` (``block.parameter`` -> number) shows of each observation.

    A figure that the motion has not counts as zero: as far away as nothing at all. ``seed`` is
    that of the scheme's scatter, or of the exact model's start.
    """
    by_run = {
        i: figures(motion_of(campaign, campaign.runs[i], values, seed))
        for i in sorted({one.run for one in seen})
    }
    shown = np.array([by_run[one.run][one.figure] for one in seen])
    mirrored = np.array([one.figure in MIRRORED for one in seen])
    return np.nan_to_num(np.where(mirrored, np.abs(shown), shown))


def motion_of(
    campaign: Campaign, run: MeasuredRun, values: Mapping[str, float], seed: int
) -> Motion:
    """The steady part of a run of the campaign's model."""
    known = campaign.parameters(run)
    if campaign.scheme == "study":
        return study_motion(known, values, seed)
    return exact_motion(known, values, seed)
