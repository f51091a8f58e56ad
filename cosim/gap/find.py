"""From a campaign to its gap: check, name, fit, judge."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from cosim.gap.agreement import Agreed, confirmed_findings
from cosim.gap.checks import blocking, digits_evidence, doubts_of, with_rounding
from cosim.gap.data import Campaign
from cosim.gap.extended import ROUNDING, Part, rounding_of
from cosim.gap.fitting import Fitting
from cosim.gap.judge import explains, is_strained, judge, with_steps
from cosim.gap.naming import Named, Naming
from cosim.gap.plan.next_run import next_experiment
from cosim.gap.rates import rates_of
from cosim.gap.report_of_findings import (
    exponents_of,
    law_of,
    ranking_of,
    rig_numbers,
    sentence_of,
    where_of,
)
from cosim.gap.result import Doubt, Gap, Ranked, Rung
from cosim.gap.scatter import Interval, Scatter, scatter_text
from cosim.gap.weak_form.camera_faults import FAULTS
from cosim.gap.weak_form.constants import ALIKE
from cosim.gap.weak_form.ladder import Ladder
from cosim.gap.weak_form.track import thinned
from cosim.gap.windows.run_model import HEIGHT

#: Parts of the bar, and where it stands after checks and where the search begins. Nobody knows how
#: many models will be fitted: each step of one takes a share of what is left.
PARTS, BEGINNING, SHARE = 100, (2, 5), 0.2

Progress = Callable[[int, int], object]


def find_gap(campaign: Campaign, *, jobs: int = 2, progress: Progress | None = None) -> Gap:
    """What the user's model lacks in a campaign with tracks.

    Nothing is drawn: the same campaign gives the same answer. Effects are searched for only where
    nothing of the data is in such doubt that none would be named.

    jobs : runs that are simulated at a time; progress : called with the parts done and of all

    >>> from pathlib import Path
    >>> from cosim import find_gap, read_campaign
    >>> from cosim.gap.example import write_example
    >>> found = find_gap(read_campaign(write_example(Path("cold_room"))), jobs=1)
    >>> found.summary()["verdict"], found.summary()["effects"]
    ('named', ['velocity_weakening'])
    """
    step = _Steps(progress)
    campaign = with_rounding(campaign)
    doubts = doubts_of(campaign)
    campaign = replace(campaign, runs=tuple(thinned(run) for run in campaign.runs))
    step()
    fitting = Fitting(campaign, step, jobs)
    search = _unsearched if blocking(doubts) else confirmed_findings
    gap = _answer(campaign, search(campaign, fitting), doubts)
    step.end()
    return gap


def _unsearched(campaign: Campaign, fitting: Fitting) -> Agreed:
    """The user's model, contact and scatter, without a search for effects."""
    system = Naming.of(campaign).system
    rung = system.rung()
    named = Named(Ladder(system, (), rung, {}, {}), (), system, rung, {})
    fitting.step()
    return Agreed(named, *fitting.best_of([], named))


