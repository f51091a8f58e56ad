"""How often a design would mislead: the decision made again on campaigns of the same design.

Rows z = X b + e are drawn, X the campaign's own columns, e of unit noise, b a truth's unknown at
its fitted size and the rig's own numbers as their priors have them. In the evidence of arguments
(see `weak_form.system`) only X'z is new then: what it is multiplied by is made once, and hundreds
of campaigns are decided in a second.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import block_diag

from cosim.gap.result import Rates
from cosim.gap.scatter import Scatter
from cosim.gap.weak_form import periodic
from cosim.gap.weak_form.added import Added, factor_of, factors_of
from cosim.gap.weak_form.constants import ALIKE, LEAST_GAIN, SCALES_ASKED
from cosim.gap.weak_form.ladder import BY_SPEED, Finding, Ladder, price_of
from cosim.gap.weak_form.rig_unknowns import MU_K, MU_S, SCATTER, ZERO_NAME
from cosim.gap.weak_form.system import Rung, System
from cosim.gap.weak_form.unknowns import Unknown

#: Campaigns of every truth: a chance of 10 % is known to 4 %.
EACH = 50
#: Explanations that might stand in a finding's place, the most probable ones, that are tried.
RUNNERS_UP = 3
#: A name is a class where another truth would be given that name in more than this part of the
#: campaigns: the usual error of the second kind is 10 to 20 % (Cohen 1988).
CONFUSED = 0.1
#: Truth and answer where nothing is missing.
NONE = "none"


@dataclass(frozen=True)
class Option:
    """A way in which an argument can join the rows.

    factors : (q, q) each, from unit unknowns to columns, one for every bend; scales : all are tried
    price : ln by which it is less probable than the sum over factors and scales
    """

    unknowns: tuple[Unknown, ...]
    factors: tuple[np.ndarray, ...]
    scales: tuple[float, ...]
    price: float


def options_of(variants: Sequence[Unknown], runs: int) -> list[Option]:
    """Every variant of an argument, over scales and bends as `Rung.offered` has them."""
    found, weights = [], sum(unknown.weight for unknown in variants)
    for unknown in variants:
        factors = tuple(factors_of(unknown, runs))
        price = float(np.log(weights / unknown.weight * len(factors) * len(SCALES_ASKED)))
        found.append(Option((unknown,), factors, SCALES_ASKED, price + price_of(unknown.name)))
    return found


def option_of_wave(
    added: Sequence[Added], system: System, scales: tuple[float, ...] = (1.0,)
) -> Option:
    """A wave at its wave length alone, with the price of the scan that finds it."""
    factor = block_diag(*(factor_of(each, len(system.fitted)) for each in added))
    price = periodic.price_of(added[0].unknown.wave, system.fitted)
    price += price_of(added[0].unknown.name)
    return Option(tuple(each.unknown for each in added), (factor,), scales, price)


@dataclass(frozen=True)
class Offers:
    """What c campaigns are offered, ln evidence beyond that of the rows without it.

    evidence : (n, c) averaged over variants, scales and bends; gain : (n, c) at the best of these
    """

    names: tuple[str, ...]
    evidence: np.ndarray
    gain: np.ndarray

    @property
    def near(self) -> np.ndarray:
        """(n, c) whether it is named, or as probable as what is named within `ALIKE`."""
        named = np.take_along_axis(self.gain, self.evidence.argmax(axis=0)[None], axis=0)
        alike = self.evidence > self.evidence.max(axis=0) - ALIKE
        return np.asarray(alike & (named > LEAST_GAIN))

    def answers(self) -> list[tuple[str, ...]]:
        """(c) what is named, the most probable first; () where nothing is missed."""
        order, near = np.argsort(-self.evidence, axis=0), self.near
        return [
            tuple(self.names[i] for i in order[:, c] if near[i, c]) for c in range(near.shape[1])
        ]


class Decision:
    """The first step of the ladder beyond a rung, for many campaigns of one design at once."""

    def __init__(self, rung: Rung, options: Mapping[str, Sequence[Option]]):
        self.system, self.base = rung.system, [each.unknown for each in rung.unknowns]
        self.whitens, self.weights = rung.whitens, rung.weights
        self.options = {
            name: [(rung.beside(one.unknowns, one.factors, one.scales), one.price) for one in some]
            for name, some in options.items()
        }

    def projected(self, rows: np.ndarray) -> list[np.ndarray]:
        """X'z (q, c) of the base and of every option; all that a decision needs to know of z."""
        options = [one.unknowns for some in self.options.values() for one, _ in some]
        return [
            np.concatenate([self.system.columns(each).T @ rows for each in unknowns])
            for unknowns in (self.base, *options)
        ]

    def decided(self, projected: Sequence[np.ndarray]) -> Offers:
        """Of what `projected` makes of rows; it is linear in them."""
        first, *others = projected
        w = self.whitens @ first
        base = 0.5 * np.sum(w**2, axis=1) + self.weights[:, None]
        without, rights = np.logaddexp.reduce(base, axis=0), iter(others)
        evidence, gain = [], []
        for options in self.options.values():
            values = [option.offered(next(rights), w, base) for option, _ in options]
            sums = np.array([np.logaddexp.reduce(each, axis=0) for each in values])
            most = np.array([each.max(axis=0) for each in values])
            prices = np.array([price for _, price in options])[:, None]
            best = np.argmax(sums - prices, axis=0)
            evidence.append(np.logaddexp.reduce(sums - prices, axis=0) - without)
            gain.append(np.take_along_axis(most, best[None], axis=0)[0] - without)
        return Offers(tuple(self.options), np.array(evidence), np.array(gain))


