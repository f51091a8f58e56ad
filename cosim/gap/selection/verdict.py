"""From a campaign's plain models and the catalogue to a finding: a ladder of models, and a verdict.

Plain, one effect, two, three: each rung must be worth its place by evidence (see `decision`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from stickslip.effects.candidate import Candidate, FreeParameter

from cosim.gap.estimation.trial import Model
from cosim.gap.evidence.settled import Settled

from .decision import (
    LAW,
    implausible,
    is_at_large,
    is_left,
    is_noise,
    members_of,
    needed,
    resolved,
)
from .search import ALONE, BESIDE, Search
from .tried import Tried, by_run, gain

#: The most effects of a model.
MOST = 3
#: As much of a second harmonic as is usual, a part of the first.
_USUAL_SECOND = 0.3


@dataclass(frozen=True)
class Rung:
    """A model of the ladder.

    Attributes
    ----------
    effects : in the order found; those of a class are told by ``members``
    settled : the model at its best
    gain : in -2 ln evidence over the rung below
    members : what does as well in the last one's place, itself included
    """

    effects: tuple[str, ...]
    settled: Settled
    gain: float
    members: tuple[Tried, ...] = ()


@dataclass(frozen=True)
class Finding:
    """What the search came to.

    Attributes
    ----------
    verdict : named, class, none, partial or unknown
    effects : ids in the order found; for a class its members
    ladder : plain, one effect, two, ...
    chosen : number of the rung that the verdict stands on, 0 where nothing is named
    ranking : every effect on top of the plain model, best first
    share : part of the plain model's misfit, in -2 ln evidence, that is gone
    reasons : what the model that is left needs and a rig as stated does not have, a line each
    """

    verdict: str
    effects: tuple[str, ...]
    ladder: tuple[Rung, ...]
    chosen: int
    ranking: tuple[Tried, ...]
    share: float
    reasons: tuple[str, ...]

    @property
    def model(self) -> Settled:
        """That the verdict stands on."""
        return self.ladder[self.chosen].settled


def judge(search: Search, model: Model, laws) -> Finding:
    """Look for effects one by one. laws : of the plain model as it was settled -> candidates."""
    plain = search.plain(model)
    candidates: Sequence[Candidate] = laws(plain)
    ladder = [Rung((), plain, 0.0)]
    ranking: tuple[Tried, ...] = ()
    while len(ladder) <= MOST:
        now = ladder[-1]
        if now.effects and is_noise(now.settled):
            break
        others = [law for law in candidates if law.effect not in now.effects]
        others += [bent for law in candidates for bent in bends(law, now)]
        effects = {law.effect for law in others}
        most, beyond = BESIDE if now.effects else ALONE, _least_worth(ladder, len(effects))
        below, tried = search.on(now.settled, others, most, beyond)
        if below is not now.settled:
            ladder[-1] = replace(now, settled=below, gain=now.gain + gain(below, now.settled))
        ranking = ranking or tuple(tried)
        members = members_of(tried)
        if not members or not _is_worth(members[0], ladder, len(effects)):
            break
        bent = next((t for t in members if t.candidate.effect in now.effects), None)
        if bent:
            ladder[-1] = replace(ladder[-1], settled=bent.model, gain=ladder[-1].gain + bent.gain)
            continue
        best = members[0]
        ladder.append(
            Rung((*now.effects, best.candidate.effect), best.model, best.gain, tuple(members))
        )
        ladder = _without_superfluous(search, ladder, len(effects))
    return concluded(ladder, ranking)


def bends(law: Candidate, rung: Rung) -> tuple[Candidate, ...]:
    """What of a law may stand beside the one that the effect has which was found last, if anything.

    Nature's law has its own shape: what a law of the catalogue is wrong by, another form of the
    same effect may make up for, a wave's second harmonic for instance, and then no other effect is
    called for.
    """
    if not rung.effects or law.effect != rung.effects[-1]:
        return ()
    found, settings = rung.settled.values, rung.settled.model.settings
    known = all(settings.get(key) == value for key, value in law.settings.items())
    fresh = tuple(f for f in law.free_parameters if f.key not in found and not f.per_run)
    if not known or not fresh:
        return ()
    if law.periodic:  # in phase with the first, and a quarter of a period ahead
        return tuple(replace(law, periodic="", free_parameters=_first(one, fresh)) for one in fresh)
    return (law,) if len(fresh) == len(law.free_parameters) else ()


def _first(one: FreeParameter, free_parameters: Sequence[FreeParameter]):
    """Some strengths that are nothing, one of them first and as much as is usual."""
    rest = tuple(free for free in free_parameters if free is not one)
    return (replace(one, start=_USUAL_SECOND), *rest)


def _without_superfluous(search: Search, ladder: list[Rung], count: int) -> list[Rung]:
    """The ladder without an effect that the last one's makes superfluous."""
    plain, last = ladder[0].settled, ladder[-1]
    if len(ladder) != 3:
        return ladder
    alone = search.without(plain, [last.members[0].candidate], last.settled)
    left = last.settled.evidence - last.settled.rows
    if resolved(last.settled, alone) > max(needed(count), left):
        return ladder
    rung = Rung(last.effects[1:], alone, gain(alone, plain), last.members)
    return [ladder[0], rung]


