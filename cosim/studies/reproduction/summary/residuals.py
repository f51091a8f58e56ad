"""Figures as further observations in a fit to tracks."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from cosim.gap.data import Campaign, MeasuredRun

from .exact_model import exact_motion
from .motion import figures
from .observations import MIRRORED


def summary_residuals(
    campaign: Campaign, run: MeasuredRun, values: Mapping[str, float]
) -> np.ndarray:
    """(n,) distance of the exact model from each figure of ``run.summary``, in its order.

    In units of the figures' standard deviations, as residuals of a track are in units of its
    noise, so that a fit may append them. values: ``block.parameter`` -> number, friction included.
    The block is put down in its place: what a symmetric rig does by chance is not looked for.
    """
    shown = figures(exact_motion(campaign.parameters(run), values, None))
    return np.array(
        [
            (_size(figure, np.nan_to_num(shown[figure])) - _size(figure, value)) / sd
            for figure, (value, sd) in run.summary.items()
        ]
    )


def _size(figure: str, value: float) -> float:
    return abs(value) if figure in MIRRORED else value
