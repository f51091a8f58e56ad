"""Two effects at once: which two repair the model together, and whether either does alone."""

from __future__ import annotations

from collections.abc import Sequence

from stickslip.effects.candidate import Candidate

from cosim.gap.estimation.fitted import Fitted
from cosim.gap.estimation.trial import Trial

from .criteria import PART_OF_OTHERS, as_good, excess_chi_square, explained, gone, telling
from .pair_refinement import Pair, aliased, alternated, is_worth_more, polished, rms_of
from .search import Search
from .tried import ACROSS, Tried, penalised

#: So many single effects are tried with a second one, the best and those that take away this part
#: alone, in short segments or in long ones.
FIRSTS, WORTH_A_SECOND = 3, 0.2
#: So many pairs are fitted in long segments.
PAIRS = 3
#: No other first effect is tried when a pair leaves less than this part in short segments, and
#: hardly more than noise: else its first may be an alias of another.
REST, HARDLY = 0.05, 1.1
#: Beside one that has taken away so much alone, another effect must take away this part of what it
#: leaves, in squares: the first one's law may be a little wrong, and another law mend some of that.
DOMINANT, NEEDED = 0.85, 0.7


def best_pair(
    search: Search,
    plain: Trial,
    coarse: Fitted,
    done: Sequence[Tried],
    candidates: Sequence[Candidate],
) -> Pair | None:
    """The two effects that together leave least, if each is needed beside the other.

    coarse : the plain model in short segments
    """
    alone = {t.candidate.effect: t.trial for t in done}
    coarse_pairs = _coarse_pairs(search, plain, coarse, done, candidates)
    if not coarse_pairs:
        return None
    best = alternated(search, coarse, coarse_pairs[0], candidates)
    pairs = sorted(search.together([best, *coarse_pairs[1:]]), key=rms_of)
    if is_worth_more(plain, pairs[0]):
        better = polished(search, pairs[0], candidates)
        aliases = aliased(search, better, alone, plain, candidates)
        pairs = sorted([better, *aliases, *pairs[1:]], key=rms_of)
    for first, second in pairs:
        either = (first.trial, alone.get(second.candidate.effect, first.trial))
        if all(_is_needed(plain, one, second.trial) for one in either):
            return _simplest(search, (first, second), candidates)
    return None


def _is_needed(plain: Trial, alone: Trial, both: Trial) -> bool:
    """Whether two effects do so much better than one of them that the other has a part in it."""
    if alone.rms_residual**2 <= as_good(
        both
    ):  # next to the noise, a part of what is left says nothing
        return False
    little = (1.0 - NEEDED) * excess_chi_square(alone)
    return explained(plain, alone) < DOMINANT or excess_chi_square(both) <= little


def _coarse_pairs(
    search: Search,
    plain: Trial,
    coarse: Fitted,
    done: Sequence[Tried],
    candidates: Sequence[Candidate],
) -> list[Pair]:
    """The best pairs in short segments, each pair of effects once, best first."""
    pairs = _masking_pair(search, plain, coarse, done, candidates)
    little = min(1.0 + REST * (coarse.rms_residual() ** 2 - 1.0), HARDLY**2)
    for first in _firsts(plain, coarse, done):
        if any(second.coarse.rms_residual() ** 2 <= little for _, second in pairs):
            break
        others = [c for c in candidates if c.effect != first.candidate.effect]
        pairs += [(first, second) for second in search.beside(first.model, first.coarse, others)]
    best: dict[frozenset[str], Pair] = {}
    for pair in sorted(pairs, key=lambda pair: penalised(pair[1].coarse)):
        best.setdefault(frozenset(t.candidate.effect for t in pair), pair)
    return list(best.values())[:PAIRS]


def _masking_pair(
    search: Search,
    plain: Trial,
    coarse: Fitted,
    done: Sequence[Tried],
    candidates: Sequence[Candidate],
) -> list[Pair]:
    """The pair of which neither does much alone, if there is one."""
    two = search.masking_pair(plain.model, coarse, candidates)
    if two is None:
        return []
    first, second = two
    alone = {t.candidate.effect: t.trial for t in done}
    return [(Tried(first, second.model, coarse, alone.get(first.effect, plain)), second)]


def _firsts(plain: Trial, coarse: Fitted, done: Sequence[Tried]) -> list[Tried]:
    """Best first, without those that add nothing to the friction across that they bring along.

    Of those that move the block off its line only one: the others may take its place in a pair.
    """
    best, *others = telling(done)
    aside = next((t for t in (best, *others) if t.candidate.lateral), None)
    others = [t for t in others if t is aside or not t.candidate.lateral]
    worth = [
        t
        for t in others
        if WORTH_A_SECOND
        <= max(explained(plain, t.trial), gone(coarse.rms_residual(), t.coarse.rms_residual()))
    ]
    return [best, *worth][:FIRSTS]


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
    return simpler if simpler.trial.rms_residual**2 <= as_good(tried.trial) else None


def _named(tried: Tried, candidate: Candidate) -> Tried:
    return Tried(candidate, tried.model, tried.coarse, tried.trial)


def needed_alone(search: Search, plain: Trial, pair: Pair) -> Tried | None:
    """The effect that does nearly as well without the other, from where the pair ended; or None."""
    first, second = pair
    for kept, dropped in ((second, first), (first, second)):
        alone = search.less(second, dropped.candidate, keep=tuple(kept.candidate.settings))
        if not _is_needed(plain, alone.trial, second.trial):
            return _named(alone, kept.candidate)
    return None
