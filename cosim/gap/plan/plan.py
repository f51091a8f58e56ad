"""What a planned campaign could name: sizes, pairs that it cannot tell apart, the next best run."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from itertools import count
from pathlib import Path
from typing import Any

import numpy as np

from cosim.files import write_text
from cosim.gap.data.errors import CampaignError
from cosim.gap.plan.laws import Law, laws_of, silent
from cosim.gap.plan.next_run import NextRun, best_next_run
from cosim.gap.plan.planned import PlannedCampaign, as_measured, asked_as_planned
from cosim.gap.plan.sizes import Design, Size, false_names, sizes_of
from cosim.result import Result

#: What shows an answer; loaded when asked for.
DATA, PAGE = "cosim.gap.plan.data", "cosim.gap.plan.page"
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


@dataclass(frozen=True, repr=False)
class Plan(Result):
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
    silent: Mapping[str, str]
    false: float
    next_run: NextRun | None

    def __repr__(self) -> str:
        return f"<Plan: {import_module(DATA).sentence(self)}>"

    def summary(self) -> dict[str, Any]:
        """What `plan.json` holds."""
        return dict(import_module(DATA).as_data(self))

    def _answer(self) -> tuple[str, Sequence[tuple[str, str]]]:
        return import_module(DATA).sentence(self), import_module(PAGE).tiles(self)

    def _page(self) -> str:
        return str(import_module(PAGE).page_text(self))

    def _write(self, folder: Path) -> None:
        json_text = import_module("cosim.report.files").json_text
        write_text(json_text(self.summary()), folder / "plan.json")
        import_module(PAGE).write_page(self, folder, folder / "report.html")

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
    campaign = as_measured(planned, seed)
    system, unknowns = asked_as_planned(campaign)
    laws, scatter = laws_of(system, unknowns), campaign.errors.friction
    total, steps = 1 + TRIED + 2 * len(laws), count(1)

    def step() -> None:
        progress(min(next(steps), total - 1), total)

    step()
    sizes = sizes_of(design := Design(system, unknowns, laws, scatter, seed=seed), wanted, step)
    pair = _worst_pair(sizes)
    sizes = [_settled(planned, size, wanted, seed, step) for size in sizes]
    next_run = best_next_run(system, pair, planned.friction, scatter, step) if pair else None
    progress(total, total)
    not_told = silent(laws, campaign.catalogue.effects)
    return Plan(planned, wanted, tuple(sizes), not_told, false_names(design), next_run)


def _settled(
    planned: PlannedCampaign, size: Size, wanted: float, seed: int, step: Callable[[], object]
) -> Size:
    """A size beside which the motion is the effect's own: drag ends sticks, and is seen sooner.

    The campaign is simulated with it until the chance is the wanted one; a wave changes little.
    """
    step()
    law = size.law
    if size.value is None or law.wave is not None:
        return size
    away, low, high = abs(size.value - law.neutral), 0.0, np.inf
    alone = np.inf if size.alone is None else abs(size.alone - law.neutral)
    for _ in range(ROUNDS):
        try:
            measured = as_measured(planned, seed, law.blocks(law.value(away)))
            system, unknowns = asked_as_planned(measured)
            same = law.among(laws_of(system, unknowns))
        except (CampaignError, ValueError, ArithmeticError):
            return size
        if same is None:
            return size
        design = Design(system, unknowns, [same], planned.campaign.errors.friction, seed=seed)
        size = design.size(0, away, alone)
        if abs(size.power - wanted) < NEAR:
            break
        low, high = (away, high) if size.power < wanted else (low, away)
        if low and np.isfinite(high):
            away = float(np.sqrt(low * high))
        else:
            away *= LEAP if size.power < wanted else 1.0 / LEAP
    return size


def _worst_pair(sizes: list[Size]) -> list[tuple[Law, float]]:
    """The two effects that are most often taken for one another, each at its smallest size."""
    curves = {size.law.argument: size for size in sizes
              if size.value is not None and size.law.wave is None}  # fmt: skip
    pairs = [
        (share, [size, curves[other]])
        for size in curves.values() for other, share in size.shares.items() if other in curves
    ]  # fmt: skip
    _, worst = max(pairs, key=lambda pair: pair[0], default=(0.0, []))
    return [(size.law, size.value or 0.0) for size in worst]
