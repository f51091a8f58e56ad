"""The next best run to add to a planned campaign: on a grid of what its rig can do.

Information adds up from run to run: the products of the derivatives and of the laws' responses, a
run's own numbers and states eliminated, are summed over the campaign's runs, and those of one more
run are added (D-optimal design's usual device, here for each effect by itself). All is linear; the
size that was found with everything refitted is changed in proportion.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from itertools import product

import numpy as np

from cosim.gap.data.errors import CampaignError
from cosim.gap.design.range import SPEED_FACTOR, SPEEDS
from cosim.gap.design.rehearsal import FARTHEST
from cosim.gap.estimation.fitted import shared_of

from . import power
from .law import Law, bent, residuals, turned
from .linear import RANK, Nuisance, beyond
from .pairs import Mistaken
from .planned import PlannedCampaign, PlannedRun, Rehearsal, rehearse_run
from .visibility import FAINT, Visible, friction_length

#: Times the campaign's middle mass, stiffness and duration that a next run may have.
MASSES = STIFFNESSES = (0.5, 1.0, 2.0)
DURATIONS = (1.0, 2.0)
#: Sizes this near to one another are the same for whoever plans: then the run is taken that needs
#: no other mass or spring, and of these the shorter.
_NEARLY = 1.1
#: Instead of nothing, where a number is divided by.
_NONE = 1e-300


@dataclass(frozen=True)
class Option:
    """A run that could be added.

    Attributes
    ----------
    run : its setting, duration, rate
    changed : how many of mass and stiffness the campaign has not
    """

    run: PlannedRun
    changed: int


@dataclass(frozen=True)
class NextRun:
    """A run to add, and what it changes.

    Attributes
    ----------
    aim : what it is the best for
    mass, stiffness, surface_speed, duration : kg, N/m (one spring), m/s, s
    changed : how many of mass and stiffness the campaign has not
    effects : the one that is hardest to see, or the pair that is hardest to tell apart
    before, after : its smallest size as percent of friction; of a pair, the times of the first's
        smallest size at which it is told from the second
    """

    aim: str
    mass: float
    stiffness: float
    surface_speed: float
    duration: float
    changed: int
    effects: tuple[str, ...]
    before: float
    after: float


@dataclass(frozen=True)
class Information:
    """What runs tell, linear: sums over runs.

    Attributes
    ----------
    raw : (1 + l,) squared lengths of the responses to one percent more friction and to l effects,
        each at its start, free parameters and states held
    sizes : (g + l, g + l) products of the free parameters' columns and of the effects' responses
    pairs : of each law that the truth might be taken for: (g + 2 + k, g + 2 + k) products of the
        free parameters' columns, the truth's response, the law's and those of its shapes; what
        runs have of their own in that law is eliminated
    """

    raw: np.ndarray
    sizes: np.ndarray
    pairs: tuple[np.ndarray, ...]

    def __add__(self, other: Information) -> Information:
        pairs = tuple(a + b for a, b in zip(self.pairs, other.pairs, strict=True))
        return Information(self.raw + other.raw, self.sizes + other.sizes, pairs)

    @property
    def percent(self) -> np.ndarray:
        """(l,) each effect at its start as percent of friction."""
        return np.sqrt(self.raw[1:] / self.raw[0])

    def visibility(self, free: int) -> np.ndarray:
        """(l,) squared length of what is left of each effect at its start; ``free``: g."""
        return np.diag(_left(self.sizes, free)).clip(0.0)

    def apart(self, free: int) -> float:
        """Squared length of what the nearest of the laws leaves of the truth at its start."""
        nearest = np.inf
        for matrix in self.pairs:
            values, vectors = np.linalg.eigh(_left(matrix, free))
            columns = np.sqrt(values.clip(0.0))[:, None] * vectors.T
            nearest = min(nearest, beyond(columns[:, 0], columns[:, 1], columns[:, 2:]))
        return nearest


def _left(matrix: np.ndarray, free: int) -> np.ndarray:
    """Schur complement of the first ``free`` rows and columns."""
    first, across = matrix[:free, :free], matrix[:free, free:]
    return matrix[free:, free:] - across.T @ np.linalg.lstsq(first, across, rcond=1e-12)[0]


def options(plan: PlannedCampaign) -> list[Option]:
    """The grid: speeds on a logarithmic scale beyond those of the campaign, the rest by factors."""
    runs = [run.setting for run in plan.runs]
    masses, springs = {run.mass for run in runs}, {run.stiffness for run in runs}
    speeds = np.array([run.surface_speed for run in runs])
    sign = -1.0 if np.sign(speeds).sum() < 0.0 else 1.0
    used = np.abs(speeds)
    grid = np.geomspace(used.min() / SPEED_FACTOR, used.max() * SPEED_FACTOR, SPEEDS)
    middle = sorted(plan.runs, key=lambda run: run.duration)[len(runs) // 2]
    mass, spring = _middle([run.mass for run in runs]), _middle([run.stiffness for run in runs])
    found = []
    for m, k, v, times in product(MASSES, STIFFNESSES, grid, DURATIONS):
        setting = replace(
            runs[0], name="next", mass=m * mass, stiffness=k * spring,
            surface_speed=sign * float(f"{v:.2g}"),
        )  # fmt: skip
        changed = (m * mass not in masses) + (k * spring not in springs)
        found.append(Option(PlannedRun(setting, times * middle.duration, middle.rate), changed))
    return found


def _middle(values: Sequence[float]) -> float:
    return sorted(values)[len(values) // 2]


def information(
    rehearsal: Rehearsal, effects: Sequence[Law], truth: Law | None, others: Sequence[Law]
) -> Information:
    """Of the runs of a rehearsal, without what is known beforehand."""
    responses = [_response(rehearsal, law) for law in effects]
    raw = np.array(
        [friction_length(rehearsal) ** 2, *[sum(r @ r for r in each) for each in responses]]
    )
    left = [
        c.left(np.column_stack([c.shared, *parts]))
        for c, *parts in zip(rehearsal.columns, *responses, strict=True)
    ]
    sizes = np.sum([each.T @ each for each in left], axis=0)
    if truth is None:
        return Information(raw, sizes, ())
    true = _response(rehearsal, truth)
    return Information(raw, sizes, tuple(_pair(rehearsal, true, law) for law in others))


def known(rehearsal: Rehearsal, count: int, shapes: Sequence[int]) -> Information:
    """What is known of the free parameters beforehand, as information of the same shape."""
    prior = np.diag(Nuisance(rehearsal).weight ** 2)
    return Information(
        np.zeros(1 + count),
        _padded(prior, count),
        tuple(_padded(prior, 2 + number) for number in shapes),
    )


def _padded(matrix: np.ndarray, more: int) -> np.ndarray:
    return np.pad(matrix, ((0, more), (0, more)))


def _faint(law: Law) -> float:
    return FAINT * min(1.0, law.most)


def _response(rehearsal: Rehearsal, law: Law) -> list[np.ndarray]:
    """Per run (rows,): to the law at its start, in proportion to a faint one."""
    return [rows / _faint(law) for rows in residuals(rehearsal, law, _faint(law))]


def _pair(rehearsal: Rehearsal, true: Sequence[np.ndarray], law: Law) -> np.ndarray:
    """Products of what runs leave of the truth and of a law that it might be taken for."""
    here, shapes = _response(rehearsal, law), bent(rehearsal, law, _faint(law))
    total = 0.0
    for i, phases in enumerate(turned(rehearsal, law, _faint(law))):
        columns = rehearsal.columns[i]
        stacked = [columns.shared, true[i], here[i], *[each[i] for each in shapes]]
        columns = replace(columns, own=np.column_stack([columns.own, phases]))
        left = columns.left(np.column_stack(stacked))
        total = total + left.T @ left
    return np.asarray(total)


@dataclass(frozen=True)
class Task:
    """What is asked of every option; called with one, it answers, None where it cannot be done.

    Attributes
    ----------
    effects : best law of each, as the campaign sees it
    truth, others : the worst pair: the true effect and the laws of the other one
    times : of the truth's smallest size at which the campaign tells them apart
    """

    planned: PlannedCampaign
    rehearsal: Rehearsal = field(repr=False)
    effects: tuple[Visible, ...]
    truth: Visible | None
    others: tuple[Law, ...]
    times: float

    @property
    def true_law(self) -> Law | None:
        """Of the worst pair."""
        return None if self.truth is None else self.truth.law

    def __call__(self, option: Option) -> Information | None:
        """What one more run would tell."""
        return tried(
            self.planned, self.rehearsal.free_parameters, option,
            [each.law for each in self.effects], self.true_law, self.others,
        )  # fmt: skip

    def before(self) -> Information:
        """What the campaign tells, with what is known beforehand."""
        laws = [each.law for each in self.effects]
        told = information(self.rehearsal, laws, self.true_law, self.others)
        return told + known(self.rehearsal, len(laws), [len(law.shapes) for law in self.others])


def task(
    planned: PlannedCampaign,
    rehearsal: Rehearsal,
    best: Sequence[Visible],
    visible: Sequence[Visible],
    worst: Mistaken | None,
) -> Task:
    """For a campaign whose worst pair is known; None: all are told apart."""
    if worst is None:
        return Task(planned, rehearsal, tuple(best), None, (), 1.0)
    (truth,) = (each for each in best if each.law.effect == worst.truth)
    others = tuple(each.law for each in visible if each.law.effect == worst.other)
    return Task(planned, rehearsal, tuple(best), truth, others, worst.times)


def tried(
    plan: PlannedCampaign, free_parameters, option: Option,
    effects: Sequence[Law], truth: Law | None, others: Sequence[Law],
) -> Information | None:  # fmt: skip
    """What one more run would tell; None where the rig or the model cannot do it."""
    try:
        rehearsal = rehearse_run(plan, option.run, free_parameters)
    except CampaignError:
        return None
    farthest = max(np.abs(run.channels["x"]).max() for run in rehearsal.runs)
    if farthest > FARTHEST * plan.campaign.rig.spring_length:
        return None
    return information(rehearsal, effects, truth, others)


def best_next_runs(
    asked: Task,
    grid: Sequence[Option],
    told: Sequence[Information | None],
    needed: Callable[[Law, int], float],
) -> tuple[NextRun, ...]:
    """The run that lowers the worst effect's size most, and the one that splits the worst pair.

    needed : noncentrality at which a law is named in so many runs
    """
    before = asked.before()
    done = [(one, before + more) for one, more in zip(grid, told, strict=True) if more is not None]
    if not done:
        return ()
    free = len(shared_of(asked.rehearsal.free_parameters))
    sizes = _Sizes(asked, before, free, needed)
    now = np.array([each.percent for each in asked.effects])
    scored = [(_worst(sizes.after(more)), one) for one, more in done]
    _, option = _least(scored)
    (then,) = (sizes.after(more) for one, more in done if one is option)
    hardest = int(np.argmax(np.where(np.isfinite(now), now, np.where(np.isfinite(then), 1e9, -1))))
    names = [each.law.effect for each in asked.effects]
    found = [_described("worst effect", option, (names[hardest],), now[hardest], then[hardest])]
    if asked.truth is not None:
        pair = _Pair(asked, before, free)
        scored_pair = [((pair.after(more),), one) for one, more in done]
        (after,), option = _least(scored_pair)
        other = asked.others[0].effect
        found.append(
            _described("worst pair", option, (asked.truth.law.effect, other), asked.times, after)
        )
    return tuple(found)


def _worst(sizes: np.ndarray) -> tuple[float, float]:
    """How many effects are not seen at all, and the largest size of the others."""
    seen = np.isfinite(sizes)
    return float(np.count_nonzero(~seen)), float(sizes[seen].max(initial=0.0))


def _least(scored: Sequence[tuple[tuple[float, ...], Option]]):
    """The lowest score; of those whose last number is nearly as low, the least new and shortest."""
    least = min(score for score, _ in scored)
    near = [
        (score, option)
        for score, option in scored
        if score[:-1] == least[:-1] and score[-1] <= _NEARLY * least[-1]
    ]
    return min(near, key=lambda each: (each[1].changed, each[1].run.duration, each[0]))


@dataclass(frozen=True)
class _Sizes:
    """Smallest sizes, percent of friction, with one more run."""

    asked: Task
    before: Information
    free: int
    needed: Callable[[Law, int], float]

    def after(self, more: Information) -> np.ndarray:
        """(effects,) in proportion to what was found with everything refitted."""
        runs = len(self.asked.rehearsal.runs)
        linear = [self._parts(self.before, runs), self._parts(more, runs + 1)]
        found = np.array([each.part for each in self.asked.effects])
        with np.errstate(invalid="ignore"):
            parts = np.where(np.isfinite(found), found * linear[1] / linear[0], linear[1])
        most = np.array([each.law.most for each in self.asked.effects])
        return np.where(parts <= most, parts, np.inf) * np.maximum(more.percent, _NONE)

    def _parts(self, told: Information, runs: int) -> np.ndarray:
        """(effects,) of their starts at which they are named, linear."""
        wanted = np.array([self.needed(each.law, runs) for each in self.asked.effects])
        seen = told.visibility(self.free)
        return np.sqrt(wanted / np.where(seen > RANK * told.raw[1:], seen, _NONE))


@dataclass(frozen=True)
class _Pair:
    """Times of its smallest size at which the worst pair is told apart, with one more run."""

    asked: Task
    before: Information
    free: int

    def after(self, more: Information) -> float:
        """At least 1; in proportion to what was found."""
        assert self.asked.truth is not None
        now, then = self.before.apart(self.free), more.apart(self.free)
        size = self.asked.truth.part**2
        if np.isfinite(self.asked.times) and now > 0.0:
            return max(1.0, self.asked.times * float(np.sqrt(now / max(then, _NONE))))
        return max(1.0, float(np.sqrt(power.needed() / max(then * size, _NONE))))


def _described(aim: str, option: Option, effect, before: float, after: float) -> NextRun:
    setting = option.run.setting
    return NextRun(
        aim, setting.mass, setting.stiffness, setting.surface_speed, option.run.duration,
        option.changed, effect, float(before), float(after),
    )  # fmt: skip
