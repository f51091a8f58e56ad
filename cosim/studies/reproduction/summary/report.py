"""What is said of searched models: where the misfit lives, the ranking, what stays open."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cosim.gap.data import Campaign

from .observations import Observation
from .result import FittedSummary, Ranked, Where
from .trial import Trial

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
        effect = trial.way.effects[-1]
        if effect in rows:
            continue
        fit = trial.fitted()
        rows[effect] = Ranked(
            effect=effect,
            form=trial.way.form,
            held_out_gap=fit.held_out_gap,
            fit_gap=fit.gap,
            delta_bic=plain.bic - trial.bic,
            parameters=dict(fit.values),
            intervals=trial.intervals(),
        )
    return tuple(rows.values())


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
            f"{best.way.effects[-1]}: BIC lower by {one.gained:.1f}, chance {one.p:.3g}, "
            f"lack of fit afterwards {best.lack_of_fit:.2g}"
        )
    return tuple(lines)
