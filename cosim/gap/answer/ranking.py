"""Every effect that was tried on top of the plain model, with gaps, numbers and odds."""

from __future__ import annotations

from collections.abc import Sequence

from cosim.gap.estimation.fitted import shared_of
from cosim.gap.estimation.intervals import intervals, undetermined
from cosim.gap.estimation.trial import Trial
from cosim.gap.evidence.products import Spreads
from cosim.gap.result import Ranked
from cosim.gap.selection.probability import probabilities
from cosim.gap.selection.tried import Tried, best_of_effects
from cosim.gap.selection.verdict import Finding
from cosim.processes import Map

from .models import Bench, added, glance

#: Key -> value and 95 % interval.
Numbers = dict[str, tuple[float, float, float]]
#: Fit and held out; None where nothing was looked at.
Gaps = tuple[float | None, float | None]


def ranked(
    bench: Bench,
    finding: Finding,
    trials: Sequence[Trial],
    spreads: Spreads,
    offered: Sequence[str],
    mapped: Map,
) -> tuple[Ranked, ...]:
    """In their order; what the screening ruled out has neither gaps nor numbers.

    Of an effect's laws the best alone is looked at in long segments, and has gaps: at most the
    plain model's, which is the same with nothing of the law. trials : of the ladder; the law of
    its first step has the numbers that are shown. offered : effects, of which waves without a
    period that stands out of noise were not even screened
    """
    tried, plain = finding.ranking, (trials[0].fit_rms, trials[0].held_out_rms)
    first = trials[1] if len(trials) > 1 else None
    held = finding.ladder[1].members[0] if first else None
    best = [t for t in best_of_effects(tried) if t.settled is not None and t is not held]
    looked = mapped(glance, [(bench, each.model, spreads) for each in best])
    gaps = {id(each): min(pair, plain) for each, pair in zip(best, looked, strict=True)}
    odds = probabilities(tried, len(offered))
    rows = []
    for each in tried:
        probability = odds[each.candidate.effect]
        if each is held and first is not None:
            pair = first.fit_rms, first.held_out_rms
            rows.append(_row(each, pair, _as_shown(each, first), probability))
        else:
            seen = gaps.get(id(each), (None, None))
            rows.append(_row(each, seen, _as_settled(each), probability))
    silent = [effect for effect in offered if effect not in odds]
    return (*rows, *(Ranked(effect, "", None, None, None, {}, {}) for effect in silent))


def _keys(tried: Tried) -> list[str]:
    return [free.key for free in shared_of(tried.candidate.free_parameters)]


def _as_settled(tried: Tried) -> Numbers:
    return {} if tried.settled is None else added(tried.settled, _keys(tried))


def _as_shown(tried: Tried, trial: Trial) -> Numbers:
    wide = intervals(trial)
    return {key: (trial.fitted.values[key], *wide[key]) for key in _keys(tried)}


def _row(tried: Tried, gaps: Gaps, numbers: Numbers, probability: float) -> Ranked:
    fit, held_out = gaps
    pairs = {key: (float(low), float(high)) for key, (_, low, high) in numbers.items()}
    return Ranked(
        effect=tried.candidate.effect,
        form=tried.candidate.form,
        held_out_gap=held_out,
        fit_gap=fit,
        delta_bic=float(tried.gain),
        parameters={key: float(value) for key, (value, _, _) in numbers.items()},
        intervals=pairs,
        probability=probability,
        undetermined=undetermined(shared_of(tried.candidate.free_parameters), pairs),
    )
