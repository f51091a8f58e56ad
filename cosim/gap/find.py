"""From a campaign to its gap: check, name, fit, judge."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np
from stickslip.effects import EFFECTS

from cosim.gap.checks import doubts_of
from cosim.gap.data import Campaign
from cosim.gap.extended import (
    Part,
    as_points,
    contact_numbers,
    part_of,
    scatter_numbers,
    started_from,
)
from cosim.gap.judge import explains, is_needed, judge, judged, sure_of
from cosim.gap.plan.next_run import next_experiment
from cosim.gap.rates import rates_of, scatter_of
from cosim.gap.report_of_findings import (
    exponents_of,
    law_of,
    ranking_of,
    rig_numbers,
    sentence_of,
    text_of,
    where_of,
)
from cosim.gap.result import Doubt, Gap, Rung, Score
from cosim.gap.weak_form import periodic
from cosim.gap.weak_form.asked import Unknowns, asked_of
from cosim.gap.weak_form.camera_faults import FAULTS, SMOOTHING, filters
from cosim.gap.weak_form.constants import ALIKE, SCATTER_PRIOR
from cosim.gap.weak_form.corners import with_corners
from cosim.gap.weak_form.ladder import Finding, Ladder, Search
from cosim.gap.weak_form.planar import Planar, planar_effects, rows_in_plane
from cosim.gap.weak_form.rows import RunRows, rows_of
from cosim.gap.weak_form.surface import best_phase, tracks_of
from cosim.gap.weak_form.system import Rung as Rows
from cosim.gap.weak_form.system import System
from cosim.gap.weak_form.track import thinned
from cosim.gap.weak_form.unknowns import Unknown
from cosim.gap.windows import Fitted, Number, fit, user_model, windows_of_campaign
from cosim.gap.windows.run_model import BREAK_AWAY
from cosim.gap.windows.windows import Windows

#: Steps of the bar: checks, search, and the models that are fitted.
STEPS = 6
#: A nuisance is a finding where it takes this part of the fitted runs' misfit or more, or brings
#: their gap down by a hundredth of noise.
FELT_PART, FELT_GAP = 0.02, 0.01
#: Gap up to which noise is all that is left: fitted starts take 1 or 2 % of it.
NOISE_LEFT = 1.02

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
    named = name(campaign)
    system, ladder, rung = named.system, named.ladder, named.rung
    step()
    parts = [part_of(campaign, system, rung, finding) for finding in named.findings]
    modelled = partial(_Models.fitted, campaign, system, step=step, jobs=jobs)
    models = modelled(rung, parts)
    if not explains(models.ladder):  # a law may be near its curve, and not near enough
        points = [as_points(campaign, system, part) for part in parts]
        if points != parts:
            others = modelled(rung, points, others=models)
            models, parts = min(
                (models, parts), (others, points), key=lambda pair: judged(pair[0].ladder[-1].gap)
            )
    hints, sure = [], sure_of(named.findings)
    if len(sure) < len(parts):
        kept = [part for part in parts if part.finding in sure]
        fewer = system.rung([added for finding in sure for added in finding.added])
        without = modelled(fewer, kept, others=models)
        if not is_needed(models.ladder, without.ladder):
            hints = [part.effect for part in parts if part not in kept]
            parts, models, named = kept, without, replace(named, findings=tuple(sure))
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
    best = max(gap.ranking, key=lambda row: row.evidence, default=None)
    if not (hints or parts) and best and best.evidence > ALIKE:
        hints = [best.effect]
    return replace(gap, sentence=sentence_of(gap, parts, hints))


@dataclass(frozen=True)
class Named:
    """What the rows ask for.

    ladder : of all runs' rows; findings : what moves the block across first, then the ladder's;
    system, rung : rows of the fitted runs, with all findings; unknowns : that were asked
    """

    ladder: Ladder
    findings: tuple[Finding, ...]
    system: System
    rung: Rows
    unknowns: Mapping[str, Sequence[Unknown]]


def name(campaign: Campaign) -> Named:
    """What the rows of all runs ask for, and the rows of the fitted ones, for its numbers.

    Which argument it is, every run may say; how large it is, only those that are fitted.
    """
    runs = [thinned(run) for run in campaign.runs if run.track is not None]
    tracks = tracks_of(campaign, runs)
    rows = [rows_of(track, campaign.rig) for track in tracks]
    planar = planar_effects(campaign, rows)
    if planar.answer:
        rows = rows_in_plane(tracks, campaign, planar)
    every, arguments, unknowns = asked_of(campaign, rows)
    if planar.answer:
        unknowns.pop("measurement.zero", None)
    waves = periodic.kinds(every.level.kinetic)
    ladder = Search(every, unknowns, waves, arguments.near).climb()
    if not (ladder.findings or planar.answer):
        rows, ladder, unknowns = _at_corners(campaign, rows, ladder, unknowns)
    _follow_surface(campaign, every, ladder)
    fitted = System(campaign, rows)
    added = [one for finding in ladder.findings for one in finding.added]
    findings = (*_across(planar), *ladder.findings)
    return Named(ladder, findings, fitted, fitted.rung(added), unknowns)


def _follow_surface(campaign: Campaign, system: System, ladder: Ladder) -> None:
    """Give a ripple the phases that slips show, in runs whose sticks show none."""
    for finding in ladder.findings:
        if finding.name == "speed_ripple":
            sizes = ladder.rung.posterior[0][ladder.rung.part_of(finding.main)]
            wave = finding.main.unknown.wave
            for run in system.runs:
                here = best_phase(campaign, run, wave, sizes)
                wave.phases[run.track.run.name] = here.phases[run.track.run.name]


def _at_corners(
    campaign: Campaign,
    rows: list[RunRows],
    ladder: Ladder,
    unknowns: Unknowns,
) -> tuple[list[RunRows], Ladder, Unknowns]:
    """Whether a tracker smooths, asked of runs in which nothing else is missing.

    A filter shows where break-aways and re-sticks are rounded, as what any other finding leaves
    there would be.
    """
    cornered = [with_corners(run) for run in rows]
    system = System(campaign, cornered, every=True)
    smoothing = {SMOOTHING: filters(system.rung())}
    if not smoothing[SMOOTHING]:
        return rows, ladder, unknowns
    found = Search(system, smoothing, ()).climb()
    return (
        (cornered, found, {**unknowns, **smoothing}) if found.findings else (rows, ladder, unknowns)
    )


def _unanswered(doubts: Sequence[Doubt], ladder: Sequence[Rung], found: bool) -> tuple[Doubt, ...]:
    """Doubts, of which what the simulated runs answer is not severe.

    With findings the model has swings that those springs alone have not; without them nothing rests
    on the rows, which need finer samples than simulated runs do.
    """
    answered = ("springs" if found else "sampling") if explains(ladder) else None
    return tuple(replace(one, severe=one.severe and one.check != answered) for one in doubts)


def _across(planar: Planar) -> Iterator[Finding]:
    """What moves the block across, as a finding."""
    if planar.answer:
        gain = planar.evidence[planar.answer]
        others = {name: value - gain for name, value in planar.evidence.items()
                  if name == planar.runner_up}  # fmt: skip
        yield Finding(planar.answer, (), gain, others, planar.numbers)


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


@dataclass
class _Models:
    """The ladder's models, each fitted over the same windows."""

    campaign: Campaign
    windows: Mapping[str, Windows]
    starts: dict[str, float]
    jobs: int
    fits: list[Fitted] = field(default_factory=list)
    ladder: list[Rung] = field(default_factory=list)
    scatter: tuple[float, float, float] | None = None

    @classmethod
    def fitted(
        cls, campaign: Campaign, system: System, rows: Rows, parts: list[Part], *, step: _Steps,
        jobs: int, others: _Models | None = None,
    ) -> _Models:  # fmt: skip
        """The user's model, then the findings, then contact and scatter where they are felt.

        others : whose user's model it is as well
        """
        starts = {label: value for part in parts for label, value in part.starts.items()}
        models = cls(campaign, windows_of_campaign(campaign), starts, jobs)
        numbers, settings = user_model(campaign)
        weak = system.rung(contact=False, scatter=False)
        first = others.fits[0] if others else None
        models._add("user's model", "the model as stated", numbers, settings, weak, None, first)
        step()
        added, last = [], weak.evidence
        for part in parts:
            added += [*part.finding.added]
            rung = system.rung(added, contact=False, scatter=False)
            numbers, settings = [*numbers, *part.numbers], {**settings, **part.settings}
            models._add(part.effect, text_of(part), numbers, settings, rung, rung.evidence - last)
            last = rung.evidence
        step()
        fastest = max(float(np.percentile(np.abs(run.track.sliding), 99)) for run in system.runs)
        rung = system.rung(added, scatter=False)
        contact = contact_numbers(campaign, fastest)
        if models._try("contact", "the contact is not a switch", [*numbers, *contact], settings,
                       rung, rung.evidence - last):  # fmt: skip
            numbers, last = [*numbers, *contact], rung.evidence
        step()
        models.scatter = scatter_of(rows)
        spread = models.scatter[2]  # a run may lie at the far end of what is probable
        rung = system.rung(added)
        text = f"friction scatters from run to run by {100.0 * models.scatter[0]:.2g} %"
        settings = {**settings, BREAK_AWAY: SCATTER_PRIOR}
        if models._try("scatter", text, [*numbers, *scatter_numbers(campaign, spread)], settings,
                       rung, rung.evidence - last, spread):  # fmt: skip
            sticks = 100.0 * models.fits[-1].stick_scatter
            text += f", what one stick holds to the next by {sticks:.2g} %"
            models.ladder[-1] = replace(models.ladder[-1], text=text)
        return models

    def _fit(self, numbers: list[Number], settings: dict, scatter: float, rows: Rows) -> Fitted:
        before = {**self.starts, **(self.fits[-1].values if self.fits else {})}
        starts = [{**before, **started_from(self.campaign, rows)}, before]
        near = self.fits[-1] if self.fits else None
        return fit(self.campaign, self.windows, numbers, settings, scatter, starts, near, self.jobs)

    def _add(
        self, name: str, text: str, numbers: list[Number], settings: dict, rows: Rows,
        evidence: float | None, fitted: Fitted | None = None,
    ) -> None:  # fmt: skip
        fitted = fitted or self._fit(numbers, settings, 0.0, rows)
        self.fits.append(fitted)
        gap = _score(*fitted.gap)
        first = self.ladder[0].gap if self.ladder else gap
        missing = max(first.fit**2 - 1.0, 1e-9)
        share = min(max(1.0 - (gap.fit**2 - 1.0) / missing, 0.0), 1.0) if self.ladder else 0.0
        weak = Score(rows.gap, rows.held_out_gap)
        self.ladder.append(Rung(name, text, gap, weak, share, evidence))

    def _try(
        self, name: str, text: str, numbers: list[Number], settings: dict, rows: Rows,
        evidence: float, scatter: float = 0.0,
    ) -> bool:  # fmt: skip
        """Add what is felt; where noise is all that is left nothing can be."""
        before = self.ladder[-1].gap
        if max(before.fit, before.held_out or 0.0) < NOISE_LEFT:
            return False
        fitted = self._fit(numbers, settings, scatter, rows)
        after = _score(*fitted.gap)
        gained = before.fit**2 - after.fit**2
        felt = gained > FELT_PART * max(before.fit**2 - 1.0, 0.0) and (
            before.fit - after.fit > FELT_GAP
        )
        if scatter and before.held_out and after.held_out:
            felt = felt or before.held_out - after.held_out > FELT_GAP
        if felt:
            self._add(name, text, numbers, settings, rows, evidence, fitted)
        return felt


def _score(fit: float, held_out: float) -> Score:
    return Score(fit, None if math.isnan(held_out) else held_out)
