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
        options = {name: options_of(some, len(system.fitted)) for name, some in unknowns.items()}
        for law in laws:
            if law.wave is not None:
                options.setdefault(law.argument, []).append(law.wave)
        self.decision = Decision(system.rung(), options)
        rows = drawn(system.rung(), draws, np.random.default_rng(seed), scatter, 1.0)
        self.nothing = self.decision.projected(rows)
        self.columns = [self.decision.projected(system.columns(law.unknown)) for law in laws]

    def offers(self, number: int, away: float) -> Offers:
        """Of the campaigns with one of the laws, by its number, so far from where it is nothing."""
        law = self.laws[number]
        sizes = law.sizes(law.value(away))[:, None]
        pairs = zip(self.nothing, self.columns[number], strict=True)
        return self.decision.decided([base + columns @ sizes for base, columns in pairs])

    def first_guess(self, law: Law) -> float:
        """How far from nothing a law gains `LEAST_GAIN` beside the rig's own unknowns."""
        step = 1e-3 * law.range
        rows = self.system.columns(law.unknown) @ law.sizes(law.value(step))
        base = np.concatenate([self.system.columns(one).T @ rows for one in self.decision.base])
        left = float(rows @ rows - np.min(np.sum((self.decision.whitens @ base) ** 2, axis=1)))
        return step * float(np.sqrt(2.0 * LEAST_GAIN / max(left, 1e-300)))

    def smallest(
        self, number: int, low: float, high: float, wanted: float, alone: bool = False
    ) -> float:
        """How far from nothing a law is named in a part of the campaigns; infinite: never.

        alone : by itself, not in a class
        """
        law = self.laws[number]
        low, high = min(low, law.range), min(high, law.range)

        def told(at: float) -> bool:
            return float(np.mean(is_named(law, self.offers(number, at), alone))) >= wanted

        if not told(high):
            return np.inf
        for _ in range(HALVINGS):
            middle = float(np.sqrt(low * high))
            low, high = (low, middle) if told(middle) else (middle, high)
        return high

    def size(self, number: int, away: float, alone: float) -> Size:
        """Of a law so far from nothing; alone : from where it is named by itself."""
        law = self.laws[number]
        if not np.isfinite(away):
            return Size(law, None, None, 0.0, {}, {})
        offers = self.offers(number, away)
        shares = dict(zip(offers.names, offers.near.mean(axis=1).tolist(), strict=True))
        power = shares.pop(law.argument)
        return Size(
            law, law.value(away), law.value(max(alone, away)) if np.isfinite(alone) else None,
            power, counted(offers.answers()), {name: one for name, one in shares.items() if one},
        )  # fmt: skip


def is_named(law: Law, offers: Offers, alone: bool = False) -> np.ndarray:
    """(c,) by itself, or in a class too."""
    most = 1 if alone else len(offers.names)
    near = offers.near
    return np.asarray(near[offers.names.index(law.argument)] & (near.sum(axis=0) <= most))


def sizes_of(design: Design, wanted: float, progress: Callable[[], object]) -> list[Size]:
    """Smallest sizes of all laws, and what they would be taken for."""
    sizes = []
    for number, law in enumerate(design.laws):
        progress()
        low, high = np.multiply(BRACKET, design.first_guess(law))
        away = design.smallest(number, low, high, wanted)
        alone = design.smallest(number, away, BRACKET[1] * away, wanted, alone=True)
        sizes.append(design.size(number, away, alone))
    return sizes


def false_names(design: Design) -> float:
    """Part of the campaigns without any effect in which something is named."""
    answers = design.decision.decided(design.nothing).answers()
    return 1.0 - counted(answers).get(NONE, 0) / len(answers)
