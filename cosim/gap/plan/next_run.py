"""The next best run: which one more run tells two explanations apart.

What is true is put into the rows of the runs that there are and of one more, simulated without it,
and both explanations are asked for, as in `cosim.gap.rates`. The same search serves a plan and a
class that was found.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from cosim.gap.data import Campaign, MeasuredRun
from cosim.gap.data.errors import CampaignError
from cosim.gap.plan.planned import PlannedRun, rows_of_run, simulated
from cosim.gap.rates import Decision, Truth, drawn, options_of, scatter_of
from cosim.gap.weak_form.arguments import Arguments
from cosim.gap.weak_form.ladder import Ladder
from cosim.gap.weak_form.system import Added, System
from cosim.gap.weak_form.unknowns import Unknown

#: Beyond the campaign's own settings, where no limits are stated, by this factor.
BEYOND = 3.0
#: Campaigns that are drawn of every truth and run.
DRAWS = 40
#: Runs this near to the best, in separation, are as good: then the one that changes the rig least.
NEARLY = 0.9
#: How well a law is followed by the unknown of a longer campaign, parts of the noise.
FOLLOWED = 0.03
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
        return (
            f"one more run with {self.mass:.4g} kg, springs of {self.stiffness:.4g} N/m and the "
            f"surface at {self.surface_speed:.3g} m/s for {self.duration:.3g} s tells "
            f"{' from '.join(self.effects)} by a ln Bayes factor of {self.separation:.2g}, "
            f"which is {self.separation_before:.2g} without it"
        )

    def as_data(self) -> dict[str, Any]:
        """As `Gap.next_experiment` and `plan.json` have it."""
        return {**asdict(self), "text": self.text}


def next_experiment(
    ladder: Ladder, unknowns: Mapping[str, Sequence[Unknown]], members: Sequence[str]
) -> dict[str, Any] | None:
    """The run that would separate a class that was found, each member as large as the rows have it.

    unknowns : of `Arguments`. None where no run within the limits does.
    """
    system = ladder.system
    rung, level = system.rung(), system.level
    truths = [
        Truth.of(name, system.rung([rung.offered(unknowns[name])[1]]))
        for name in members if name in unknowns
    ]  # fmt: skip
    if len(truths) < 2:
        return None
    friction = {"mu_s": max(level.static, level.kinetic), "mu_k": level.kinetic}
    found = best_next_run(system, truths, friction, scatter_of(ladder.rung))
    return None if found is None else found.as_data()


def best_next_run(
    system: System, truths: Sequence[Truth], friction: Mapping[str, float], scatter: float,
    progress: Callable[[], object] = lambda: None,
) -> NextRun | None:  # fmt: skip
    """The run that sets the nearest two of several explanations farthest apart; None: none can.

    truths : of one unknown each, as large as they are; friction : mu_s, mu_k
    """
    campaign = system.campaign
    before = _separation(system, truths, scatter, len(system.runs))
    found = []
    for option in options(campaign):
        progress()
        more = _with(system, option, friction)
        if more is not None:
            separation = _separation(more, truths, scatter, len(system.runs))
            found.append((separation, option))
    best = max((separation for separation, _ in found), default=before)
    if best <= before:
        return None
    near = [pair for pair in found if pair[0] >= NEARLY * best]
    separation, option = min(near, key=lambda pair: _changed(campaign, pair[1].setting))
    run = option.setting
    return NextRun(
        run.surface_speed, run.mass, run.stiffness, option.duration,
        tuple(truth.name for truth in truths), separation, before,
    )  # fmt: skip


def options(campaign: Campaign) -> list[PlannedRun]:
    """At most 11 runs: three speeds; of two other masses, and springs, the slowest and the fastest.

    Within what the rig can do, or else a factor beyond what it has done.
    """
    runs = [run for run in campaign.runs if run.track is not None]
    used = {key: sorted(abs(getattr(run, key)) for run in runs) for key in SETTINGS}
    middle = {key: values[len(values) // 2] for key, values in used.items()}
    ends = {
        key: campaign.limits.get(key, (values[0] / BEYOND, values[-1] * BEYOND))
        for key, values in used.items()
    }
    middle = {key: float(np.clip(value, *ends[key])) for key, value in middle.items()}
    slow, fast = ends["surface_speed"]
    settings = [middle | {"surface_speed": v} for v in (slow, float(np.sqrt(slow * fast)), fast)]
    settings += [
        middle | {"surface_speed": v, key: value}
        for key in ("mass", "stiffness") for value in ends[key] for v in (slow, fast)
    ]  # fmt: skip
    longest = sorted(runs, key=lambda run: run.motion.duration)[len(runs) // 2]
    sign = float(np.sign(sum(run.surface_speed for run in runs))) or 1.0
    found = []
    for one in dict.fromkeys(tuple(float(f"{s[key]:.3g}") for key in SETTINGS) for s in settings):
        speed, mass, stiffness = one
        setting = replace(
            longest, name="next", mass=mass, stiffness=stiffness, surface_speed=sign * speed,
            track=None, hold_out=False,
        )  # fmt: skip
        interval = longest.motion.interval
        found.append(PlannedRun(setting, longest.motion.duration, 1.0 / interval))
    return found


def _changed(campaign: Campaign, run: MeasuredRun) -> int:
    """How many of mass and springs the campaign has not."""
    return sum(
        all(abs(getattr(run, key) / getattr(other, key) - 1.0) > 0.01 for other in campaign.runs)
        for key in ("mass", "stiffness")
    )


def _with(system: System, option: PlannedRun, friction: Mapping[str, float]) -> System | None:
    """The rows with those of one more run, which is the last; None where the rig cannot make it."""
    campaign = system.campaign
    try:
        run = simulated(campaign, option, friction, np.random.default_rng(0))
        rows = rows_of_run(campaign, run)
    except (CampaignError, ValueError, ArithmeticError, np.linalg.LinAlgError):
        return None
    if not len(rows):
        return None
    more = replace(campaign, runs=(*campaign.runs, run))
    return System(more, [*system.runs, rows], every=True)


def _separation(system: System, truths: Sequence[Truth], scatter: float, known: int) -> float:
    """Least, over pairs, of the middle ln evidence of what is true beyond that of the other.

    known : runs of the system in whose rows the truths are given
    """
    unknowns = Arguments(system.campaign, system.runs, system.level).unknowns()
    names = {truth.name for truth in truths}
    asked = {name: unknowns[name] for name in names if name in unknowns}
    if set(asked) != names:
        return 0.0
    runs = len(system.fitted)
    decision = Decision(system.rung(), {n: options_of(v, runs) for n, v in asked.items()})
    noise = drawn(system.rung(), DRAWS, np.random.default_rng(0), scatter, 1.0)
    nearest = np.inf
    for truth in truths:
        rows = noise + _followed(truth, asked[truth.name], system, known)[:, None]
        offers = decision.offers(rows)
        place = offers.names.index(truth.name)
        apart = offers.evidence[place] - np.delete(offers.evidence, place, axis=0)
        nearest = min(nearest, float(np.median(apart, axis=1).min()))
    return max(nearest, 0.0)


def _followed(truth: Truth, variants: Sequence[Unknown], system: System, known: int) -> np.ndarray:
    """(rows,) of a truth, its curve drawn anew over what all runs span, straight on beyond."""
    (old,), (sizes,) = truth.unknowns, truth.sizes
    first = system.fitted[:known]
    wanted = old.columns(first) @ sizes
    unknown = next((one for one in variants if one.variant == old.variant), variants[0])
    columns = system.columns(unknown)
    bend = 1.0 if unknown.bends is not None else 0.0
    factor = Added(unknown, max(float(np.max(np.abs(sizes))), 1e-6), bend).factor
    seen = columns[: wanted.size] @ factor / FOLLOWED
    unit = np.linalg.solve(seen.T @ seen + np.eye(factor.shape[0]), seen.T @ (wanted / FOLLOWED))
    return np.asarray(columns @ (factor @ unit))