def added_rows(rung: Rung) -> np.ndarray:
    """(rows,) of what is added on a rung, as large as its rows have it."""
    rows, mean = np.zeros(rung.system.rows.size), rung.posterior[0]
    for each in rung.added:
        rows += rung.system.columns(each.unknown) @ mean[rung.part_of(each)]
    return rows


def drawn(
    rung: Rung, count: int, random: np.random.Generator, scatter: float, zeros: float
) -> np.ndarray:
    """(rows, c) of noise and of the rig's own numbers as their priors have them.

    scatter : of friction from run to run; zeros : spread of the tracker's, part of what is stated.
    Coefficients stay where they are: they are free, and no decision depends on them.
    """
    system, spreads = rung.system, {SCATTER: scatter, ZERO_NAME: zeros, MU_K: 0.0, MU_S: 0.0}
    rows = random.standard_normal((system.rows.size, count))
    for each in rung.base:
        factor = spreads.get(each.unknown.name, 1.0) * factor_of(each, len(system.fitted))
        sizes = random.standard_normal((len(factor), count))
        rows += system.columns(each.unknown) @ (factor @ sizes)
    return rows


def rates_of(
    ladder: Ladder, unknowns: Mapping[str, Sequence[Unknown]], each: int = EACH, seed: int = 0
) -> Rates:
    """What this design would say of every finding, of what might stand in its place, of nothing.

    unknowns : of `Arguments`. Each finding is asked beside the others; the same seed draws the same
    campaigns. Names are those of the ladder (`by_direction`).
    """
    table: dict[str, dict[str, int]] = {}
    random = np.random.default_rng(seed)
    for finding in ladder.findings or (None,):
        rest = [more for other in ladder.findings if other is not finding for more in other.added]
        rung = ladder.system.rung(rest)
        truths = _truths(ladder, unknowns, finding, rung)
        decision = Decision(rung, _asked(ladder, unknowns, finding))
        scatter, zeros = Scatter.of(ladder.rung).expected[0], rung.settings[0][rung.best][1]
        rows = drawn(rung, each * len(truths), random, scatter, zeros)
        for place, (_, there) in enumerate(truths):
            rows[:, place * each : (place + 1) * each] += there[:, None]
        answers = decision.decided(decision.projected(rows)).answers()
        for place, (truth, _) in enumerate(truths):
            table.setdefault(truth, counted(answers[place * each : (place + 1) * each]))
    known = {finding.name for finding in ladder.findings} | set(ladder.first_offers)
    return by_direction(Rates(each, table), known)


def _truths(
    ladder: Ladder, unknowns: Mapping[str, Sequence[Unknown]], finding: Finding | None, rung: Rung
) -> list[tuple[str, np.ndarray]]:
    """The finding, what might stand in its place, and neither: names, and rows (rows,) of each."""
    nothing = (NONE, added_rows(rung))
    if finding is None:
        return [nothing]
    found = [(finding.name, added_rows(rung.system.rung([*finding.added, *rung.added])))]
    # a wave that offered nothing at first is not asked, and has no place to stand at
    near = [name for name in finding.others if name in unknowns or name in ladder.first_offers]
    for name in sorted(near, key=lambda name: -finding.others[name])[:RUNNERS_UP]:
        offer = unknowns.get(name)
        added = [rung.offered(offer)[1]] if offer else ladder.first_offers[name][1]
        found.append((name, added_rows(rung.system.rung([*added, *rung.added]))))
    return [*found, nothing]


def _asked(
    ladder: Ladder, unknowns: Mapping[str, Sequence[Unknown]], finding: Finding | None
) -> dict[str, list[Option]]:
    """All arguments but those that are there already, and the waves that were found."""
    system = ladder.system
    there = {other.name for other in ladder.findings if other is not finding}
    asked = {name: options_of(variants, len(system.fitted))
             for name, variants in unknowns.items() if name not in there}  # fmt: skip
    waves = {name: offer[1] for name, offer in ladder.first_offers.items()}
    if finding is not None:
        waves[finding.name] = finding.added
    for name, added in waves.items():
        if name not in there and added[0].unknown.wave is not None:
            asked[name] = [option_of_wave(added, system)]
    return asked


def counted(answers: Sequence[tuple[str, ...]]) -> dict[str, int]:
    """answer -> how often; "class: a, b" where several are alike, in the order of their names."""
    return dict(Counter(map(answer_text, answers)).most_common())


def answer_text(names: Sequence[str]) -> str:
    """`class: a, b` of several, in the order of their names; `NONE` of none."""
    return f"class: {', '.join(sorted(names))}" if len(names) > 1 else (*names, NONE)[0]


def by_direction(rates: Rates, known: Collection[str]) -> Rates:
    """The table with friction over the sliding speed under the one name that the ladder has for it.

    It is named by its direction (`ladder.Search`), and a draw of noise may turn that.
    """
    pairs = zip(BY_SPEED, reversed(BY_SPEED), strict=True)
    names = {one: other for one, other in pairs if one not in known and other in known}
    table = {}
    for truth, row in rates.table.items():
        merged: Counter[str] = Counter()
        for answer, count in row.items():
            near = {names.get(one, one) for one in answer.removeprefix("class: ").split(", ")}
            merged[answer_text(list(near))] += count
        table[truth] = dict(merged.most_common())
    return Rates(rates.each, table)


def confirmed(rates: Rates, name: str, level: float = CONFUSED) -> tuple[str, ...]:
    """A name, and what would have been given that name too often: a class where it is not alone."""
    taken = [
        truth for truth, answers in rates.table.items()
        if truth not in (name, NONE) and answers.get(name, 0) > level * rates.each
    ]  # fmt: skip
    return (name, *taken)
