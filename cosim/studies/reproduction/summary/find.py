"""From figures to a named effect: fit plainly, try the catalogue, weigh against chance, judge."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cosim.gap.data import Campaign

from .candidates import Candidate, extensions, free_candidate, not_felt, plain_candidate
from .draws import (
    Bench,
    Draw,
    Observation,
    Target,
    draw,
    gap,
    misfit,
    observations,
    scatter_of_kin,
    without_effect,
)
from .result import SummaryGap, open_figures, ranked, remarks, where
from .search import (
    FIRST,
    SEEDS,
    even_shares,
    near,
    ordered,
    polished,
    refined,
    screening,
    widen,
    with_all_seeds,
)
from .trial import BOOTSTRAPS, WITHIN, Trial, fitted, p_of_the_best

PLAIN_DRAWS, PLAIN_CLOSELY = 32, 6
ROBUST_DRAWS = 32
RANGE_DRAWS = 32  # for the ranges of the numbers of the model that won
# share of the first draws that stay near the plain fit; least squares rather start from anywhere
NEAR_PLAIN = {False: 0.5, True: 0.0}
IN_THE_RUNNING = 2  # models that are searched to the end
CHANCE = 0.05  # an improvement that chance makes more often is none
FITS = 0.05  # lack of fit above which the plain model needs nothing
REPAIRED = 0.01  # lack of fit below which an extended model has not repaired the disagreement
# difference of BIC (Kass & Raftery 1995: strong evidence) within which effects form a class
APART = 6.0
MOST_EFFECTS = 2


@dataclass(frozen=True)
class Found:
    """Effects found so far: the trial before, all that were tried on top of it, p of chance."""

    before: Trial
    tried: tuple[Trial, ...]
    p: float

    @property
    def best(self) -> Trial:
        """The tried model of least BIC."""
        return min(self.tried, key=lambda trial: trial.bic)

    @property
    def gained(self) -> float:
        """BIC that it takes away."""
        return self.before.bic - self.best.bic

    @property
    def holds(self) -> bool:
        """Is it more than chance, and worth its numbers?"""
        return self.p <= CHANCE and self.gained > APART

    @property
    def rivals(self) -> tuple[str, ...]:
        """Effects that do as well as the best, itself included, best first."""
        order = sorted(self.tried, key=lambda trial: trial.bic)
        close = [t.candidate.effects[-1] for t in order if t.bic - self.best.bic <= APART]
        return tuple(dict.fromkeys(close))


def find_summary_gap(
    campaign: Campaign,
    *,
    seed: int = 0,
    jobs: int = 2,
    step: Callable[[int], None] | None = None,
) -> SummaryGap:
    """What is missing in the campaign's model, as far as the figures of its runs tell.

    seed: of draws, scatter and bootstrap: the same seed gives the same answer. step: called with 1
    after every model run. CampaignError where no run has a summary.
    """
    seen = observations(campaign)
    bench = Bench(campaign, seen, seed, jobs, step)
    target = Target.of(seen)
    candidate = plain_candidate(campaign)
    known, *draws = screening(bench, candidate, PLAIN_DRAWS)
    known = bench.run([known], SEEDS - 1)[0]
    none = np.zeros(len(seen))
    if bench.smooth:
        best = ordered(draws, target, none)[:2]
        draws += [polished(bench, candidate, one, target) for one in best]
    draws = with_all_seeds(bench, draws, target, none, PLAIN_CLOSELY)
    plain = Trial.of(candidate, [known, *draws], target, scatter_of_kin(draws))
    found: list[Found] = []
    trial = plain
    while len(found) < MOST_EFFECTS and trial.lack_of_fit < (FITS if not found else REPAIRED):
        one = _add(bench, trial, target)
        if not found or one.holds:
            found.append(one)
        if not one.holds:
            break
        trial = one.best
    free = _with_free_friction(bench, plain, target) if found else None
    answer = _answer(campaign, seen, plain, free, known, found)
    if bench.smooth or answer.extended is None:
        return answer
    share = _share_that_fits(bench, trial, target)
    line = (
        f"with the effect as found, {share:.0%} of draws of friction as it is known come within "
        "twice the gap: the scheme is chaotic, and the fit hangs on the exact coefficients"
    )
    return replace(answer, fits_share=share, remarks=(*answer.remarks, line))


def _add(bench: Bench, before: Trial, target: Target) -> Found:
    """Every effect on top of ``before``; those in the running searched to the end."""
    none = np.zeros(len(target.sizes))  # one seed does not tell a scatter
    share = 1.0 if before.candidate.effects else NEAR_PLAIN[bench.smooth]
    screened = [
        (candidate, ordered(screening(bench, candidate, FIRST, before.best, share), target, none))
        for candidate in extensions(bench.campaign, before.candidate)
    ]
    screened.sort(key=lambda one_screened: misfit(one_screened[1][0], target, none))
    tried = []
    for place, (candidate, draws) in enumerate(screened):
        draws = refined(bench, candidate, draws, target, none, place < IN_THE_RUNNING)
        tried.append(_nested(candidate, draws, before, target))
    tried.sort(key=lambda trial: trial.bic)
    tried[0] = _with_ranges(bench, tried[0], before, target)
    return Found(before, tuple(tried), p_of_the_best(before, tried, bench.seed))


def _nested(candidate: Candidate, draws: Sequence[Draw], before: Trial, target: Target) -> Trial:
    """The trial of ``candidate``; an effect may also be off, so it is never worse than without."""
    off = [without_effect(candidate, one) for one in before.close]
    return Trial.of(candidate, [*draws, *off], target, scatter_of_kin(draws))


def _with_ranges(bench: Bench, trial: Trial, before: Trial, target: Target) -> Trial:
    """The trial with more draws about its good ones: its intervals, and perhaps a better best."""
    own = [one for one in trial.draws if len(one.shares) == len(trial.candidate.spans)]
    draws = widen(bench, trial.candidate, own, target, WITHIN, RANGE_DRAWS)
    draws = with_all_seeds(bench, draws, target, trial.kin, SEEDS)
    return _nested(trial.candidate, draws, before, target)


def _share_that_fits(bench: Bench, trial: Trial, target: Target) -> float:
    """Of draws of friction as it is known, with the effect as found: the share that fits as well.

    As well: within twice the best gap. A small share says that the fit hangs on exact numbers.
    """
    own = len(trial.friction_spans)
    table = even_shares(trial.candidate, ROBUST_DRAWS, bench.seed + 3)
    table[:, own:] = trial.best.shares[own:]
    draws = bench.run([draw(trial.candidate, shares, len(bench.seen)) for shares in table])
    limit = 2.0 * gap(trial.best.mean, target)
    return float(np.mean([gap(one.mean, target) <= limit for one in draws]))


def _with_free_friction(bench: Bench, plain: Trial, target: Target) -> Trial | None:
    """The plain model with friction set free: would other coefficients do instead of an effect?"""
    candidate = free_candidate(plain.candidate)
    if candidate == plain.candidate:
        return None
    none = np.zeros(len(target.sizes))
    draws = screening(bench, candidate, PLAIN_DRAWS)
    draws += near(bench, candidate, ordered(draws, target, none)[:3], PLAIN_DRAWS // 2)
    draws = refined(bench, candidate, draws, target, none, running=False)
    return Trial.of(candidate, draws, target, scatter_of_kin(draws))


def _answer(
    campaign: Campaign,
    seen: tuple[Observation, ...],
    plain: Trial,
    free: Trial | None,
    known: Draw,
    found: Sequence[Found],
) -> SummaryGap:
    held = [one for one in found if one.holds]
    last = held[-1].best if held else None
    before = fitted(plain.best, plain)
    after = last.fitted() if last else before
    verdict, effects, classes = _judge(plain, held)
    first = found[0] if found else None
    return SummaryGap(
        campaign=campaign,
        observations=seen,
        verdict=verdict,
        effects=effects,
        found=last.candidate.effects if last else (),
        classes=classes,
        where=where(seen, before),
        ranking=ranked(first.tried, plain) if first else (),
        gap_before=(before.gap, before.held_out_gap),
        gap_after=(after.gap, after.held_out_gap),
        printed=fitted(known, plain),
        plain=before,
        extended=after if last else None,
        chance={
            "p": first.p if first else 1.0,
            "draws": BOOTSTRAPS if first else 0,
            "delta_bic": first.gained if first else 0.0,
        },
        determined={
            key: (plain.best.values[key], *interval) for key, interval in plain.intervals().items()
        },
        free_friction=free.fitted() if free else None,
        not_felt=not_felt(campaign),
        open_figures=open_figures(seen, after),
        remarks=remarks(campaign, found),
    )


def _judge(
    plain: Trial, held: Sequence[Found]
) -> tuple[str, tuple[str, ...], tuple[tuple[str, ...], ...]]:
    """Verdict, effects, classes."""
    if plain.lack_of_fit >= FITS:
        return "none", (), ()
    if not held:
        return "unknown", (), ()
    classes = tuple(one.rivals for one in held if len(one.rivals) > 1)
    effects = held[-1].best.candidate.effects
    if held[-1].best.lack_of_fit < REPAIRED:
        return "unknown", effects, classes
    if classes:
        return "class", tuple(dict.fromkeys(e for one in held for e in one.rivals)), classes
    return "named", effects, ()
