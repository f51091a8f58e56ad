"""What is said where no effect was looked for: the plain model, fitted, and what it leaves."""

from __future__ import annotations

from collections.abc import Sequence

from cosim.gap.data import Campaign
from cosim.gap.diagnostics import analyse_residuals, find_where
from cosim.gap.doubts.doubt import Doubt, not_looked
from cosim.gap.estimation.intervals import determined
from cosim.gap.evidence.settled import Settled
from cosim.gap.result import Gap

from .models import Bench, long_fit, shown


def unsearched(campaign: Campaign, bench: Bench, settled: Settled, doubts: Sequence[Doubt]) -> Gap:
    """An answer without a ladder and a ranking, to be doubted.

    campaign : as measured; settled : the plain model; doubts : of which one no effect explains
    """
    trial = long_fit(bench, settled, settled.spreads)
    plain = shown(campaign, bench, trial)
    analysis = analyse_residuals([run.track for run in plain.runs])
    return Gap(
        campaign=campaign,
        verdict="none",
        effects=(),
        classes=(),
        where=find_where(analysis),
        ranking=(),
        gap_before=plain.gap,
        gap_after=plain.gap,
        plain=plain,
        extended=None,
        determined=determined(trial),
        analysis=analysis,
        remarks=(not_looked(doubts),),
        searched=False,
    )
