"""What a planned campaign could name: sizes, pairs that it cannot tell apart, the next best run."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from stickslip import EFFECTS
from stickslip.quantity import details

from cosim.processes import Map, processes

from .law import Law, kinds, laws_of
from .next_run import NextRun, best_next_runs, options, task
from .pairs import Mistaken, mistaken, refitted
from .planned import PlannedCampaign, Rehearsal, rehearse_plan
from .power import LEVEL, WANTED, needed
from .visibility import Visible, friction_length, smallest

#: So many of the effects that come nearest to each, and are told apart by derivatives, are really
#: fitted in its place.
_REFITTED = 2


@dataclass(frozen=True)
class Size:
    """The smallest size of a law that would be named.

    Attributes
    ----------
    effect, form : of the law
    key, unit : its parameter, `block.parameter`
    neutral : where the parameter is nothing
    value : smallest size that is named, by itself or in a class; infinite: none is
    alone : the same for the effect by itself, told from every other (of an effect's best law)
    percent : of value, as percent of friction: so much more of it moves the block as much
    percent_per_unit : percent of friction of a unit of the parameter's distance from nothing
    shapes : its other numbers, for which this holds
    typical : range in which the effect shows in rigs of this kind; None: not stated
    """

    effect: str
    form: str
    key: str
    unit: str
    neutral: float
    value: float
    alone: float
    percent: float
    percent_per_unit: float
    shapes: dict[str, float]
    typical: tuple[float, float] | None


@dataclass(frozen=True)
class Plan:
    """The answer.

    Attributes
    ----------
    planned : the campaign
    level, wanted : family-wise chance to name what is not there; chance to name what is
    laws : smallest size of every law, in the catalogue's order; sizes : the best of each effect
    pairs : each effect at its smallest size beside each other effect
    silent : effect -> why it is not tried
    next_runs : best for the worst effect, and for the worst pair where there is one
    grid : how many next runs were looked at
    """

    planned: PlannedCampaign
    level: float
    wanted: float
    laws: tuple[Size, ...]
    sizes: tuple[Size, ...]
    pairs: tuple[Mistaken, ...] = field(repr=False)
    silent: dict[str, str]
    next_runs: tuple[NextRun, ...]
    grid: int

    @property
    def indistinguishable(self) -> tuple[tuple[str, str], ...]:
        """Pairs of which one, at its smallest size, might be taken for the other."""
        order = {entry.id: place for place, entry in enumerate(EFFECTS)}
        found = {
            tuple(sorted((pair.truth, pair.other), key=order.__getitem__))
            for pair in self.pairs
            if pair.times > 1.0
        }
        return tuple(sorted(found, key=lambda two: [order[one] for one in two]))  # type: ignore


def make_plan(
    planned: PlannedCampaign,
    *,
    level: float = LEVEL,
    wanted: float = WANTED,
    jobs: int = 2,
    progress: Callable[[int], object] | None = None,
) -> Plan:
    """The answer for a planned campaign.

    level : family-wise chance to name what is not there; wanted : chance to name what is; progress
    : called with 1 after every law, pair and run
    """
    rehearsal = rehearse_plan(planned)
    laws, silent = laws_of(planned, rehearsal)
    rule = _Rule(level, wanted, kinds(laws))
    grid = options(planned)
    with processes(jobs) as mapped:
        visible = _visible(rehearsal, laws, rule, mapped, progress)
        best = _best(visible)
        pairs = _pairs(rehearsal, visible, best, rule, mapped, progress)
        worst = max(pairs, key=lambda pair: pair.times, default=None)
        worst = worst if worst and worst.times > 1.0 else None
        asked = task(planned, rehearsal, best, visible, worst)
        told = list(_counted(mapped(asked, [(option,) for option in grid]), progress))
    next_runs = best_next_runs(asked, grid, told, rule.of)
    return Plan(
        planned, level, wanted,
        tuple(_size(each) for each in visible),
        tuple(_alone(_size(each), each, pairs) for each in best),
        tuple(pairs), silent, next_runs, len(grid),
    )  # fmt: skip


@dataclass(frozen=True)
class _Rule:
    """Noncentralities that the rule of naming asks for."""

    level: float
    wanted: float
    laws: int

    def of(self, law: Law, runs: int) -> float:
        """For a law to be named in so many runs."""
        return needed(self.wanted, self.level, self.laws * law.periods, law.freedoms(runs))

    @property
    def apart(self) -> float:
        """For an effect to be told from one other."""
        return needed(self.wanted, self.level)


def _counted(results: Iterable, progress: Callable[[int], object] | None) -> Iterator:
    for result in results:
        if progress is not None:
            progress(1)
        yield result


def _visible(
    rehearsal: Rehearsal, laws: Sequence[Law], rule: _Rule, mapped: Map, progress
) -> list[Visible]:
    per_cent = friction_length(rehearsal)
    runs = len(rehearsal.runs)
    asked = [(rehearsal, law, rule.of(law, runs), per_cent) for law in laws]
    return list(_counted(mapped(smallest, asked), progress))


def _best(visible: Sequence[Visible]) -> list[Visible]:
    """The law of each effect that is named at the smallest part of friction."""
    by_effect: dict[str, list[Visible]] = {}
    for each in visible:
        by_effect.setdefault(each.law.effect, []).append(each)
    return [min(laws, key=lambda each: each.percent) for laws in by_effect.values()]


def _pairs(
    rehearsal: Rehearsal,
    visible: Sequence[Visible],
    best: Sequence[Visible],
    rule: _Rule,
    mapped: Map,
    progress,
) -> list[Mistaken]:
    """Every effect that is seen beside every other; the nearest ones with a refit."""
    pairs: dict[tuple[str, str], Mistaken] = {}
    asked = []
    for truth in best:
        if not truth.is_seen:
            continue
        found = []
        for effect in dict.fromkeys(each.law.effect for each in visible):
            if effect != truth.law.effect:
                laws = [each for each in visible if each.law.effect == effect]
                pair, nearest = mistaken(truth, laws, rule.apart)
                pairs[pair.truth, pair.other] = pair
                found.append((pair.apart, nearest))
        told = sorted((each for each in found if each[0] >= rule.apart), key=lambda each: each[0])
        asked += [(rehearsal, truth, nearest, rule.apart) for _, nearest in told[:_REFITTED]]
    for pair in _counted(mapped(refitted, asked), progress):
        pairs[pair.truth, pair.other] = pair
    return list(pairs.values())


def _size(visible: Visible) -> Size:
    law = visible.law
    block, _, name = law.size.key.partition(".")
    (table,) = (entry.table for entry in EFFECTS if entry.id == block)
    said = details(table.model_fields[name])
    unit = said["unit"]
    per_unit = visible.percent_of_start / abs(law.size.start - law.neutral)
    return Size(
        law.effect, law.candidate.form, law.size.key, "" if unit == "1" else unit, law.neutral,
        law.value(visible.part) if visible.is_seen else np.inf, np.inf, visible.percent, per_unit,
        {free.key: free.start for free in law.shapes}, said.get("typical"),
    )  # fmt: skip


def _alone(size: Size, visible: Visible, pairs: Sequence[Mistaken]) -> Size:
    """With the size at which the effect is told from every other."""
    times = max((pair.times for pair in pairs if pair.truth == size.effect), default=1.0)
    part = times * visible.part
    return replace(size, alone=visible.law.value(part) if part <= visible.law.most else np.inf)
