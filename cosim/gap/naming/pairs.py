"""Two effects at once: which two repair the model together, and whether either does alone."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from cosim.gap.candidates.candidate import Candidate
from cosim.gap.shooting.fitted import Fitted
from cosim.gap.shooting.trial import Trial

from .measures import (
    PART_OF_OTHERS,
    PLAIN_FITS,
    as_good,
    excess,
    explained,
    gone,
    telling,
)
from .search import ACROSS, Search, Tried, penalised

#: So many single effects are tried with a second one, the best and those that take away this part
#: alone, in short windows or in long ones.
FIRSTS, WORTH_A_SECOND = 3, 0.2
#: So many pairs are fitted in long windows.
PAIRS = 3
#: A pair that has taken away this part is fitted more closely, if it does not fit.
NEARLY = 0.8
#: A pair that takes away this part in short windows and does not fit has its periods looked for
#: anew, in so many turns at most, each of which must leave less than this part of the squares.
MOST, TURNS, LEADS_ON = 0.6, 2, 0.98
#: No other first effect is tried when a pair leaves less than this part in short windows, and
#: hardly more than noise: else its first may be another's double.
REST, HARDLY = 0.05, 1.1
#: Beside one that has taken away so much alone, another effect must take away this part of what it
#: leaves, in squares: the first one's law may be a little wrong, and another law mend some of that.
DOMINANT, NEEDED = 0.85, 0.7

#: The first effect alone, and the second on top of it.
Pair = tuple[Tried, Tried]


def best_pair(
    search: Search, plain: Trial, sketched: Fitted, done: Sequence[Tried],
    candidates: Sequence[Candidate],
) -> Pair | None:
    """The two effects that together leave least, if each is needed beside the other.

    sketched : the plain model in short windows
    """
    alone = {t.candidate.effect: t.trial for t in done}
    best, *others = _sketched(search, plain, sketched, done, candidates) or [None]
    if best is None:
        return None
    best = _alternated(search, sketched, best, candidates)
    pairs = sorted(search.together([best, *others]), key=_gap)
    if _is_worth_more(plain, pairs[0]):
        better = _polished(search, pairs[0], candidates)
        doubles = _doubles(search, better, alone, plain, candidates)
        pairs = sorted([better, *doubles, *pairs[1:]], key=_gap)
    for first, second in pairs:
        others = [first.trial, alone.get(second.candidate.effect, first.trial)]
        if all(_is_needed(plain, one, second.trial) for one in others):
            return _simplest(search, (first, second), candidates)
    return None


def _alternated(
    search: Search, plain: Fitted, pair: Pair, candidates: Sequence[Candidate]
) -> Pair:
    """Each periodic effect's period anew beside the other: it was found while that was missing.

    Backfitting (Breiman & Friedman 1985), in short windows; only of a pair that does most and does
    not fit.
    """
    for _ in range(TURNS):
        now = pair[1].sketched
        if now.gap() <= PLAIN_FITS or gone(plain.gap(), now.gap()) < MOST:
            break
        for place in (0, 1):
            pair = _anew(search, pair, place, candidates)
        if pair[1].sketched.cost > LEADS_ON * now.cost:
            break
    return pair


def _anew(search: Search, pair: Pair, place: int, candidates: Sequence[Candidate]) -> Pair:
    """A pair with one of its effects looked for anew, if it is periodic and that is better."""
    first, second = pair
    law = pair[place].candidate
    found = search.anew(second, law, candidates) if law.periodic else None
    if found is None or penalised(found.sketched) >= penalised(second.sketched):
        return pair
    return _with_law(pair, place, found)


def _with_law(pair: Pair, place: int, found: Tried) -> Pair:
    """A pair with another law of its first or second effect."""
    first, second = pair
    if place == 1:
        return first, found
    return replace(first, candidate=found.candidate), replace(found, candidate=second.candidate)


def _is_worth_more(plain: Trial, pair: Pair) -> bool:
    """Whether other laws of its effects may be what a pair lacks."""
    both = pair[1]
    if both.trial.gap <= PLAIN_FITS:
        return False
    return both.sketched.gap() <= PLAIN_FITS or explained(plain, both.trial) >= NEARLY


def _polished(search: Search, pair: Pair, candidates: Sequence[Candidate]) -> Pair:
    """The pair by the best of either effect's laws."""
    laws = [t.candidate for t in reversed(pair)]
    found, *_ = search.polished([replace(pair[1], candidate=law) for law in laws], candidates)
    return _with_law(pair, 0 if found.candidate.effect == laws[1].effect else 1, found)


