"""The next best run: which one more run tells two laws apart.

What is true is put into the rows of the runs that there are and of one more, simulated without it,
and both laws are asked for, as in `cosim.gap.plan.sizes`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from cosim.gap.data import Campaign
from cosim.gap.data.errors import CampaignError
from cosim.gap.plan.known import rows_of_run
from cosim.gap.plan.laws import Law, laws_of
from cosim.gap.plan.planned import PlannedRun, simulated
from cosim.gap.plan.sizes import Design
from cosim.gap.weak_form.arguments import Arguments
from cosim.gap.weak_form.constants import ALIKE
from cosim.gap.weak_form.ladder import Ladder
from cosim.gap.weak_form.system import System
from cosim.gap.weak_form.unknowns import Unknown
from cosim.report.page import number

#: Beyond the campaign's own settings, where no limits are stated, by this factor.
BEYOND = 3.0
#: Campaigns that are drawn of every law and run.
DRAWS = 40
#: Runs this near to the best, in separation, are as good: then the one that changes the rig least.
NEARLY = 0.9
#: ln of odds beyond which it does not matter by how much: a million to 1.
LARGEST = math.log(1e6)
#: Sizes among which a law's is looked for: a fifth apart.
SIZES = 50
SETTINGS = ("surface_speed", "mass", "stiffness")


@dataclass(frozen=True)
class NextRun:
    """A run to add.

    separation : ln of the Bayes factor between two of ``effects``, in the middle of the campaigns
    drawn, of the two that are nearest; separation_before : the same without the run
    """

    surface_speed: float
    mass: float
    stiffness: float
    duration: float
    effects: tuple[str, ...]
    separation: float
    separation_before: float

    @property
    def text(self) -> str:
        """In a sentence."""
        tells, enough = "tells", ""
        if self.separation < ALIKE:
            tells, enough = "hardly tells", f"; {_odds(ALIKE)} would tell"
        return (
            f"one more run with {self.mass:.4g} kg, springs of {self.stiffness:.4g} N/m and the "
            f"surface at {self.surface_speed:.3g} m/s for {self.duration:.3g} s {tells} "
            f"{' from '.join(self.effects)}: the odds for the true one are then "
            f"{_odds(self.separation)}, {_odds(self.separation_before)} without that run{enough}"
        )

    def as_data(self) -> dict[str, Any]:
        """As `plan.json` has it, and `Gap.next_experiment`."""
        return {**asdict(self), "text": self.text}


def _odds(separation: float) -> str:
    """`20 to 1`, of the ln of a Bayes factor."""
    if separation >= LARGEST:
        return "more than a million to 1"
    return f"{number(math.exp(separation), 2)} to 1"


def next_experiment(
    ladder: Ladder, unknowns: Mapping[str, Sequence[Unknown]], members: Sequence[str],
    scatter: float,
) -> dict[str, Any] | None:  # fmt: skip
    """The run that would separate a class, each member as large as the rows have it.

    unknowns : that were asked. None where no run within the limits does.
    """
    system, level = ladder.system, ladder.system.level
    asked = {name: unknowns[name] for name in members if name in unknowns}
    every = laws_of(system, asked)
    laws = (_as_found(system, [law for law in every if law.argument == name]) for name in asked)
    if len(sized := [pair for pair in laws if pair is not None]) < 2:
        return None
    friction = {"mu_s": max(level.static, level.kinetic), "mu_k": level.kinetic}
    found = best_next_run(system, sized, friction, scatter)
    return None if found is None else found.as_data()


def _as_found(system: System, laws: Sequence[Law]) -> tuple[Law, float] | None:
    """Of an argument's laws the one that is nearest to its curve, and its value there."""
    tried = []
    for law in laws:
        added = system.rung().offered([law.unknown])[1]
        rung = system.rung([added])
        curve = rung.posterior[0][rung.part_of(added)]
        for value in (law.value(away) for away in law.range * np.geomspace(1e-4, 1.0, SIZES)):
            tried.append((float(np.sum((law.sizes(value) - curve) ** 2)), law, value))
    return min(tried, key=lambda one: one[0])[1:] if tried else None


