"""The ladder as it is shown: every model's gaps, what it gains, and how much of the misfit."""

from __future__ import annotations

from collections.abc import Sequence

from cosim.gap.estimation.trial import Trial
from cosim.gap.result import Step
from cosim.gap.selection.probability import probabilities
from cosim.gap.selection.verdict import Finding, Rung, share


def steps(finding: Finding, trials: Sequence[Trial], offered: int) -> tuple[Step, ...]:
    """trials : of every rung; offered : number of effects."""
    plain, last = finding.ladder[0].settled, finding.ladder[-1].settled
    return tuple(
        Step(
            rung.effects,
            float(rung.gain),
            trial.fit_rms,
            trial.held_out_rms,
            float(share(rung.settled, plain, last)) if rung.effects else 0.0,
            _members(rung, offered),
        )
        for rung, trial in zip(finding.ladder, trials, strict=True)
    )


def _members(rung: Rung, offered: int) -> dict[str, float]:
    """What does as well as the last effect; those below it were not tried once more."""
    return probabilities(rung.members, offered - len(rung.effects) + 1) if rung.members else {}
