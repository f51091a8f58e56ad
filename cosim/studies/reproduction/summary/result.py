"""What the workflow says of a campaign of figures: plain data, for whoever draws or writes it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from cosim.gap.data import Campaign

from .observations import Observation


@dataclass(frozen=True)
class Where:
    """Where the misfit lives; regime is empty: figures do not tell it."""

    channel: str
    regime: str
    runs: tuple[str, ...]
    text: str


@dataclass(frozen=True)
class FittedSummary:
    """A model beside the observed figures.

    values: block.parameter -> number. shown, scatter (n,): mean of each figure over the seeds and
    its standard deviation from seed to seed. residuals (n,): distance in the observations'
    standard deviations. gap: their root mean square. lack_of_fit: probability of figures this far
    off or farther, were the model (its scatter included) true.
    """

    values: Mapping[str, float]
    shown: np.ndarray
    scatter: np.ndarray
    residuals: np.ndarray
    gap: float
    held_out_gap: float
    lack_of_fit: float


@dataclass(frozen=True)
class Ranked:
    """An effect tried: gaps in standard deviations, BIC of the plain model less its own.

    held_out_gap: each figure predicted by the fit to the others. intervals: parameter -> range of
    the draws within 95 % of the best.
    """

    effect: str
    form: str
    held_out_gap: float
    fit_gap: float
    delta_bic: float
    parameters: Mapping[str, float]
    intervals: Mapping[str, tuple[float, float]]


@dataclass(frozen=True)
class SummaryGap:
    """The answer for runs of which only figures are known; the fields of a gap.

    Attributes
    ----------
    verdict : "named", "class", "none" or "unknown"
    effects : in the order found; for "class" its members
    found : effects in the extended model, in the order found
    classes : groups of effects that these figures cannot tell apart
    gap_before, gap_after : (fit, held out), standard deviations
    printed : the model with the numbers as they are known, not refitted
    plain, extended : the fits
    chance : "p" of the best of the catalogue under the plain model, "draws", "delta_bic"
    determined : plain parameter -> (value, low, high)
    free_friction : the plain fit, were nothing known of friction; None where nothing is
    not_felt : effects that these figures cannot tell from none, each with the reason
    open_figures : figures of which the answer cannot tell, each with the reason
    remarks : a line each
    fits_share : of draws of friction as it is known, the share that fits with the effect as found
        (within twice the gap); None where the model is smooth, so that it says nothing
    """

    campaign: Campaign
    observations: tuple[Observation, ...]
    verdict: str
    effects: tuple[str, ...]
    found: tuple[str, ...]
    classes: tuple[tuple[str, ...], ...]
    where: Where
    ranking: tuple[Ranked, ...]
    gap_before: tuple[float, float]
    gap_after: tuple[float, float]
    printed: FittedSummary
    plain: FittedSummary
    extended: FittedSummary | None
    chance: Mapping[str, float]
    determined: Mapping[str, tuple[float, float, float]]
    free_friction: FittedSummary | None
    not_felt: Mapping[str, str]
    open_figures: Mapping[str, str]
    next_experiment: Mapping | None = None
    empirical: Mapping | None = None
    remarks: tuple[str, ...] = field(default=())
    fits_share: float | None = None
