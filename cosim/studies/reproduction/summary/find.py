"""From figures to a named effect: fit plainly, try the catalogue, weigh against chance, judge.

The answer, as plain data, says where the misfit lives, and what stays open.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ....gap.data import Campaign
from ....gap.result import Ranked, Score, Where
from . import draws as search
from .draws import WIDER, Array, Bench, Draws, FittedSummary, Observation, Target, observations
from .models import SAID, extensions, not_felt, plain_candidate

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


PLAIN_DRAWS, FIRST = 24, 8  # evenly spread draws of the plain model, and of each with an effect
MORE = 12  # and about the best, in a round, of one in the running
ROBUST_DRAWS = 16
RANGE_DRAWS = 16  # in a round for the ranges of the numbers of the model that won
# share of the first draws that stay near the plain fit; least squares rather start from anywhere
NEAR_PLAIN = {False: 0.5, True: 0.0}
IN_THE_RUNNING = 2  # models that are searched to the end
CHANCE = 0.05  # an improvement that chance makes more often is none
FITS = 0.05  # lack of fit above which the plain model needs nothing
REPAIRED = 0.01  # lack of fit below which an extended model has not repaired the disagreement
# difference of BIC (Kass & Raftery 1995: strong evidence) within which effects form a class
APART = 6.0
MOST_EFFECTS = 2
BOOTSTRAPS = 999


@dataclass(frozen=True)
class Found:
    """An effect on top of ``before``: all that were tried, the least BIC first, and p of chance."""

    before: Draws
    tried: tuple[Draws, ...]
    p: float

    @property
    def best(self) -> Draws:
        """The tried model of least BIC."""
        return self.tried[0]

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
        close = [t.effect for t in self.tried if t.bic - self.best.bic <= APART]
        return tuple(dict.fromkeys(close))


def find_summary_gap(
    campaign: Campaign,
    *,
    seed: int = 0,
    jobs: int = 2,
    step: Callable[[int], object] = lambda _count: None,
) -> SummaryGap:
    """What is missing in the campaign's model, as far as the figures of its runs tell.

    seed: of draws, scatter and bootstrap: the same seed gives the same answer. step: called with 1
    after every model run. CampaignError where no run has a summary.
    """
    bench = Bench(campaign, observations(campaign), seed, jobs, step)
    plain = _plain(bench)
    found: list[Found] = []
    trial = plain
    while len(found) < MOST_EFFECTS and trial.lack_of_fit < (FITS if not found else REPAIRED):
        one = _add(bench, trial)
        if not found or one.holds:
            found.append(one)
        if not one.holds:
            break
        trial = one.best
    answer = _answer(bench, plain, _with_free_friction(bench, plain) if found else None, found)
    if bench.smooth or answer.extended is None:
        return answer
    share = _share_that_fits(bench, trial)
    line = SAID["fragile"].format(share)
    return replace(answer, fits_share=share, remarks=(*answer.remarks, line))


def _plain(bench: Bench) -> Draws:
    """The model as it is; its first draw has friction as it is known."""
    candidate = plain_candidate(bench.campaign)
    draws = bench.draw(candidate, search.even_shares(candidate, PLAIN_DRAWS, bench.seed))
    starts = draws.good(2) if bench.smooth else ()
    return sum((search.polished(bench, candidate, start) for start in starts), draws)


def _add(bench: Bench, before: Draws) -> Found:
    """Every effect on top of ``before``; those in the running searched to the end."""
    share = 1.0 if before.candidate.effects else NEAR_PLAIN[bench.smooth]
    screened = [
        search.screening(bench, candidate, FIRST, before, share)
        for candidate in extensions(bench.campaign, before.candidate)
    ]
    screened.sort(key=lambda draws: draws.misfit.min())
    running = len(screened) if bench.smooth else IN_THE_RUNNING
    tried = [_refined(bench, draws) for draws in screened[:running]] + screened[running:]
    tried = sorted((_nested(draws, before) for draws in tried), key=lambda trial: trial.bic)
    # more about the good draws of the best: its intervals, and perhaps a better best
    tried[0] = search.near_rounds(bench, tried[0], RANGE_DRAWS)
    tried.sort(key=lambda trial: trial.bic)
    return Found(before, tuple(tried), _p_of_the_best(before, tried, bench.seed))


def _refined(bench: Bench, draws: Draws) -> Draws:
    """The draws and what comes of the best of them: of least squares where the model is smooth."""
    if bench.smooth:
        return draws + search.polished(bench, draws.candidate, draws.good(1)[0])
    return search.near_rounds(bench, draws, MORE)


def _nested(draws: Draws, before: Draws) -> Draws:
    """The draws and more; an effect may also be off, so it is never worse than without."""
    return draws + before.with_effect_off(draws.candidate)


def _ranked(tried: Sequence[Draws], plain: Draws) -> tuple[Ranked, ...]:
    """The best form of every effect, the least BIC first, of trials in that order."""
    best: dict[str, Draws] = {}
    for trial in tried:
        best.setdefault(trial.effect, trial)
    weights = {effect: math.exp(0.5 * (tried[0].bic - one.bic)) for effect, one in best.items()}
    return tuple(
        Ranked(
            effect,
            trial.candidate.form,
            evidence=0.5 * (plain.bic - trial.bic),
            probability=weights[effect] / sum(weights.values()),
            gap=Score(trial.gap, trial.held_out_gap),
            parameters=trial.best_values,
            intervals=trial.intervals(),
        )
        for effect, trial in best.items()
    )


def _p_of_the_best(plain: Draws, others: Sequence[Draws], seed: int) -> float:
    """Probability, under the plain model, of an improvement like that of the best of ``others``.

    A parametric bootstrap: figures are drawn from the plain model (its own scatter and the
    observations' standard deviations), and everything that was drawn is fitted to them again, so
    that choosing the best of many is part of what chance may do.
    """
    rng, target = np.random.default_rng(seed), plain.target
    rows = plain.shown[plain.best]
    tables = _table([plain]), _table(others)

    def gained(sizes: Array) -> float:
        best = [
            float((Target(sizes, target.sds).misfit(means, variances) + prices).min())
            for means, variances, prices in tables
        ]
        return best[0] - best[1]

    found, count = gained(target.sizes), len(target.sizes)
    drawn = (
        rows[rng.integers(len(rows))] + target.sds * rng.standard_normal(count)
        for _ in range(BOOTSTRAPS)
    )
    return (1 + sum(gained(sizes) >= found for sizes in drawn)) / (1 + BOOTSTRAPS)


def _table(trials: Sequence[Draws]) -> tuple[Array, Array, Array]:
    """Of all draws of all trials: means (d, n), variances of a realisation (d, n), prices (d,)."""
    means = np.concatenate([trial.mean for trial in trials])
    variances = np.concatenate([WIDER * trial.scatter**2 for trial in trials])
    return means, variances, np.concatenate([t.surprise + t.price for t in trials])


def _share_that_fits(bench: Bench, trial: Draws) -> float:
    """Of draws of friction as it is known, with the effect as found: the share that fits as well.

    As well: within twice the best gap. A small share says that the fit hangs on exact numbers.
    """
    own = sum(span.of_friction for span in trial.candidate.spans)
    table = search.even_shares(trial.candidate, ROBUST_DRAWS, bench.seed + 3)
    table[:, own:] = trial.good(1)[0, own:]
    gaps = bench.target.gap(bench.draw(trial.candidate, table).mean)
    return float(np.mean(gaps <= 2.0 * trial.gap))


def _with_free_friction(bench: Bench, plain: Draws) -> Draws | None:
    """The plain model with friction set free: would other coefficients do instead of an effect?"""
    candidate = plain.candidate.free
    if candidate == plain.candidate:
        return None
    draws = bench.draw(candidate, search.even_shares(candidate, PLAIN_DRAWS // 2, bench.seed))
    return _refined(bench, draws)


def _answer(bench: Bench, plain: Draws, free: Draws | None, found: Sequence[Found]) -> SummaryGap:
    held = [one for one in found if one.holds]
    verdict, effects, classes = _judge(plain, held)
    told = (found[0].p, BOOTSTRAPS, found[0].gained) if found else (1.0, 0, 0.0)
    remarks = [SAID["model"]] if bench.campaign.scheme == "study" else []
    remarks += [SAID["added"].format(one=one) for one in found]
    values, intervals = plain.best_values, plain.intervals()
    return SummaryGap(
        campaign=bench.campaign,
        observations=bench.seen,
        verdict=verdict,
        effects=effects,
        found=held[-1].best.candidate.effects if held else (),
        classes=classes,
        ranking=_ranked(found[0].tried, plain) if found else (),
        printed=plain.fitted(0),
        plain=plain.fitted(),
        extended=held[-1].best.fitted() if held else None,
        chance=dict(zip(("p", "draws", "delta_bic"), told, strict=True)),
        determined={key: (values[key], *interval) for key, interval in intervals.items()},
        free_friction=free.fitted() if free is not None else None,
        remarks=tuple(remarks),
    )


def _judge(
    plain: Draws, held: Sequence[Found]
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
