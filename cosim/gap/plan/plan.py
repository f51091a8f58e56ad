"""What a planned campaign could name: sizes, pairs that it cannot tell apart, the next best run."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

from cosim.gap.data.errors import CampaignError
from cosim.gap.plan.laws import Law, laws_of, silent
from cosim.gap.plan.next_run import NextRun, best_next_run
from cosim.gap.plan.planned import PlannedCampaign, as_measured, asked_of
from cosim.gap.plan.sizes import HALVINGS, Design, Size, false_names, size_at, sizes_of
from cosim.gap.rates import Truth

#: Chance that what is there is named: the usual one of a test (Cohen 1988).
WANTED = 0.8
#: Two effects are a pair where one is named beside the other, or for it, in more than this part of
#: the campaigns: a reader of twenty answers would be misled by two.
MISTAKEN = 0.1
#: Runs that may be tried as the next one.
TRIED = 11
#: Simulations with an effect until it is named as often as wanted, within so much; and by what
#: factor its size is changed while only one side is known.
ROUNDS, NEAR, LEAP = 4, 0.07, 1.25
#: Rows, sizes of both kinds, runs.
STEPS = 1 + 2 * (HALVINGS + 1) + TRIED


@dataclass(frozen=True)
class Plan:
    """The answer.

    Attributes
    ----------
    planned : the campaign
    wanted : chance to name what is there
    sizes : smallest size of every effect in each direction
    silent : effect -> why it has none
    false : part of the campaigns without any effect in which something is named
    next_run : tells the worst pair apart; None: no run does, or no pair is
    """

    planned: PlannedCampaign
    wanted: float
    sizes: tuple[Size, ...]
    silent: Mapping[str, str] = field(repr=False)
    false: float
    next_run: NextRun | None

    @property
    def pairs(self) -> list[tuple[str, str, float]]:
        """(truth, what it might be taken for, part of the campaigns), the worst first."""
        found: dict[tuple[str, str], float] = {}
        for size in self.sizes:
            for other, share in size.shares.items():
                if share > MISTAKEN:
                    pair = (size.law.argument, other)
                    found[pair] = max(found.get(pair, 0.0), share)
        return sorted(((*pair, share) for pair, share in found.items()), key=lambda one: -one[2])


def make_plan(
    planned: PlannedCampaign, *, wanted: float = WANTED, seed: int = 0,
    progress: Callable[[int, int], object] = lambda done, total: None,
) -> Plan:  # fmt: skip
    """The answer for a planned campaign; the same seed gives the same.

    progress : called with the steps done and all
    """
    done, total = 0, STEPS

    def step() -> None:
        nonlocal done
        done = min(done + 1, total - 1)
        progress(done, total)

    campaign = as_measured(planned, seed)
    system, unknowns = asked_of(campaign)
    laws = laws_of(system, unknowns)
    scatter, total = campaign.errors.friction, STEPS + len(laws)
    step()
    sizes = sizes_of(design := Design(system, unknowns, laws, scatter, seed=seed), wanted, step)
    pair = _worst_pair(sizes)
    sizes = [_settled(planned, size, wanted, seed, step) for size in sizes]
    next_run = best_next_run(system, pair, planned.friction, scatter, step) if pair else None
    progress(total, total)
    return Plan(planned, wanted, tuple(sizes), silent(laws), false_names(design), next_run)


def _settled(
    planned: PlannedCampaign, size: Size, wanted: float, seed: int, step: Callable[[], object]
) -> Size:
    """A size beside which the motion is the effect's own: drag ends sticks, and is seen sooner.

    The campaign is simulated with it until the chance is the wanted one; a wave changes little.
    """
    step()
    if size.value is None or size.law.wave is not None:
        return size
    away, low, high = abs(size.value - size.law.neutral), 0.0, np.inf
    for _ in range(ROUNDS):
        try:
            measured = as_measured(planned, seed, size.law.blocks(size.law.value(away)))
            system, unknowns = asked_of(measured)
        except (CampaignError, ValueError, ArithmeticError):
            return size
        same = [law for law in laws_of(system, unknowns)
                if law.key == size.law.key and law.value(1.0) == size.law.value(1.0)]  # fmt: skip
        if not same:
            return size
        design = Design(system, unknowns, same[:1], planned.campaign.errors.friction, seed=seed)
        size = size_at(design, away, size.alone)
        power = size.power
        if abs(power - wanted) < NEAR:
            break
        low, high = (away, high) if power < wanted else (low, away)
        if low and np.isfinite(high):
            away = float(np.sqrt(low * high))
        else:
            away *= LEAP if power < wanted else 1.0 / LEAP
    return size


def _worst_pair(sizes: list[Size]) -> list[Truth]:
    """The two effects that are most often taken for one another, each at its smallest size."""
    curves = {size.law.argument: size for size in sizes
              if size.value is not None and size.law.wave is None}  # fmt: skip
    shares = {
        (one, other): size.shares.get(other, 0.0)
        for one, size in curves.items() for other in curves if other != one
    }  # fmt: skip
    if not shares or max(shares.values()) == 0.0:
        return []
    return [
        _truth(curves[one].law, curves[one].value) for one in max(shares, key=shares.__getitem__)
    ]


def _truth(law: Law, value: float | None) -> Truth:
    assert value is not None
    return Truth(law.argument, (law.unknown,), (np.asarray(law.sizes(value)),))
