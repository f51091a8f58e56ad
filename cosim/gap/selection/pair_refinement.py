"""A pair of effects fitted more closely, where it does most and does not fit.

What was found first was found while the other effect was missing: its period, its law, or the
effect itself may be an alias of what was missing.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from stickslip.effects.candidate import Candidate

from cosim.gap.estimation.fitted import Fitted
from cosim.gap.estimation.trial import Trial

from .criteria import PLAIN_FITS, explained, gone
from .search import Search
from .tried import Tried, penalised

#: A pair that has taken away this part is fitted more closely, if it does not fit.
NEARLY = 0.8
#: A pair that takes away this part in short segments and does not fit has its periods searched for
#: anew, in so many turns at most, each of which must leave less than this part of the squares.
MOST, TURNS, LEADS_ON = 0.6, 2, 0.98

#: The first effect alone, and the second on top of it.
Pair = tuple[Tried, Tried]


def rms_of(pair: Pair) -> float:
    """Of both effects together."""
    return pair[1].trial.rms_residual


def alternated(search: Search, plain: Fitted, pair: Pair, candidates: Sequence[Candidate]) -> Pair:
    """Each periodic effect's period anew beside the other: it was found while that was missing.

    Backfitting (Breiman & Friedman 1985), in short segments; only of a pair that does most and does
    not fit.
    """
    for _ in range(TURNS):
        now = pair[1].coarse
        if (
            now.rms_residual() <= PLAIN_FITS
            or gone(plain.rms_residual(), now.rms_residual()) < MOST
        ):
            break
        for place in (0, 1):
            pair = _anew(search, pair, place, candidates)
        if pair[1].coarse.cost > LEADS_ON * now.cost:
            break
    return pair


def _anew(search: Search, pair: Pair, place: int, candidates: Sequence[Candidate]) -> Pair:
    """A pair with one of its effects searched for anew, if it is periodic and that is better."""
    law, now = pair[place].candidate, pair[1]
    found = search.anew(now, law, candidates) if law.periodic else None
    if found is None or penalised(found.coarse) >= penalised(now.coarse):
        return pair
    return _with_law(pair, place, found)


def _with_law(pair: Pair, place: int, found: Tried) -> Pair:
    """A pair with another law of its first or second effect."""
    first, second = pair
    if place == 1:
        return first, found
    return replace(first, candidate=found.candidate), replace(found, candidate=second.candidate)


def is_worth_more(plain: Trial, pair: Pair) -> bool:
    """Whether other laws of its effects may be what a pair lacks."""
    both = pair[1]
    if both.trial.rms_residual <= PLAIN_FITS:
        return False
    return both.coarse.rms_residual() <= PLAIN_FITS or explained(plain, both.trial) >= NEARLY


def polished(search: Search, pair: Pair, candidates: Sequence[Candidate]) -> Pair:
    """The pair by the best of either effect's laws."""
    laws = [t.candidate for t in reversed(pair)]
    found, *_ = search.polished([replace(pair[1], candidate=law) for law in laws], candidates)
    return _with_law(pair, 0 if found.candidate.effect == laws[1].effect else 1, found)


def aliased(
    search: Search,
    pair: Pair,
    alone: Mapping[str, Trial],
    plain: Trial,
    candidates: Sequence[Candidate],
) -> list[Pair]:
    """Others in place of an effect that moves the block off its line, if a pair does not fit."""
    aside = [t.candidate.lateral for t in pair]
    if rms_of(pair) <= PLAIN_FITS or not any(aside):
        return []
    names = {t.candidate.effect for t in pair}
    others = [c for c in candidates if c.lateral and c.effect not in names]
    dropped, kept = (pair[1], pair[0]) if aside[1] else pair
    found = search.instead(pair[1], dropped.candidate, others, tuple(kept.candidate.settings))
    kept = replace(kept, judged=alone.get(kept.candidate.effect, plain))
    return [(kept, other) for other in found]
