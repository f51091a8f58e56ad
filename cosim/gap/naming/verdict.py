"""From trials of the catalogue to a verdict: named, class, none, unknown."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cosim.gap.candidates.candidate import Candidate
from cosim.gap.shooting.fit import Fitted
from cosim.gap.shooting.trial import Trial

from .search import Search, Tried

#: The plain model fits when its gap is at most this: what a real contact has beside any model
#: (creep before sliding, a tracker's own errors) is worth about three quarters of the noise.
PLAIN_FITS = 1.3
#: A repaired model fits when its gap is at most this, ...
FITS = 1.5
#: ... or when it has taken away this part of the excess over the noise, in squares: the law of a
#: real effect is never quite the catalogue's.
EXPLAINED_BY_ONE, EXPLAINED_BY_TWO = 0.93, 0.85
#: What takes away less than this part has no name, however little there was.
EXPLAINED_AT_LEAST = 0.5
#: Where the plain model fits in short flights, what long ones show up to this gap may be the drift
#: of a motion that is unstable by itself; a name for so little must explain this part of it.
DRIFT, EXPLAINED_IF_LITTLE = 2.0, 0.85
#: Where no second effect helps, one that has taken away this part alone is named all the same, if
#: no other comes near: none takes away more than this part of it.
DOMINANT, RIVAL = 0.85, 0.5
#: So many times the part that is gone from the fitted runs may be gone from all.
FELT_BY_FITTED = 2.0
#: Effects cannot be told apart when their gaps, squared, differ by less than this ...
ALIKE = 0.08
#: ... and this part of what the better one leaves over the noise.
ALIKE_PART = 0.1
#: So many single effects are tried with a second one, if they take away this part alone; the
#: best few are whatever they take away.
FIRSTS, WORTH_A_SECOND, AT_LEAST = 3, 0.2, 2
#: So many effects are tried once more when the best one leaves more than noise.
POLISHED = 2
#: Of two effects, each must have taken away this part of what the other leaves, in squares.
NEEDED = 0.3


#: Friction across the motion comes with every effect that moves a block off its line.
PART_OF_OTHERS = "lateral_friction"


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
    """

    verdict: str
    effects: tuple[str, ...]
    chosen: Trial | None
    ranking: Sequence[Tried]
    nearest: Trial


def judge(search: Search, plain: Trial, sketched: Fitted, candidates: Sequence[Candidate]):
    """Look for one effect, then for two: `Finding`."""
    ranking = search.on(plain.model, sketched, candidates)
    done = [t for t in ranking if t.trial is not None]
    best = done[0]
    if plain.gap <= PLAIN_FITS:
        return Finding("none", (), None, ranking, plain)
    if best.trial.gap > PLAIN_FITS:
        done = _merged(search.polished(done[:POLISHED], candidates), done)
        best = done[0]
        ranking = [*done, *(t for t in ranking if t.trial is None)]
    little = is_little(plain, sketched)
    if repaired(plain, best.trial, EXPLAINED_BY_ONE, EXPLAINED_IF_LITTLE if little else None):
        members = alike(done)
        verdict = "named" if len(members) == 1 else "class"
        return Finding(verdict, members, best.trial, ranking, best.trial)
    if little:  # and nothing explains it
        return Finding("none", (), None, ranking, plain)
    pair = _best_pair(search, plain, done, candidates)
    if pair and repaired(plain, pair[1].trial, EXPLAINED_BY_TWO):
        effects = (pair[0].candidate.effect, pair[1].candidate.effect)
        return Finding("named", effects, pair[1].trial, ranking, pair[1].trial)
    if _dominates(plain, done):
        return Finding("named", (best.candidate.effect,), best.trial, ranking, best.trial)
    nearest = min([best.trial, *([pair[1].trial] if pair else [])], key=lambda t: t.gap)
    return Finding("unknown", (), None, ranking, nearest)


def _merged(better: Sequence[Tried], done: Sequence[Tried]) -> list[Tried]:
    """The polished ones in place of what they were, best first."""
    effects = {t.candidate.effect for t in better}
    rest = [t for t in done if t.candidate.effect not in effects]
    return sorted([*better, *rest], key=lambda t: t.trial.gap)


def is_little(plain: Trial, sketched: Fitted) -> bool:
    """Whether what the plain model leaves is next to nothing, or nothing but drift."""
    return plain.gap <= FITS or (plain.gap <= DRIFT and sketched.gap() <= PLAIN_FITS)


