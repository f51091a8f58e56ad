"""The ladder: the argument that the rows ask for most joins, and all others are asked again.

What was added first for want of the true one is dropped again where its place is taken: after every
step each earlier finding is asked whether the rows are less probable without it, and whether
another does better in its place.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import inf

from cosim.gap.weak_form import periodic
from cosim.gap.weak_form.added import Added
from cosim.gap.weak_form.constants import (
    ALIKE,
    LEAST_GAIN,
    LEAST_PART,
    MOST_FINDINGS,
    NEARLY_ALIKE,
    PRICE,
    UNDECIDED,
)
from cosim.gap.weak_form.system import Rung, System
from cosim.gap.weak_form.unknowns import Unknown

#: Findings that round corners, as what a contact and other findings leave there does: they are
#: asked of runs in which nothing else is missing.
ALONE = ("measurement.latency",)
#: What goes from run to run, as scatter does: evidence alone tells the one from the other, and
#: nothing that smoothed arguments leave within a run looks like it.
TRENDS = ("load_dependence", "other.room", "other.order")
#: What friction over the sliding speed is called, growing and falling.
GROWS, FALLS = "film_drag", "velocity_weakening"
BY_SPEED = (GROWS, FALLS)
#: ln evidence with one more finding, and its unknowns.
Offer = tuple[float, tuple[Added, ...]]
_Found = list[tuple[str, tuple[Added, ...]]]


@dataclass(frozen=True)
class Finding:
    """What was found.

    name : effect, measurement fault, or a finding that no effect stands for; added : its unknowns,
    none of what moves the block across (`planar`); gain : ln of how much less probable the rows are
    without it; others : name -> ln evidence with another in its place, less that with it
    numbers, settings : of what moves the block across, (value, standard deviation), SI, and in
    which runs it is
    """

    name: str
    added: tuple[Added, ...]
    gain: float
    others: Mapping[str, float] = field(default_factory=dict)
    numbers: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    settings: Mapping[str, float] = field(default_factory=dict)

    @property
    def variant(self) -> str:
        """Its setting in words."""
        if self.added:
            return self.added[0].unknown.variant
        there = sorted(key.partition("@")[2] for key, part in self.settings.items() if part)
        return f"in {', '.join(there)}" if there else ""

    @property
    def main(self) -> Added:
        """The unknown that says how large it is; others are phases."""
        return self.added[0]


@dataclass(frozen=True)
class Ladder:
    """Findings in their order, the rows with all of them, what was offered first of all, and what
    is offered beside them."""

    system: System
    findings: tuple[Finding, ...]
    rung: Rung
    first_offers: Mapping[str, Offer]
    further_offers: Mapping[str, Offer]


class Search:
    """Everything that can be asked of the rows."""

    def __init__(
        self, system: System, unknowns: Mapping[str, Sequence[Unknown]],
        waves: Sequence[periodic.Periodic],
        near: Callable[[Unknown], Sequence[Unknown]] = lambda unknown: (),
        barred: Collection[str] = (),
    ):  # fmt: skip
        """near : unknown -> the same argument with settings between those that were tried;
        barred : names that no argument may go by"""
        self.system, self.unknowns, self.waves = system, unknowns, waves
        self.near, self.barred = near, barred

    def offers(self, rung: Rung, without: Sequence[str] = ()) -> dict[str, Offer]:
        """name -> the best that each argument offers on a rung; each is worked out once."""
        known = self._known(rung)
        found: dict[str, Offer] = {}
        for name, variants in self.unknowns.items():
            if name not in without and not (name in ALONE and rung.added):
                if name not in known:
                    evidence, added = rung.offered(variants)
                    known[name] = (evidence - price_of(name), (added,))
                found[name] = known[name]
        best = max((offer[0] for offer in found.values()), default=-inf)
        for kind in self.waves:
            if kind.name in without:
                continue
            wave = None if kind.key in known else periodic.offered(rung, kind, best - NEARLY_ALIKE)
            if wave:
                known[kind.key] = (wave[0] - price_of(kind.name), wave[1])
            offer = known.get(kind.key)
            # of two that tell no difference the first: time is simpler than travel
            if offer and (kind.name not in found or offer[0] > found[kind.name][0] + ALIKE):
                found[kind.name] = offer
        left = {*self.barred, *without}  # by any other argument that would go by these names
        offers = self._by_direction(rung, found)
        return {name: offer for name, offer in offers.items() if name not in left}

    def _by_direction(self, rung: Rung, offers: dict[str, Offer]) -> dict[str, Offer]:
        """Friction over the sliding speed is named by its direction: it grows, or falls.

        Coefficient and force are two arguments, of which both may grow, and both may fall.
        """
        over_speed = [(name, offers.pop(name)) for name in BY_SPEED if name in offers]
        for _, offer in sorted(over_speed, key=lambda pair: pair[1][0]):  # the better one stays
            here = rung.with_more(offer[1])
            curve = here.posterior[0][here.part_of(offer[1][0])]
            offers[GROWS if curve[-1] > 0.0 else FALLS] = offer
        return offers

    def climb(self, most: int = MOST_FINDINGS) -> Ladder:
        """Add, drop and exchange until nothing more is asked for, or there are so many findings."""
        found: _Found = []
        first = self.offers(self._rung(found))
        for number in range(most):
            rung = self._rung(found)
            offers = self.offers(rung, [name for name, _ in found]) if number else first
            if not offers:
                break
            best = max(offers, key=lambda each: offers[each][0])
            offers[best] = self._finer(rung, best, offers[best])
            there = [each for each in TRENDS if each in offers]
            trends = sorted(there, key=lambda each: -offers[each][0])
            missed = (name for name in (best, *trends) if self._joins(rung, name, offers[name]))
            if (name := next(missed, None)) is None:
                break
            found = self._exchanged([*found, (name, offers[name][1])])
        return self._ladder(found, first)

    def _joins(self, rung: Rung, name: str, offer: Offer) -> bool:
        """Whether rows ask for one more, and miss it."""
        more = rung.with_more(offer[1])
        is_asked_for = offer[0] - rung.evidence >= _least(rung.added)
        return is_asked_for and self._is_missed(rung, more, name)

    def _finer(self, rung: Rung, name: str, offer: Offer) -> Offer:
        """The best of an argument's settings, also between those that were tried."""
        known = self._known(rung)
        if f"{name}, finer" not in known:
            best = (rung.with_more(offer[1]).evidence, offer[1])
            for unknown in self.near(offer[1][0].unknown):
                _, added = rung.offered([unknown])
                value = rung.with_more([added]).evidence
                best = max(best, (value, (added,)), key=lambda pair: pair[0])
            known[f"{name}, finer"] = (offer[0], best[1])
        return known[f"{name}, finer"]

    def _known(self, rung: Rung) -> dict[str, Offer]:
        """What has been worked out beside what a rung has: kept with the rows, for all searches."""
        _, known = self.system.offers.setdefault(tuple(map(id, rung.added)), (rung.added, {}))
        return known

    def _rung(self, found: _Found) -> Rung:
        return self.system.rung([added for _, group in found for added in group])

    @cached_property
    def _misfit_at_first(self) -> float:
        return self.system.rung().misfit

    def _is_missed(self, without: Rung, rung: Rung, name: str) -> bool:
        """Whether rows miss a finding; beside others, by more than a small part of all misfit.

        Where scatter and contact took it all from the first, at their price, evidence decides.
        """
        gained = rung.evidence - without.evidence - price_of(name)
        if gained <= _least(without.added):
            return False
        if not without.added or name in TRENDS:
            return True
        if self._misfit_at_first == 0.0:
            return gained > UNDECIDED
        return without.misfit - rung.misfit > LEAST_PART**2 * self._misfit_at_first

    def _exchanged(self, found: _Found) -> _Found:
        """Earlier findings, each replaced by another that does better beside the last."""
        for place in range(len(found) - 1):
            rest = found[:place] + found[place + 1 :]
            rung = self._rung(rest)
            offers = self.offers(rung, [name for name, _ in rest])
            best = max(offers, key=lambda each: offers[each][0])
            if best != found[place][0]:
                tried = [*found[:place], (best, offers[best][1]), *found[place + 1 :]]
                better = self._rung(tried)
                gained = better.evidence - self._rung(found).evidence
                is_better = _is_better(found[place][0], best, gained)
                if is_better and self._is_missed(self._rung(rest), better, best):
                    found = tried
        return self._without_idle(found)

    def _without_idle(self, found: _Found) -> _Found:
        """Without findings that the rows do not miss."""
        for one in list(found):
            rest = [other for other in found if other is not one]
            if not self._is_missed(self._rung(rest), self._rung(found), one[0]):
                found = rest
        return found

    def _ladder(self, found: _Found, first: Mapping[str, Offer]) -> Ladder:
        rung = self._rung(found)
        findings = []
        for name, added in found:
            rest = [other for other in found if other[0] != name]
            without = self._rung(rest)
            offers = first if not rest else self.offers(without, [n for n, _ in rest])
            reference = rung.evidence
            if name in {kind.name for kind in self.waves}:
                # it has been moved on since it was offered; its scan was as long
                wave = added[0].unknown.wave
                reference -= price_of(name) + periodic.price_of(wave, self.system.fitted)
            elif name in offers:
                reference = offers[name][0]
            if rest and name in TRENDS:
                offers = {other: offers[other] for other in TRENDS if other in offers}
            others = {
                other: offer[0] - reference for other, offer in offers.items() if other != name
            }
            findings.append(Finding(name, added, rung.evidence - without.evidence, others))
        further = first
        if found:  # beside the most that there may be nothing is asked
            names = [name for name, _ in found]
            further = self.offers(rung, names) if len(names) < MOST_FINDINGS else {}
        return Ladder(self.system, tuple(findings), rung, first, further)


def price_of(name: str) -> float:
    """ln of how much less probable beforehand it is than an effect."""
    return PRICE if name.startswith(("measurement.", "other.")) else 0.0


def _is_better(old: str, new: str, gained: float) -> bool:
    """Whether another finding is more probable in a place; as probable, if only it has a name.

    gained : ln of how much more probable the rows are with it
    """
    has_name = old.startswith("other.") and not new.startswith("other.")
    return gained - price_of(new) + price_of(old) > (0.0 if has_name else LEAST_GAIN)


def _least(found: Sequence[object]) -> float:
    """ln of how much more probable a finding must make the rows; less of the first of all.

    Simulated runs are asked for that, too (`judge`).
    """
    return LEAST_GAIN if found else ALIKE
