"""From a campaign to its gap: check, name, fit, judge."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, field, replace

from stickslip.effects import EFFECTS

from cosim.gap.checks import doubts_of
from cosim.gap.data import Campaign
from cosim.gap.extended import Part, as_points, part_of
from cosim.gap.judge import (
    explains,
    halves,
    is_scattered,
    judge,
    judged,
    leaves,
    may_be_spurious,
    runs_ask,
)
from cosim.gap.models import Models
from cosim.gap.naming import Named, Naming
from cosim.gap.plan.next_run import next_experiment
from cosim.gap.rates import rates_of, scatter_of
from cosim.gap.report_of_findings import (
    exponents_of,
    law_of,
    ranking_of,
    rig_numbers,
    sentence_of,
    where_of,
)
from cosim.gap.result import Doubt, Gap, Rung
from cosim.gap.weak_form.camera_faults import FAULTS
from cosim.gap.weak_form.constants import ALIKE
from cosim.gap.weak_form.ladder import price_of
from cosim.gap.weak_form.track import thinned

#: Steps of the bar: checks, search, and the models that are fitted.
STEPS = 6

Progress = Callable[[int, int], object]


def find_gap(campaign: Campaign, *, jobs: int = 2, progress: Progress | None = None) -> Gap:
    """What the user's model lacks in a campaign with tracks.

    Nothing is drawn: the same campaign gives the same answer.

    jobs : runs that are simulated at a time; progress : called with the number of steps done and
    of all
    """
    step = _Steps(progress)
    doubts = doubts_of(campaign)
    campaign = replace(campaign, runs=tuple(thinned(run) for run in campaign.runs))
    step()
    fitting = _Fitting(campaign, step, jobs)
    agreed = _agreed(campaign, fitting)
    named, parts, models = agreed.named, agreed.parts, agreed.models
    ladder, system, rung = named.ladder, named.system, named.rung
    found = [part.effect for part in parts]
    rates = rates_of(ladder, named.unknowns)
    verdict = judge(named.findings, found, models.ladder, _physics(), rates)
    doubts = _unanswered(doubts, models.ladder, bool(parts))
    if any(doubt.severe for doubt in doubts):
        verdict = replace(verdict, verdict="unknown", effects=())
    extended = models.fits[-1]
    gap = Gap(
        campaign=campaign,
        verdict=verdict.verdict,
        effects=verdict.effects,
        sentence="",
        classes=verdict.classes,
        where=where_of(campaign, ladder, models.fits[0]),
        ladder=tuple(models.ladder),
        ranking=ranking_of(ladder, parts, extended, models.ladder[-1].gap),
        plain=models.fits[0],
        extended=extended,
        laws=tuple(law for part in parts if (law := law_of(system, rung, part)) is not None),
        exponents=tuple(one for part in parts for one in exponents_of(part)),
        scatter=models.scatter,
        rig=rig_numbers(campaign, extended),
        rates=rates,
        doubts=doubts,
        next_experiment=(
            next_experiment(ladder, named.unknowns, verdict.classes[0], scatter_of(rung)[0])
            if verdict.classes else None
        ),
    )  # fmt: skip
    step.end()
    hints = list(agreed.spurious)
    best = max(gap.ranking, key=lambda row: row.evidence, default=None)
    if not (hints or parts) and best and best.evidence > ALIKE:
        hints = [best.effect]
    return replace(gap, sentence=sentence_of(gap, parts, hints))


@dataclass(frozen=True)
class _Agreed:
    """Findings of the rows that the simulated runs ask for too, and the models with them.

    spurious : names that the rows ask for and the simulated runs do without
    """

    named: Named
    parts: list[Part]
    models: Models
    spurious: tuple[str, ...]


def _agreed(campaign: Campaign, fitting: _Fitting) -> _Agreed:
    """What rows and simulated runs both ask for.

    Rows are read off a smoothed track, and a contact that is no switch may pretend something in
    them; simulated runs have other faults. What they do without is not asked of the rows again.
    """
    naming = Naming.of(campaign)
    fitting.step()
    spurious: list[str] = []
    while True:
        named = naming.named(spurious)
        parts = [part_of(campaign, named.system, named.rung, finding) for finding in named.findings]
        faint = {part.finding.name for part in parts
                 if may_be_spurious(part.finding, alone=len(parts) == 1)}  # fmt: skip
        doubted = fitting.spurious(parts, named, faint)
        if doubted is None:
            found, models = fitting.best_of(parts, named)
            if not explains(models.ladder):
                along = {part.finding.name for part in parts if part.finding.added}
                doubted = fitting.spurious(parts, named, along - faint)
        if doubted is None:
            return _Agreed(named, found, models, tuple(spurious))
        spurious.append(doubted)


@dataclass
class _Fitting:
    """Models of findings, fitted over the same windows. known : what was fitted already"""

    campaign: Campaign
    step: Callable[[], None]
    jobs: int
    known: list[Models] = field(default_factory=list)

    def best_of(self, parts: list[Part], named: Named) -> tuple[list[Part], Models]:
        """With laws that follow the curves, or with the curves where the runs ask for them."""
        models = self._fitted(named, parts)
        if not explains(models.ladder):  # a law may be near its curve, and not near enough
            points = [as_points(self.campaign, named.system, part) for part in parts]
            if points != parts:
                others = self._fitted(named, points)
                if judged(others.ladder[-1].gap) < judged(models.ladder[-1].gap):
                    return points, others
        return parts, models

    def spurious(self, parts: Sequence[Part], named: Named, asked: Collection[str]) -> str | None:
        """The first of the findings asked for that the simulated runs do without."""
        for part in parts:
            if part.finding.name in asked and not self.needs(part, parts, named):
                return part.finding.name
        return None

    def needs(self, part: Part, parts: Sequence[Part], named: Named) -> bool:
        """Whether the simulated runs ask for a finding beside the others."""
        without = self._fitted(named, [other for other in parts if other is not part])
        if not part.in_kernel:
            return leaves(without.ladder[-1].gap)
        if runs_ask(without.gained(part) - price_of(part.finding.name)):
            return True
        if not (is_scattered(part.finding) and leaves(without.unscattered)):
            return False
        return halves(self._fitted(named, parts).unscattered, without.unscattered)

    def _fitted(self, named: Named, parts: Sequence[Part]) -> Models:
        for models in self.known:
            if list(map(id, models.parts)) == list(map(id, parts)):
                return models
        added = [one for part in parts for one in part.finding.added]
        self.known.append(Models.fitted(
            self.campaign, named.system, named.system.rung(added), parts, step=self.step,
            jobs=self.jobs, others=self.known[0] if self.known else None,
        ))  # fmt: skip
        return self.known[-1]


def _unanswered(doubts: Sequence[Doubt], ladder: Sequence[Rung], found: bool) -> tuple[Doubt, ...]:
    """Doubts, of which what the simulated runs answer is not severe.

    With findings the model has swings that those springs alone have not; without them nothing rests
    on the rows, which need finer samples than simulated runs do.
    """
    answered = ("springs" if found else "sampling") if explains(ladder) else None
    return tuple(replace(one, severe=one.severe and one.check != answered) for one in doubts)


def _physics() -> set[str]:
    """What has a name: effects of the catalogue, of the user's own files, and faults."""
    return {effect.id for effect in EFFECTS} | set(FAULTS)


class _Steps:
    def __init__(self, progress: Progress | None):
        self.progress, self.done = progress or (lambda done, total: None), 0

    def __call__(self) -> None:
        self.done = min(self.done + 1, STEPS - 1)
        self.progress(self.done, STEPS)

    def end(self) -> None:
        self.progress(STEPS, STEPS)
