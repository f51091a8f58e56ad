"""Findings of the rows that the simulated runs do without."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from cosim.gap import judge
from cosim.gap.extended import Part, rounding_of
from cosim.gap.fitting import Fitting
from cosim.gap.naming import Named
from cosim.gap.result import Rejected
from cosim.gap.weak_form.ladder import TRENDS, price_of


def unsure(fitting: Fitting, named: Named) -> list[Rejected]:
    """Beside coarse steps, whose errors go together from sample to sample, what is not sure."""
    if rounding_of(fitting.campaign) is None:
        return []
    return [Rejected(one.name, one.gain, None)
            for one in named.findings if one.added and one.gain < judge.SURE]  # fmt: skip


def plainly_needed(
    fitting: Fitting, parts: Sequence[Part], named: Named, asked: Collection[str]
) -> set[str]:
    """Of findings asked for those that explain the runs, which miss plainly more without them.

    Not of what friction that scatters from run to run would take up: it has not been let yet.
    """
    needed = set()
    for part in parts:
        if part.finding.name in asked and part.in_kernel and part.finding.name not in TRENDS:
            left = fitting.without(part, parts, named, scatters=False).unscattered
            if judge.leaves(left, judge.PLAIN) and judge.explains_half(
                fitting.fitted(named, parts, scatters=False).unscattered, left
            ):
                needed.add(part.finding.name)
    return needed


def unpromising(
    fitting: Fitting, parts: Sequence[Part], named: Named, asked: Collection[str]
) -> list[Rejected]:
    """Findings asked for of which simulated runs ask for nothing that contact and scatter explain.

    Their derivatives tell (`ScoreTest`): no model is fitted with a finding.
    """
    asked_for = [part for part in parts if part.finding.name in asked and part.in_kernel]
    if not asked_for:
        return []
    without = fitting.fitted(named, [])
    if judge.leaves(without.ladder[-1].gap):
        return []
    promised = zip(asked_for, without.promised(asked_for), strict=True)
    return [Rejected(part.finding.name, part.finding.gain, gain) for part, gain in promised
            if judge.promise_nothing(gain, part.finding.name)]  # fmt: skip


def outdone(
    fitting: Fitting, parts: Sequence[Part], named: Named, asked: Collection[str]
) -> list[Rejected]:
    """Of several lesser findings those asked for, where the greatest explains the runs alone.

    One by one they would all go (see `rejected`), each after fits of its own; not so where
    simulated runs are sure of one.
    """
    greatest = _greatest(parts)
    lesser = [part for part in parts if part is not greatest and part.finding.name in asked]
    if greatest is None or len(lesser) < 2 or any(p.finding.gain >= judge.SURE for p in lesser):
        return []
    alone = fitting.fitted(named, [greatest], is_shown=False, scatters=False)
    if alone.unscattered.of_verdict > judge.EXPLAINED:
        return []
    alone.let_scatter()
    gained = [alone.gained(part) if part.in_kernel else None for part in lesser]
    if any(gain is not None and gain >= judge.SURE for gain in gained):
        return []
    return [Rejected(part.finding.name, part.finding.gain, gain)
            for part, gain in zip(lesser, gained, strict=True)]  # fmt: skip


def lost(
    fitting: Fitting, parts: Sequence[Part], named: Named, asked: Collection[str]
) -> Rejected | None:
    """The greatest finding, where simulated runs are much worse with it alone, and ask for it
    by no more than e^30 beside contact and scatter: nothing is built upon it."""
    greatest = _greatest(parts)
    if greatest is None or greatest.finding.name not in asked or not greatest.in_kernel:
        return None
    alone = fitting.fitted(named, [greatest], is_shown=False, scatters=False)
    without = fitting.fitted(named, [], is_shown=False, scatters=False)
    if not alone.is_lost_beside(without):
        return None
    without.let_scatter()
    gained, _ = fitting.gained(greatest, without, named)
    if judge.much_more(gained - price_of(greatest.finding.name)):
        return None
    return Rejected(greatest.finding.name, greatest.finding.gain, gained)


def rejected(
    fitting: Fitting, parts: Sequence[Part], named: Named, asked: Collection[str]
) -> Rejected | None:
    """The least of the findings asked for that the simulated runs do without.

    The least first: what a greater one leaves may pretend a small one, and with it gone the
    greater one is seldom in doubt; but before it those that the model has not, beside which
    simulated runs tell nothing. What a finding takes of the gap is asked only where the runs
    ask for all of them: beside one that is none, no other does well.
    """
    least_first = sorted(parts, key=lambda part: (part.in_kernel, part.finding.gain))
    for is_needed in (_is_asked_for, _makes_up):
        for part in least_first:
            if part.finding.name in asked and not is_needed(fitting, part, parts, named):
                without = fitting.without(part, parts, named)
                gained = fitting.gained(part, without, named)[0] if part.in_kernel else None
                return Rejected(part.finding.name, part.finding.gain, gained)
    return None


def _is_asked_for(fitting: Fitting, part: Part, parts: Sequence[Part], named: Named) -> bool:
    """Whether the simulated runs are more probable with a finding beside the others.

    A lesser one below e^500, in rows and runs, is no more than what a law leaves that is not
    quite the greater one's, where the others explain the runs and friction need not scatter.
    """
    without = fitting.without(part, parts, named)
    is_lesser = part.finding.gain < max(other.finding.gain for other in parts)
    gained, form = fitting.gained(part, without, named) if part.in_kernel else (0.0, part)
    is_sure = max(part.finding.gain, gained) >= judge.SURE
    if is_lesser and not is_sure and without.unscattered.of_verdict <= judge.EXPLAINED:
        return False
    if not part.in_kernel:
        return judge.leaves(
            without.ladder[-1].gap, judge.EXPLAINED if is_lesser else judge.NOTHING_MISSING
        )
    name = part.finding.name
    return judge.runs_ask(gained - price_of(name)) and judge.not_by_scatter_alone(
        name, gained, without.nearer(form)
    )


def _makes_up(fitting: Fitting, part: Part, parts: Sequence[Part], named: Named) -> bool:
    """Whether it takes what is missing without it, or half of that; or half before scatter.

    What makes the runs e^500 times as probable is a part of what is missing, also where the
    contact or a friction that may scatter from run to run have taken it up; a trend over the
    runs beside a greater one, which scatter takes up, where it makes them e^12 times as so.
    """
    without = fitting.without(part, parts, named)
    is_missed = judge.leaves(before := without.ladder[-1].gap)
    if not part.in_kernel:
        return True
    found = fitting.fitted(named, parts)
    if found.is_lost:
        return False
    is_lone, gained = len(parts) == 1, without.gained(part)
    if judge.needs_no_misfit(part.finding.name, gained, is_lone) or (is_lone and not is_missed):
        return True
    after = found.ladder[-1].gap
    if is_missed and (not judge.leaves(after) or judge.halves(after, before)):
        return True
    left = without.unscattered
    return judge.leaves(left) and judge.halves(found.unscattered, left)


def _greatest(parts: Sequence[Part]) -> Part | None:
    """The finding that the rows ask for most."""
    return max(parts, key=lambda part: part.finding.gain, default=None)
