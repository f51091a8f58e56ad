"""The smallest size of each law that would be named, and what it would be taken for there.

A law of some size is put into drawn campaigns (`rates.drawn`), and the ladder's own first decision
is made on each. Rows are linear in what is unknown: a size only scales what the law does to X'z.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from cosim.gap.plan.laws import Law
from cosim.gap.rates import NONE, Decision, Offers, counted, drawn, options_of
from cosim.gap.weak_form.constants import LEAST_GAIN
from cosim.gap.weak_form.system import System
from cosim.gap.weak_form.unknowns import Unknown

#: Campaigns that are drawn of every size: a chance of 80 % is known to 3 %.
DRAWS = 200
#: Factors on the size at which a law would gain what is needed without its price: the bracket.
BRACKET = (0.5, 12.0)
#: Halvings of the bracket on a logarithmic scale: 2.5 %.
HALVINGS = 7


@dataclass(frozen=True)
class Size:
    """A law's smallest size.

    Attributes
    ----------
    value : of its parameter, named by itself or in a class; None: no size that it may have is
    alone : the same, named by itself
    power : part of the campaigns in which it is named at that value
    answers : answer -> how often, of `DRAWS` campaigns at that value
    shares : argument -> part of the campaigns in which it is named beside the law, or in its place
    """

    law: Law
    value: float | None
    alone: float | None
    power: float
    answers: Mapping[str, int]
    shares: Mapping[str, float]

    @property
    def percent(self) -> float | None:
        """The largest change of friction at the value, percent of it."""
        return None if self.value is None else self.law.percent(self.value)


class Design:
    """Drawn campaigns of a planned design, and the decision on them.

    scatter : of friction from run to run, as stated
    """

    def __init__(
        self, system: System, unknowns: Mapping[str, Sequence[Unknown]], laws: Sequence[Law],
        scatter: float, draws: int = DRAWS, seed: int = 0,
    ):  # fmt: skip
        self.system, self.laws = system, laws
        runs = len(system.fitted)
        options = {name: options_of(some, runs) for name, some in unknowns.items()}
        for law in laws:
            if law.wave is not None:
                options.setdefault(law.argument, []).append(law.wave)
        rung = system.rung()
        self.decision = Decision(rung, options)
        rows = drawn(rung, draws, np.random.default_rng(seed), scatter, 1.0)
        self.nothing = self.decision.projected(rows)
        self.columns = [self.decision.projected(system.columns(law.unknown)) for law in laws]

    def offers(self, laws: Sequence[int], away: Sequence[float] | np.ndarray) -> list[Offers]:
        """Of laws (their numbers) so far from where they are nothing."""
        sizes = [self.laws[i].sizes(self.laws[i].value(a))[:, None]
                 for i, a in zip(laws, away, strict=True)]  # fmt: skip
        rights = [
            np.hstack(
                [base + self.columns[i][option] @ b for i, b in zip(laws, sizes, strict=True)]
            )
            for option, base in enumerate(self.nothing)
        ]
        all_of_them = self.decision.decided(rights)
        count = self.nothing[0].shape[1]
        return [
            Offers(all_of_them.names, all_of_them.evidence[:, i : i + count],
                   all_of_them.gain[:, i : i + count])
            for i in range(0, count * len(laws), count)
        ]  # fmt: skip

    def first_guess(self, law: Law) -> float:
        """How far from nothing a law gains `LEAST_GAIN` beside the rig's own unknowns."""
        step = 1e-3 * abs(law.most - law.neutral)
        rows = self.system.columns(law.unknown) @ law.sizes(law.value(step))
        base = np.concatenate([self.system.columns(one).T @ rows for one in self.decision.base])
        left = float(rows @ rows - np.min(np.sum((self.decision.whitens @ base) ** 2, axis=1)))
        return step * float(np.sqrt(2.0 * LEAST_GAIN / max(left, 1e-300)))

    def smallest(
        self, laws: Sequence[int], low: np.ndarray, high: np.ndarray, wanted: float,
        is_told: Callable[[Law, Offers], np.ndarray], progress: Callable[[], object],
    ) -> np.ndarray:  # fmt: skip
        """How far from nothing each law is told in a part of the campaigns; infinite: never."""
        most = np.array([abs(self.laws[i].most - self.laws[i].neutral) for i in laws])
        low, high = np.minimum(low, most), np.minimum(high, most)

        def told(at: np.ndarray) -> np.ndarray:
            progress()
            offers = self.offers(laws, at)
            return np.array([np.mean(is_told(self.laws[i], one)) >= wanted
                             for i, one in zip(laws, offers, strict=True)])  # fmt: skip

        never = ~told(high)
        for _ in range(HALVINGS):
            middle = np.sqrt(low * high)
            reached = told(middle)
            low, high = np.where(reached, low, middle), np.where(reached, middle, high)
        return np.where(never, np.inf, high)


def is_named(law: Law, offers: Offers) -> np.ndarray:
    """(c,) by itself or in a class."""
    return np.asarray(offers.near[offers.names.index(law.argument)])


def is_alone(law: Law, offers: Offers) -> np.ndarray:
    """(c,) by itself."""
    return is_named(law, offers) & (offers.near.sum(axis=0) == 1)


def sizes_of(design: Design, wanted: float, progress: Callable[[], object]) -> list[Size]:
    """Smallest sizes of all laws, and what they would be taken for."""
    every = list(range(len(design.laws)))
    guess = np.array([design.first_guess(law) for law in design.laws])
    seen = design.smallest(
        every, BRACKET[0] * guess, BRACKET[1] * guess, wanted, is_named, progress
    )
    there = [i for i in every if np.isfinite(seen[i])]
    at = seen[there]
    alone = np.full(len(every), np.inf)
    if there:
        alone[there] = design.smallest(there, at, BRACKET[1] * at, wanted, is_alone, progress)
    offers = dict(zip(there, design.offers(there, at) if there else (), strict=True))
    return [_size(law, seen[i], alone[i], offers.get(i)) for i, law in enumerate(design.laws)]


def _size(law: Law, seen: float, alone: float, offers: Offers | None) -> Size:
    if offers is None:
        return Size(law, None, None, 0.0, {}, {})
    by_itself = law.value(max(alone, seen)) if np.isfinite(alone) else None
    shares = dict(zip(offers.names, offers.near.mean(axis=1).tolist(), strict=True))
    others = {name: share for name, share in shares.items() if name != law.argument and share}
    power = float(np.mean(is_named(law, offers)))
    return Size(law, law.value(seen), by_itself, power, counted(offers.answers()), others)


def size_at(design: Design, away: float, alone: float | None) -> Size:
    """Of a design's only law so far from nothing; alone : from where it is named by itself."""
    (law,) = design.laws
    far = np.inf if alone is None else abs(alone - law.neutral)
    return _size(law, away, far, design.offers([0], [away])[0])


def false_names(design: Design) -> float:
    """Part of the campaigns without any effect in which something is named."""
    answers = counted(design.decision.decided(design.nothing).answers())
    return 1.0 - answers.get(NONE, 0) / design.nothing[0].shape[1]
