"""The answer to a campaign of figures, as plain data: where the misfit lives, the ranking."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from cosim.gap.data import Campaign
from cosim.gap.result import Ranked, Score
from cosim.studies.reproduction.summary.search import FittedSummary, Trial

from .draws import Observation


@dataclass(frozen=True)
class Where:
    """Where the misfit lives; regime is empty: figures do not tell it."""

    channel: str
    regime: str
    runs: tuple[str, ...]
    text: str


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


# distance in standard deviations from which a figure is not met
MET = 2.0


def where(seen: Sequence[Observation], plain: FittedSummary) -> Where:
    """The figures in which the plain model misses, the worst first."""
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
    """The best form of every effect, the least BIC first."""
    rows: dict[str, Ranked] = {}
    for trial in sorted(tried, key=lambda one: one.bic):
        effect = trial.candidate.effects[-1]
        if effect in rows:
            continue
        fit = trial.fitted()
        rows[effect] = Ranked(
            effect=effect,
            form=trial.candidate.form,
            evidence=0.5 * (plain.bic - trial.bic),
            probability=0.0,
            gap=Score(fit.gap, fit.held_out_gap),
            parameters=dict(fit.values),
            intervals=trial.intervals(),
        )
    least = min((trial.bic for trial in tried), default=0.0)
    weights = {
        effect: math.exp(row.evidence - 0.5 * (plain.bic - least)) for effect, row in rows.items()
    }
    total = sum(weights.values())
    return tuple(replace(row, probability=weights[row.effect] / total) for row in rows.values())


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


def remarks(campaign: Campaign, found: Sequence) -> tuple[str, ...]:
    """What the reader should know, a line each."""
    lines = []
    if campaign.scheme == "study":
        lines.append(
            "model: the source study's scheme as printed; 25 cycles, of which the last 60 % count"
        )
    for one in found:
        best = one.best
        lines.append(
            f"{best.candidate.effects[-1]}: BIC lower by {one.gained:.1f}, chance {one.p:.3g}, "
            f"lack of fit afterwards {best.lack_of_fit:.2g}"
        )
    return tuple(lines)