def repaired(plain: Trial, trial: Trial, part: float, at_least: float | None = None) -> bool:
    """Whether next to nothing of what there was is left: this part is gone, or noise remains.

    at_least : part that must be gone where noise remains, EXPLAINED_AT_LEAST if not given
    """
    gone = explained(plain, trial)
    least = EXPLAINED_AT_LEAST if at_least is None else at_least
    return gone >= part or (gone >= least and excess(trial) <= FITS**2 - 1.0)


def explained(plain: Trial, trial: Trial) -> float:
    """Part of the plain model's excess that is gone from all runs.

    It counts no more than so many times what is gone from those fitted: a number that they hardly
    feel may happen to help a run that was held out.
    """
    gone = _gone(plain.gap, trial.gap)
    if plain.fitted.gap() <= PLAIN_FITS:
        return gone
    return min(gone, FELT_BY_FITTED * _gone(plain.fitted.gap(), trial.fitted.gap()))


def _gone(before: float, after: float) -> float:
    return 1.0 - max(after**2 - 1.0, 0.0) / (before**2 - 1.0) if before > 1.0 else 0.0


def _dominates(plain: Trial, done: Sequence[Tried]) -> bool:
    parts = [explained(plain, t.trial) for t in done]
    return parts[0] >= DOMINANT and all(part <= RIVAL * parts[0] for part in parts[1:])


def excess(trial: Trial) -> float:
    """Mean square residual over that of the noise."""
    return max(trial.gap**2 - 1.0, 0.0)


def alike(done: Sequence[Tried]) -> tuple[str, ...]:
    """The effects that repair the model as well as the best one does."""
    best = done[0].trial
    members = tuple(t.candidate.effect for t in done if t.trial.gap**2 <= _as_good(best))
    if PART_OF_OTHERS in members:  # then what the others add to it is of no use
        has_it = {t.candidate.effect for t in done if f"{PART_OF_OTHERS}.ratio" in t.model.settings}
        members = tuple(m for m in members if m == PART_OF_OTHERS or m not in has_it)
    return members


def _as_good(best: Trial) -> float:
    """Square of the gap that is as good as the best one."""
    return best.gap**2 + ALIKE + ALIKE_PART * excess(best)


def _simplest_first(done: Sequence[Tried]) -> list[Tried]:
    """Best first, but an effect that is part of others before those that are no better."""
    kept = alike(done)
    return sorted(done, key=lambda t: PART_OF_OTHERS not in kept or t.candidate.effect not in kept)


def _best_pair(
    search: Search, plain: Trial, done: Sequence[Tried], candidates: Sequence[Candidate]
) -> tuple[Tried, Tried] | None:
    """The two effects that together leave least, if each is needed beside the other."""
    ordered = _simplest_first(done)
    firsts = [
        t for i, t in enumerate(ordered)
        if i < AT_LEAST or explained(plain, t.trial) >= WORTH_A_SECOND
    ]
    alone = {t.candidate.effect: excess(t.trial) for t in done}
    needed: list[tuple[Tried, Tried]] = []
    for first in firsts[:FIRSTS]:
        others = [c for c in candidates if c.effect != first.candidate.effect]
        for second in search.on(first.model, first.sketched, others):
            if second.trial is None:
                continue
            other = alone.get(second.candidate.effect, np.inf)
            if excess(second.trial) <= (1.0 - NEEDED) * min(excess(first.trial), other):
                needed.append((first, second))
        best = min(needed, key=lambda pair: pair[1].trial.gap, default=None)
        if best and repaired(plain, best[1].trial, EXPLAINED_BY_TWO):
            return _simplest_pair(search, best, done, candidates)
    return min(needed, key=lambda pair: pair[1].trial.gap, default=None)


def _simplest_pair(
    search: Search, pair: tuple[Tried, Tried], done: Sequence[Tried],
    candidates: Sequence[Candidate],
) -> tuple[Tried, Tried]:
    """Friction across the motion in place of what brings it along, if that is as good."""
    across = [t for t in pair if f"{PART_OF_OTHERS}.ratio" in t.candidate.settings]
    if not across or across[0].candidate.effect == PART_OF_OTHERS:
        return pair
    (other,) = (t for t in pair if t is not across[0])
    alone = next((t for t in done if t.candidate.effect == other.candidate.effect), None)
    plainer = [c for c in candidates if c.effect == PART_OF_OTHERS]
    if alone is None or not plainer:
        return pair
    (simpler,) = search.on(alone.model, alone.sketched, plainer)
    if simpler.trial.gap**2 <= _as_good(pair[1].trial):
        return alone, simpler
    return pair
