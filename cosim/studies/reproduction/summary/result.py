"""The answer to a campaign of figures, as plain data: where the misfit lives, the ranking."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from cosim.gap.data import Campaign
from cosim.gap.result import Ranked, Score, Where

from .draws import Observation
from .trial import FittedSummary, Trial


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
    remarks: tuple[str, ...] = ()
    fits_share: float | None = None


# distance in standard deviations from which a figure is not met
MET = 2.0


def where(seen: Sequence[Observation], plain: FittedSummary) -> Where:
    """The figures in which the plain model misses, the worst first; they tell no regime."""
    order = np.argsort(-np.abs(plain.residuals))
    off = [i for i in order if abs(plain.residuals[i]) > MET]
    if not off:
        return Where("", "", (), "every figure is met within two standard deviations")
    parts = [
        f"{seen[i].figure} of {seen[i].name} {plain.shown[i]:.3g} instead of {seen[i].size:.3g} "
        f"± {seen[i].sd:.2g} ({plain.residuals[i]:+.1f} standard deviations)"
        for i in off
    ]
    runs = tuple(dict.fromkeys(seen[i].name for i in off))
    return Where(seen[off[0]].figure, "", runs, "; ".join(parts))


def ranked(tried: Sequence[Trial], plain: Trial) -> tuple[Ranked, ...]:
    """The best form of every effect, the least BIC first, of trials in that order."""
    best: dict[str, Trial] = {}
    for trial in tried:
        best.setdefault(trial.candidate.effects[-1], trial)
    weights = [math.exp(0.5 * (tried[0].bic - trial.bic)) for trial in best.values()]
    rows = []
    for (effect, trial), weight in zip(best.items(), weights, strict=True):
        fit = trial.fitted()
        rows.append(
            Ranked(
                effect=effect,
                form=trial.candidate.form,
                evidence=0.5 * (plain.bic - trial.bic),
                probability=weight / sum(weights),
                gap=Score(fit.gap, fit.held_out_gap),
                parameters=dict(fit.values),
                intervals=trial.intervals(),
            )
        )
    return tuple(rows)


def open_figures(seen: Sequence[Observation], after: FittedSummary) -> dict[str, str]:
    """Figures that the last model does not explain, or cannot tell: "figure of run" -> why."""
    found = {}
    for i, one in enumerate(seen):
        key = f"{one.figure} of {one.name}"
        if after.scatter[i] > one.sd:
            found[key] = (
                f"the model's own scatter from seed to seed, {after.scatter[i]:.2g}, exceeds the "
                f"observation's {one.sd:.2g}"
            )
        elif abs(after.residuals[i]) > MET:
            found[key] = (
                f"{after.shown[i]:.3g} instead of {one.size:.3g} ± {one.sd:.2g}: still "
                f"{abs(after.residuals[i]):.1f} standard deviations off"
            )
    return found