def _answer(campaign: Campaign, agreed: Agreed, doubts: Sequence[Doubt]) -> Gap:
    """The verdict, and all that is said of it."""
    named, parts, models = agreed.named, agreed.parts, agreed.models
    ladder, system, rung = named.ladder, named.system, named.rung
    rates = rates_of(ladder, named.unknowns) if named.unknowns else None
    answered = _unanswered(doubts, models.ladder, [part.effect for part in parts])
    names = [part.effect for part in parts]
    stated = campaign.errors.friction
    strained = is_strained(models.ladder, models.scatter, stated)
    verdict = judge(
        named.findings, names, models.ladder, _physics(campaign), rates, agreed.left_without,
        strained,
    )  # fmt: skip
    if strained and models.scatter is not None:
        answered += (_too_much(models.scatter, stated),)
    if agreed.is_cut:
        answered += (_cut_short(models.work.simulated, bool(parts)),)
    # coarse steps are read off the digits, and stand in no other finding's place
    rounding = [part for part in [rounding_of(campaign)] if part]
    steps = [rung for rung in models.ladder if rung.name == ROUNDING]
    if rounding:
        verdict = with_steps(verdict, ROUNDING)
    if any(doubt.severe for doubt in answered):
        verdict = replace(verdict, verdict="unknown", effects=())
    extended = models.fits[-1]
    curves = (law_of(system, rung, part, extended.values.get(HEIGHT, 1.0)) for part in parts)
    gap = Gap(
        campaign=campaign,
        verdict=verdict.verdict,
        effects=verdict.effects,
        sentence="",
        classes=verdict.classes,
        where=where_of(campaign, ladder, models.fits[0]),
        ladder=tuple(models.ladder),
        ranking=(
            *(Ranked(rung.name, "", digits_evidence(campaign), 1.0, rung.gap) for rung in steps),
            *ranking_of(ladder, parts, extended, models.ladder[-1].gap),
        ),
        plain=models.fits[0],
        extended=extended,
        laws=tuple(law for law in curves if law is not None),
        exponents=tuple(
            one for part in parts for one in exponents_of(part, rung, named.unknowns)
        ),
        scatter=models.scatter,
        rig=rig_numbers(campaign, extended),
        rates=rates,
        doubts=answered,
        next_experiment=(
            next_experiment(
                ladder, named.unknowns, verdict.classes[0], Scatter.of(rung).expected[0]
            )
            if verdict.classes else None
        ),
        rejected=agreed.rejected,
    )  # fmt: skip
    return replace(gap, sentence=sentence_of(gap, [*rounding, *parts], _hints(gap, parts)))


def _too_much(scatter: Interval, stated: float) -> Doubt:
    """Of a scatter that stands for something else."""
    text = (
        f"{scatter_text(scatter)}, where {100.0 * stated:.2g} % is stated; something else differs"
    )
    return Doubt("scatter", f"{text} between the runs that the model does not have", (), False)


def _cut_short(simulated: int, is_found: bool) -> Doubt:
    """Of a search that ended early: without a finding nothing is concluded from it."""
    text = f"The search ended after {simulated / 1e6:.0f} million simulated samples"
    return Doubt(
        "search", f"{text}; not everything was tried that the runs may ask for", (), not is_found
    )


def _hints(gap: Gap, parts: Sequence[Part]) -> list[str]:
    """What the rows ask for without a finding."""
    hints = [one.effect for one in gap.rejected]
    best = max(gap.ranking, key=lambda row: row.evidence, default=None)
    if not (hints or parts) and best and best.evidence > ALIKE:
        hints = [best.effect]
    return hints


def _unanswered(
    doubts: Sequence[Doubt], ladder: Sequence[Rung], names: Sequence[str]
) -> tuple[Doubt, ...]:
    """Doubts without those that the findings or the simulated runs answer.

    With findings the model has swings that those springs alone have not; without them nothing rests
    on the rows, which need finer samples than simulated runs do. Whatever else is missing, a drive
    that ripples carries a block at its crests or troughs.
    """
    answered = {"springs" if names else "sampling"} if explains(ladder) else set()
    if "speed_ripple" in names:
        answered.add("speed")
    return tuple(one for one in doubts if one.check not in answered)


def _physics(campaign: Campaign) -> set[str]:
    """What has a name: effects of the catalogue, of the user's own files, and faults."""
    return {effect.id for effect in campaign.catalogue.effects} | set(FAULTS)


class _Steps:
    def __init__(self, progress: Progress | None):
        self.progress, self.made, self.done = progress or (lambda done, total: None), 0, 0

    def __call__(self) -> None:
        further = self.done + round(SHARE * (PARTS - self.done))
        self.done = BEGINNING[self.made] if self.made < len(BEGINNING) else further
        self.made += 1
        self.progress(self.done, PARTS)

    def end(self) -> None:
        self.progress(PARTS, PARTS)
