"""A finding with all that is shown of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, replace

from cosim.gap.camera.quantisation import Quantisation
from cosim.gap.data import Campaign
from cosim.gap.design import Member, next_experiment
from cosim.gap.diagnostics import analyse_residuals, empirical_term, find_where
from cosim.gap.estimation.intervals import determined
from cosim.gap.estimation.trial import Trial
from cosim.gap.evidence.products import Spreads
from cosim.gap.evidence.settled import Settled
from cosim.gap.result import FittedModel, Gap, Power
from cosim.gap.selection.powers import Powers
from cosim.gap.selection.tried import Tried
from cosim.gap.selection.verdict import Finding
from cosim.processes import Map

from .lacking import lacking
from .laws import laws_found, table_found
from .longer import hidden_line, left_in_longer
from .models import Bench, long_fit, shown
from .offered import offered
from .ranking import ranked
from .remarks import remarks
from .steps import steps

#: What the tracker writes in steps, by name.
_ROUNDED = "measurement.quantisation"


def answer(
    campaign: Campaign,
    bench: Bench,
    finding: Finding,
    powers: Powers,
    rounded: Quantisation | None,
    mapped: Map,
) -> Gap:
    """campaign : as measured; the bench's has noise of which rounding is a part, if it is felt."""
    laws_offered = offered(bench, finding.ladder[0].settled)
    effects = tuple(dict.fromkeys(law.effect for law in laws_offered))
    spreads = finding.ladder[-1].settled.spreads
    trials = list(mapped(long_fit, [(bench, rung.settled, spreads) for rung in finding.ladder]))
    hidden = left_in_longer(bench, finding, trials[0], mapped)
    if hidden:
        finding = replace(finding, verdict="unknown")
    plain = shown(campaign, bench, trials[0])
    laws = laws_found(bench, finding, mapped)
    table = table_found(bench, finding, laws, mapped)
    extended = _extended(bench, finding, trials, table[1] if table else None)
    if table:
        laws = (table[0], *(law for law in laws if law.curve.axis != table[0].curve.axis))
    if rounded and extended is None and finding.verdict == "none":
        extended = shown(bench.campaign, bench, trials[0])
    analysis = analyse_residuals([run.track for run in plain.runs])
    gap = Gap(
        campaign=campaign,
        verdict=finding.verdict,
        effects=_effects(finding),
        classes=_classes(finding),
        where=find_where(analysis),
        ranking=ranked(bench, finding, trials, spreads, effects, mapped),
        gap_before=plain.gap,
        gap_after=(extended or plain).gap,
        plain=plain,
        extended=extended,
        determined=determined(trials[0]),
        ladder=steps(finding, trials, len(effects)),
        share=float(finding.share),
        reasons=finding.reasons,
        spreads=_scatter(spreads),
        powers=_powers(powers),
        laws=laws,
        remains=_remains(extended),
        analysis=analysis,
        next_experiment=_separating(bench, finding, spreads, mapped),
        remarks=remarks(campaign, effects, rounded),
        lacks=_lacks(campaign, finding, spreads, hidden),
    )
    if gap.verdict == "unknown" and extended is None:
        gap = replace(gap, empirical=empirical_term(bench.campaign, bench.data, trials[0], mapped))
    return _with_steps(gap, rounded) if rounded else gap


def _lacks(
    campaign: Campaign, finding: Finding, spreads: Spreads, hidden: float
) -> tuple[str, ...]:
    """hidden : what the plain model leaves in long segments alone, units of the noise, or 0"""
    if finding.verdict not in ("partial", "unknown"):
        return ()
    return (*([hidden_line(hidden)] if hidden else []), *lacking(campaign, spreads))


def _extended(
    bench: Bench, finding: Finding, trials: Sequence[Trial], table: Settled | None
) -> FittedModel | None:
    if table is not None:
        return shown(bench.campaign, bench, long_fit(bench, table, table.spreads))
    if not finding.chosen:
        return None
    return shown(bench.campaign, bench, trials[finding.chosen])


def _effects(finding: Finding) -> tuple[str, ...]:
    """Those found for certain, then the members of the last one's class."""
    if finding.verdict != "class":
        return finding.effects
    last = finding.ladder[finding.chosen]
    return (*last.effects[:-1], *(each.candidate.effect for each in last.members))


def _classes(finding: Finding) -> tuple[tuple[str, ...], ...]:
    if finding.verdict != "class":
        return ()
    members = finding.ladder[finding.chosen].members
    return (tuple(each.candidate.effect for each in members),)


def _with_steps(gap: Gap, rounded: Quantisation) -> Gap:
    """A tracker that writes in steps which are felt is named for it, beside what else was found."""
    gap = replace(gap, quantisation=asdict(rounded))
    if gap.verdict == "unknown":
        return gap
    verdict = "named" if gap.verdict == "none" else gap.verdict
    return replace(gap, verdict=verdict, effects=(_ROUNDED, *gap.effects))


def _scatter(spreads: Spreads) -> dict[str, float]:
    """Standard deviations of what differs by itself, parts of it."""
    return {
        "friction_from_run_to_run": float(spreads.friction),
        "friction_within_a_run": float(spreads.stretch),
        "static_friction_beside_it": float(spreads.static),
        "surface_speed": float(spreads.speed),
    }


def _powers(powers: Powers) -> tuple[Power, ...]:
    return tuple(
        Power(effect, name, one.value, one.low, one.high, one.p, stated, one.instead)
        for effect, tested in powers.items()
        for name, (one, stated) in tested.items()
    )


def _remains(extended: FittedModel | None):
    if extended is None:
        return None
    return find_where(analyse_residuals([run.track for run in extended.runs]))


def _separating(bench: Bench, finding: Finding, spreads: Spreads, mapped: Map) -> dict | None:
    """The run that would tell the members of a class apart."""
    if finding.verdict != "class":
        return None
    tried = finding.ladder[finding.chosen].members
    trials = mapped(long_fit, [(bench, each.model, spreads) for each in tried])
    members = [_member(each, trial) for each, trial in zip(tried, trials, strict=True)]
    return next_experiment(bench.campaign, members, bench.planar)


def _member(tried: Tried, trial: Trial) -> Member:
    model = trial.model
    return Member(tried.candidate.effect, model.free_parameters, model.settings, trial.fitted)
