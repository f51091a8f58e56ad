"""The answer to a campaign of figures, as plain data: where the misfit lives, what stays open."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from cosim.gap.data import Campaign
from cosim.gap.result import Ranked, Where

from .candidates import not_felt
from .draws import FittedSummary, Observation
from .models import SAID

# distance in standard deviations from which a figure is not met
MET = 2.0


@dataclass(frozen=True)
class SummaryGap:
    """The answer for runs of which only figures are known; the fields of a gap.

    Attributes
    ----------
    verdict : "named", "class", "none" or "unknown"
    effects : in the order found; for "class" its members
    found : effects in the extended model, in the order found
    classes : groups of effects that these figures cannot tell apart
    printed : the model with the numbers as they are known, not refitted
    plain, extended : the fits
    chance : "p" of the best of the catalogue under the plain model, "draws", "delta_bic"
    determined : plain parameter -> (value, low, high)
    free_friction : the plain fit, were nothing known of friction; None where nothing is
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
    ranking: tuple[Ranked, ...]
    printed: FittedSummary
    plain: FittedSummary
    extended: FittedSummary | None
    chance: Mapping[str, float]
    determined: Mapping[str, tuple[float, float, float]]
    free_friction: FittedSummary | None
    remarks: tuple[str, ...] = ()
    fits_share: float | None = None

    @property
    def last(self) -> FittedSummary:
        """The model that is left."""
        return self.extended or self.plain

    @property
    def gap_before(self) -> tuple[float, float]:
        """Fit and held out, standard deviations."""
        return self.plain.gap, self.plain.held_out_gap

    @property
    def gap_after(self) -> tuple[float, float]:
        """The same of the model that is left."""
        return self.last.gap, self.last.held_out_gap

    @property
    def not_felt(self) -> dict[str, str]:
        """Effects that these figures cannot tell from none, each with the reason."""
        return not_felt(self.campaign)

    @property
    def where(self) -> Where:
        """The figures in which the plain model misses, the worst first; they tell no regime."""
        seen, plain = self.observations, self.plain
        order = np.argsort(-np.abs(plain.residuals))
        off = [i for i in order if abs(plain.residuals[i]) > MET]
        if not off:
            return Where("", "", (), SAID["met"])
        parts = [
            SAID["missed"].format(one=seen[i], shown=plain.shown[i], off=plain.residuals[i])
            for i in off
        ]
        runs = tuple(dict.fromkeys(seen[i].name for i in off))
        return Where(seen[off[0]].figure, "", runs, "; ".join(parts))

    @property
    def open_figures(self) -> dict[str, str]:
        """Figures that the last model does not explain, or cannot tell: "figure of run" -> why."""
        found, after = {}, self.last
        for i, one in enumerate(self.observations):
            key = f"{one.figure} of {one.name}"
            off = abs(after.residuals[i])
            if after.scatter[i] > one.sd:
                found[key] = SAID["scattered"].format(one=one, scatter=after.scatter[i])
            elif off > MET:
                found[key] = SAID["still"].format(one=one, shown=after.shown[i], off=off)
        return found