def _doubles(
    search: Search, pair: Pair, alone: Mapping[str, Trial], plain: Trial,
    candidates: Sequence[Candidate],
) -> list[Pair]:
    """Others in place of an effect that moves the block off its line, if a pair does not fit."""
    aside = [t.candidate.lateral for t in pair]
    if _gap(pair) <= PLAIN_FITS or not any(aside):
        return []
    names = {t.candidate.effect for t in pair}
    others = [c for c in candidates if c.lateral and c.effect not in names]
    dropped, kept = (pair[1], pair[0]) if aside[1] else pair
    found = search.instead(pair[1], dropped.candidate, others, tuple(kept.candidate.settings))
    kept = replace(kept, trial=alone.get(kept.candidate.effect, plain))
    return [(kept, other) for other in found]


def _is_needed(plain: Trial, alone: Trial, both: Trial) -> bool:
    """Whether two effects do so much better than one of them that the other has a part in it."""
    little = (1.0 - NEEDED) * excess(alone)
    return explained(plain, alone) < DOMINANT or excess(both) <= little


def _gap(pair: Pair) -> float:
    return pair[1].trial.gap


def _sketched(
    search: Search, plain: Trial, sketched: Fitted, done: Sequence[Tried],
    candidates: Sequence[Candidate],
) -> list[Pair]:
    """The best pairs in short windows, each pair of effects once, best first."""
    pairs = _concealed(search, plain, sketched, done, candidates)
    little = min(1.0 + REST * (sketched.gap() ** 2 - 1.0), HARDLY**2)
    for first in _firsts(plain, sketched, done):
        if any(second.sketched.gap() ** 2 <= little for _, second in pairs):
            break
        others = [c for c in candidates if c.effect != first.candidate.effect]
        pairs += [(first, second)
                  for second in search.beside(first.model, first.sketched, others)]
    best: dict[frozenset[str], Pair] = {}
    for pair in sorted(pairs, key=lambda pair: penalised(pair[1].sketched)):
        best.setdefault(frozenset(t.candidate.effect for t in pair), pair)
    return list(best.values())[:PAIRS]


def _concealed(
    search: Search, plain: Trial, sketched: Fitted, done: Sequence[Tried],
    candidates: Sequence[Candidate],
) -> list[Pair]:
    """The pair of which neither does much alone, if there is one."""
    two = search.concealed(plain.model, sketched, candidates)
    if two is None:
        return []
    first, second = two
    alone = {t.candidate.effect: t.trial for t in done}
    return [(Tried(first, second.model, sketched, alone.get(first.effect, plain)), second)]


def _firsts(plain: Trial, sketched: Fitted, done: Sequence[Tried]) -> list[Tried]:
    """Best first, without those that add nothing to the friction across that they bring along."""
    best, *others = telling(done)
    others = [t for t in others if WORTH_A_SECOND <= max(
        explained(plain, t.trial), gone(sketched.gap(), t.sketched.gap()))]
    return [best, *others][:FIRSTS]


def _simplest(search: Search, pair: Pair, candidates: Sequence[Candidate]) -> Pair:
    """Friction across the motion in place of what brings it along, if that is as good."""
    lateral = [c for c in candidates if c.effect == PART_OF_OTHERS]
    across = [t.candidate for t in pair if ACROSS in t.candidate.settings]
    if len(across) != 1 or across[0].effect == PART_OF_OTHERS or not lateral:
        return pair
    simpler = across_alone(search, pair[1], across[0])
    if simpler is None:
        return pair
    first, second = pair
    if second.candidate is across[0]:
        return first, _named(simpler, lateral[0])
    return _named(first, lateral[0]), _named(simpler, second.candidate)


def across_alone(search: Search, tried: Tried, brings: Candidate) -> Tried | None:
    """A trial with only the friction across left of what brings it along, if that is as good."""
    simpler = search.less(tried, brings, keep=(ACROSS,))
    return simpler if simpler.trial.gap**2 <= as_good(tried.trial) else None


def _named(tried: Tried, candidate: Candidate) -> Tried:
    return Tried(candidate, tried.model, tried.sketched, tried.trial)


def needed_alone(search: Search, plain: Trial, pair: Pair) -> Tried | None:
    """The effect that does nearly as well without the other, from where the pair ended; or None."""
    first, second = pair
    for kept, dropped in ((second, first), (first, second)):
        alone = search.less(second, dropped.candidate, keep=tuple(kept.candidate.settings))
        if not _is_needed(plain, alone.trial, second.trial):
            return _named(alone, kept.candidate)
    return None
