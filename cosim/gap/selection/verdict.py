"""From trials of the catalogue to a verdict: named, class, none, unknown."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from stickslip.effects.candidate import Candidate

from cosim.gap.estimation.fitted import Fitted
from cosim.gap.estimation.trial import Trial

from .confounders import better_confounder
from .criteria import (
    DRAGS_ASIDE,
    EXPLAINED_BY_ONE,
    EXPLAINED_BY_TWO,
    FITS,
    PART_OF_OTHERS,
    PLAIN_FITS,
    WORTH_A_POLISH,
    as_good,
    excess_chi_square,
    explained,
    in_reach,
    indistinguishable,
    is_little,
    is_plain,
    repaired,
    stands,
    telling,
)
from .pairs import across_alone, best_pair, needed_alone
from .search import Search
from .tried import ACROSS, Tried

#: What takes away this part of the excess chi-square leaves nothing for a second effect, only
#: its own law's small misfit.
ALL = 0.99
#: Where no second effect helps, one that does the most alone is named all the same, if no other
#: comes near: it takes away this part, and none more than that part of what it does.
DOES_MOST, RIVAL = 0.9, 0.5
#: A plain model that fits leaves what a contact has beside any model. That is no wave: one that
#: takes away this part of an excess chi-square of so much, and no other effect near it, is one.
WAVE, SEEN = 0.8, 0.1
#: So many effects are tried once more when the best one leaves more than noise.
POLISHED = 2


@dataclass(frozen=True)
class Finding:
    """What the search came to.

    Attributes
    ----------
    verdict : named, class, none or unknown
    effects : ids in the order found; for a class its members
    chosen : the model that repairs it, None for none and unknown
    ranking : every effect on top of the plain model, best first
    nearest : the best that there is, whatever the verdict
    confounder : what would repair it and is not in the catalogue, in words, or ""
    """

    verdict: str
    effects: tuple[str, ...]
    chosen: Trial | None
    ranking: Sequence[Tried]
    nearest: Trial
    confounder: str = ""


def judge(search: Search, plain: Trial, coarse: Fitted, candidates: Sequence[Candidate]):
    """Look for one effect, then for two: `Finding`."""
    ranking = search.on(plain.model, coarse, candidates)
    done, early = _parted(ranking)
    if plain.rms_residual <= PLAIN_FITS:
        if done and _is_wave(plain, done):
            return _named(done[0], ranking)
        return Finding("none", (), None, ranking, plain)
    best = done[0].trial
    if best.rms_residual > PLAIN_FITS and explained(plain, best) >= WORTH_A_POLISH:
        done = _merged(search.polished(in_reach(telling(done))[:POLISHED], candidates), done)
    other = better_confounder(search, plain, coarse, done[0])
    if other and repaired(plain, other.trial, EXPLAINED_BY_ONE):
        nearest, words = done[0].trial, other.candidate.effect
        return Finding("unknown", (), None, [*done, *early], nearest, words)
    single = _of_one(plain, [*done, *early])
    if single and (single.nearest.rms_residual <= FITS or explained(plain, single.nearest) >= ALL):
        chosen = next(t for t in done if t.trial is single.chosen)
        return _with_friction_across(search, single, chosen, candidates)
    if is_little(plain, coarse):  # and nothing explains it
        return Finding("none", (), None, [*done, *early], plain)
    return _of_two(search, plain, coarse, [*done, *early], candidates, single)


def _parted(ranking: Sequence[Tried]) -> tuple[list[Tried], list[Tried]]:
    """Those with a trial, best first, and those that were ruled out by their coarse fits."""
    done = [t for t in ranking if t.judged is not None]
    early = [t for t in ranking if t.judged is None]
    return sorted(done, key=lambda t: t.trial.rms_residual), early


def _named(best: Tried, ranking: Sequence[Tried]) -> Finding:
    """One effect alone."""
    return Finding("named", (best.candidate.effect,), best.trial, ranking, best.trial)


def _of_one(plain: Trial, ranking: Sequence[Tried]) -> Finding | None:
    """One effect, or several that do as well as one another, if they repair the model."""
    done, _ = _parted(ranking)
    # one that is plain numbers by another name may do as well as an effect
    done = [
        t for t in done if t.trial.rms_residual**2 <= as_good(done[0].trial) and stands(t.trial)
    ]
    if not done or not repaired(plain, done[0].trial, EXPLAINED_BY_ONE):
        return None
    best, members = done[0].trial, indistinguishable(done)
    return Finding("named" if len(members) == 1 else "class", members, best, ranking, best)


def _with_friction_across(
    search: Search, single: Finding, best: Tried, candidates: Sequence[Candidate]
) -> Finding:
    """Where the best one brings friction across along: that alone if it is as good, or both.

    A turning surface drags a block aside by that friction: it is part of the effect.
    """
    effect = best.candidate.effect
    across = [c for c in candidates if c.effect == PART_OF_OTHERS and not c.free_parameters]
    if effect == PART_OF_OTHERS or ACROSS not in best.candidate.settings or not across:
        return single
    simpler = across_alone(search, best, best.candidate)
    if simpler:
        simpler = replace(simpler, candidate=across[0])
        rest = [t for t in single.ranking if t.candidate.effect != PART_OF_OTHERS]
        return _named(simpler, [simpler, *rest])
    if effect == DRAGS_ASIDE or len(single.effects) > 1:
        return single
    without = search.less(best, across[0], keep=())
    if without.trial.rms_residual**2 <= as_good(best.trial):
        return single
    return replace(single, effects=(effect, PART_OF_OTHERS))


def _of_two(
    search: Search,
    plain: Trial,
    coarse: Fitted,
    ranking: Sequence[Tried],
    candidates: Sequence[Candidate],
    single: Finding | None,
) -> Finding:
    """Two effects; or one that does the most, or that turns out to do without its second.

    single : what is to be said if there is no second one, as far as it is known
    """
    done, early = _parted(ranking)
    pair = best_pair(search, plain, coarse, done, candidates)
    if pair and repaired(plain, pair[1].trial, EXPLAINED_BY_TWO):
        alone = needed_alone(search, plain, pair)
        if alone is None:
            effects = (pair[0].candidate.effect, pair[1].candidate.effect)
            return Finding("named", effects, pair[1].trial, ranking, pair[1].trial)
        done, ranking = _with(alone, done, early)
        single = _of_one(plain, ranking)
    elif pair and is_plain(pair[1].trial):  # what one effect leaves is real, and no other's
        return Finding("unknown", (), None, ranking, pair[1].trial)
    if single:
        return single
    best = done[0]
    if _dominates(plain, done):
        return _named(best, ranking)
    nearest = min([best.trial, *([pair[1].trial] if pair else [])], key=lambda t: t.rms_residual)
    return Finding("unknown", (), None, ranking, nearest)


def _with(alone: Tried, done: Sequence[Tried], early: Sequence[Tried]):
    """Those done, and all, with one effect as it was fitted last."""
    done = _merged([alone], [t for t in done if t.candidate.effect != alone.candidate.effect])
    rest = [t for t in early if t.candidate.effect != alone.candidate.effect]
    return done, [*done, *rest]


def _merged(better: Sequence[Tried], done: Sequence[Tried]) -> list[Tried]:
    """The polished ones in place of what they were, best first."""
    effects = {t.candidate.effect for t in better}
    rest = [t for t in done if t.candidate.effect not in effects]
    return sorted([*better, *rest], key=lambda t: t.trial.rms_residual)


def _is_wave(plain: Trial, done: Sequence[Tried]) -> bool:
    """Whether there is something to see, and the best effect, a periodic one, alone does it."""
    periodic = bool(done[0].candidate.periodic)
    return periodic and excess_chi_square(plain) >= SEEN and _dominates(plain, done, WAVE)


def _dominates(plain: Trial, done: Sequence[Tried], most: float = DOES_MOST) -> bool:
    """Whether one effect takes away so much, and no other comes near."""
    parts = [explained(plain, t.trial) for t in done]
    does_most = parts[0] >= most and stands(done[0].trial)
    return does_most and all(part <= RIVAL * parts[0] for part in parts[1:])