def best_next_run(
    system: System, laws: Sequence[tuple[Law, float]], friction: Mapping[str, float],
    scatter: float, progress: Callable[[], object] = lambda: None,
) -> NextRun | None:  # fmt: skip
    """The run that sets the nearest two of several laws farthest apart; None: none can.

    laws : each with the value of its size; friction : mu_s, mu_k
    """
    campaign, before = system.campaign, _separation(system, laws, scatter)
    found = []
    for option in options(campaign):
        progress()
        try:
            run = simulated(campaign, option, friction, np.random.default_rng(0))
            rows = [*system.runs, rows_of_run(campaign, run)]
            more = System(replace(campaign, runs=(*campaign.runs, run)), rows, every=True)
            found.append((_separation(more, laws, scatter), option))
        except (CampaignError, ValueError, ArithmeticError, np.linalg.LinAlgError):
            continue  # the rig cannot make it
    best = max((separation for separation, _ in found), default=before)
    if best <= before:
        return None
    near = [pair for pair in found if pair[0] >= NEARLY * best]
    separation, option = min(near, key=lambda pair: _changed(campaign, pair[1]))
    setting, names = option.setting, tuple(law.argument for law, _ in laws)
    return NextRun(setting.surface_speed, setting.mass, setting.stiffness, option.duration, names,
                   separation, before)  # fmt: skip


def options(campaign: Campaign) -> list[PlannedRun]:
    """At most 11 runs: three speeds; of two other masses, and springs, the slowest and the fastest.

    Within what the rig can do, or else a factor beyond what it has done.
    """
    runs = [run for run in campaign.runs if run.track is not None]
    used = {key: sorted(abs(getattr(run, key)) for run in runs) for key in SETTINGS}
    ends = {k: campaign.limits.get(k, (v[0] / BEYOND, v[-1] * BEYOND)) for k, v in used.items()}
    middle = {k: float(np.clip(v[len(v) // 2], *ends[k])) for k, v in used.items()}
    slow, fast = ends["surface_speed"]
    settings = [middle | {"surface_speed": v} for v in (slow, float(np.sqrt(slow * fast)), fast)]
    settings += [
        middle | {"surface_speed": v, key: value}
        for key in ("mass", "stiffness") for value in ends[key] for v in (slow, fast)
    ]  # fmt: skip
    longest = sorted(runs, key=lambda run: run.motion.duration)[len(runs) // 2]
    sign = float(np.sign(sum(run.surface_speed for run in runs))) or 1.0
    rounded = [tuple(float(f"{one[key]:.3g}") for key in SETTINGS) for one in settings]
    return [
        PlannedRun(
            replace(longest, name="next", surface_speed=sign * speed, mass=mass,
                    stiffness=stiffness, track=None, hold_out=False),
            longest.motion.duration, 1.0 / longest.motion.interval,
        )
        for speed, mass, stiffness in dict.fromkeys(rounded)
    ]  # fmt: skip


def _changed(campaign: Campaign, option: PlannedRun) -> int:
    """How many of mass and springs the campaign has not."""
    return sum(
        all(abs(getattr(option.setting, key) / getattr(run, key) - 1.0) > 0.01
            for run in campaign.runs)
        for key in ("mass", "stiffness")
    )  # fmt: skip


def _separation(system: System, laws: Sequence[tuple[Law, float]], scatter: float) -> float:
    """Least, over pairs, of the middle ln evidence of what is true beyond that of the other."""
    unknowns = Arguments(system.campaign, system.runs, system.level).unknowns()
    asked = {law.argument: unknowns[law.argument] for law, _ in laws if law.argument in unknowns}
    every = laws_of(system, asked)
    here = [same for law, _ in laws if (same := law.among(every)) is not None]
    if len(here) < len(laws):
        return 0.0
    design, nearest = Design(system, asked, here, scatter, draws=DRAWS), np.inf
    for index, (law, value) in enumerate(laws):
        offers = design.offers(index, abs(value - law.neutral))
        place = offers.names.index(law.argument)
        apart = offers.evidence[place] - np.delete(offers.evidence, place, axis=0)
        nearest = min(nearest, float(np.median(apart, axis=1).min()))
    return max(nearest, 0.0)