def _least_worth(ladder: Sequence[Rung], count: int) -> float:
    """Evidence above which an effect beside those of a ladder is not worth its place."""
    now = ladder[-1].settled
    least = now.evidence - _least_gain(ladder, count)
    if ladder[-1].effects:  # it must take more than it leaves
        least = min(least, 0.5 * (now.evidence + now.rows))
    return least


def _least_gain(ladder: Sequence[Rung], count: int) -> float:
    """Gain beyond chance, and beyond what the laws of a ladder are wrong by."""
    if not ladder[-1].effects:
        return needed(count)
    return max(needed(count), LAW**2 * sum(rung.gain for rung in ladder))


def _is_worth(best: Tried, ladder: Sequence[Rung], count: int) -> bool:
    """Whether an effect's evidence is beyond chance and what the laws before it are wrong by.

    And in the runs at large: as each of them is predicted by the others, better by more than the
    error of that. Beside another, an effect must take more of what that leaves than it leaves
    itself: a law is never quite nature's, and what it is wrong by looks like a little of many
    others.
    """
    now = ladder[-1]
    least = _least_gain(ladder, count)
    if now.effects:
        least = max(least, best.model.evidence - best.model.rows)
    return resolved(best.model, now.settled) > least and is_at_large(best.model, now.settled)


def concluded(ladder: Sequence[Rung], ranking: tuple[Tried, ...]) -> Finding:
    """What a ladder says, its last rung judged as it stands."""
    plain, last = ladder[0].settled, ladder[-1]
    reasons = tuple(implausible(last.settled))
    taken = share(last.settled, plain, last.settled) if last.effects else 0.0
    fits = not reasons and not is_left(last.settled)

    def finding(verdict: str, effects: tuple[str, ...], chosen: int) -> Finding:
        return Finding(verdict, effects, tuple(ladder), chosen, ranking, taken, reasons)

    if not last.effects:
        return finding("none" if fits else "unknown", (), 0)
    if not fits:
        everywhere = bool(np.all(by_run(last.settled, plain) > 0.0))
        if everywhere and taken > 0.5:
            return finding("partial", last.effects, len(ladder) - 1)
        return finding("unknown", (), 0)
    if len(last.members) > 1:
        if len(last.effects) > 1:  # the first stands, the second is one of several
            return finding("class", last.effects, len(ladder) - 1)
        return finding("class", tuple(t.candidate.effect for t in last.members), len(ladder) - 1)
    return finding("named", last.effects, len(ladder) - 1)


def share(settled: Settled, plain: Settled, last: Settled) -> float:
    """Part of the plain model's misfit, in -2 ln evidence, that a model takes away.

    Misfit is what is over that of noise alone, one for each sample, or over the best model's.
    """
    least = min(float(last.rows), last.evidence)
    return gain(settled, plain) / max(plain.evidence - least, 1e-9)
