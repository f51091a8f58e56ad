"""From a campaign to its gap: calibrate, locate, name, extend."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from stickslip.effects.candidate import Candidate

from cosim.gap.candidates.catalogue import candidates
from cosim.gap.candidates.plain import moves_across, plain_free_parameters
from cosim.gap.candidates.scales import scales
from cosim.gap.data import Campaign
from cosim.gap.design import Member, next_experiment
from cosim.gap.diagnostics import analyse_residuals, empirical_term, find_where
from cosim.gap.estimation.fitted import Fitted, shared_of
from cosim.gap.estimation.intervals import determined, intervals
from cosim.gap.estimation.preparation import Data, prepared, thinned
from cosim.gap.estimation.problem import Problem
from cosim.gap.estimation.segmented_run import SegmentedRun
from cosim.gap.estimation.trial import Model, Trial, coarse_fit, try_model
from cosim.gap.fitted_model import fitted_model
from cosim.gap.result import FittedModel, Gap, Ranked
from cosim.gap.selection.alternatives import other_starts
from cosim.gap.selection.bootstrap import chance
from cosim.gap.selection.search import COARSE, Search
from cosim.gap.selection.tried import Tried
from cosim.gap.selection.verdict import Finding, judge
from cosim.processes import Map, processes

#: Another start must leave less than this part of the sum of squares: mu_s may be felt nowhere.
_CLEARLY = 0.99


def find_gap(
    campaign: Campaign,
    *,
    seed: int = 0,
    jobs: int = 2,
    progress: Callable[[int], object] | None = None,
) -> Gap:
    """What the plain model lacks in a campaign with tracks.

    seed : of the bootstrap; the same seed gives the same answer. progress : called with 1 after
    every model tried. Runs of which only figures are known are left to `find_summary_gap`.
    """
    runs = tuple(thinned(run) if run.track is not None else run for run in campaign.runs)
    campaign = replace(campaign, runs=runs)
    fit_runs = [run for run in campaign.fit_runs if run.track is not None]
    held_out = [run for run in campaign.held_out_runs if run.track is not None]
    planar = moves_across(campaign)
    data = prepared(campaign, fit_runs, held_out, planar)
    with processes(jobs) as mapped:
        mapped(_woken, [(data.short[0],)] * jobs)  # they start while the plain model is fitted
        base = Model(plain_free_parameters(campaign, planar), {})
        coarse = _coarse(data, base)
        plain = try_model(data, base, coarse)
        search = Search(data, mapped, progress)
        finding = judge(search, plain, coarse, _laws(campaign, plain, planar))
        ranking = search.judged(finding.ranking)
        return _answer(campaign, data, plain, finding, ranking, seed, planar, mapped)


def _woken(segmented: SegmentedRun) -> None:
    """Have a process load what it needs."""
    segmented.places({}, segmented.starts)


def _laws(campaign: Campaign, plain: Trial, planar: bool) -> list[Candidate]:
    """Those of the catalogue that the campaign could tell from the plain model at all."""
    used = [*campaign.fit_runs, *campaign.held_out_runs]
    runs = [run for run in used if run.track is not None]
    extension = campaign.rig.spring_length - campaign.rig.spring_natural_length
    mu_k = plain.fitted.values["friction.mu_k"]
    laws = candidates(scales(runs, mu_k, extension))
    return [law for law in laws if _is_felt(law, campaign, planar)]


def _coarse(data: Data, base: Model) -> Fitted:
    """The plain model in short segments, from whichever mu_s ends best."""
    first = coarse_fit(data, base, COARSE)
    again = [coarse_fit(data, model, COARSE) for model in other_starts(base, first.values)]
    best = min(again, key=lambda fitted: fitted.cost)
    return best if best.cost < _CLEARLY * first.cost else first


def _is_felt(law: Candidate, campaign: Campaign, planar: bool) -> bool:
    """Whether the campaign could tell the law from the plain model at all."""
    if law.effect == "stick_stiffness":  # along x it is another mu_s
        return "mu_s" in campaign.friction
    return planar or not law.lateral


def _answer(
    campaign: Campaign,
    data: Data,
    plain: Trial,
    finding: Finding,
    ranking,
    seed: int,
    planar: bool,
    mapped: Map,
) -> Gap:
    finalists = [t.trial for t in finding.ranking if t.judged is not None]
    before = _fitted_model(campaign, data, plain)
    after = _fitted_model(campaign, data, finding.chosen) if finding.chosen else None
    tried = {t.candidate.effect for t in ranking}
    analysis = analyse_residuals([run.track for run in before.runs])
    unnamed = finding.verdict == "unknown"
    return Gap(
        campaign=campaign,
        verdict=finding.verdict,
        effects=finding.effects,
        classes=(finding.effects,) if finding.verdict == "class" else (),
        where=find_where(analysis),
        ranking=tuple(_ranked(plain, t, finding.nearest.rms_residual) for t in ranking),
        gap_before=before.gap,
        gap_after=(after or before).gap,
        plain=before,
        extended=after,
        chance=chance(data, plain, finalists, seed),
        determined=determined(plain),
        seed=seed,
        analysis=analysis,
        next_experiment=_separating(campaign, finding, planar),
        empirical=empirical_term(campaign, data, plain, mapped) if unnamed else None,
        remarks=_remarks(campaign, tried, finding),
    )


def _separating(campaign: Campaign, finding: Finding, planar: bool) -> dict | None:
    """The run that would tell the members of a class apart."""
    if finding.verdict != "class":
        return None
    members = [
        Member(t.candidate.effect, t.model.free_parameters, t.model.settings, t.trial.fitted)
        for t in finding.ranking
        if t.judged is not None and t.candidate.effect in finding.effects
    ]
    return next_experiment(campaign, members, planar)


def _fitted_model(campaign: Campaign, data: Data, trial: Trial) -> FittedModel:
    free_parameters, settings = trial.model.free_parameters, trial.model.settings
    parts = [(Problem(data.fit, free_parameters, settings), trial.fitted)]
    if data.held_out:
        parts.append((Problem(data.held_out, free_parameters, settings), trial.held_out))
    return fitted_model(campaign, parts, intervals(trial))


def _ranked(plain: Trial, tried: Tried, noise: float) -> Ranked:
    """``noise`` : root mean square residual of the best model, to which others are compared."""
    trial = tried.trial
    rows = float(plain.rows.sum())
    gained = (plain.squares.sum() - trial.squares.sum()) / max(noise, 1.0) ** 2
    added = {free.key for free in shared_of(tried.candidate.free_parameters)}
    values = {key: float(value) for key, value in trial.fitted.values.items() if key in added}
    wide = intervals(trial) if trial.fitted.columns else {}
    return Ranked(
        effect=tried.candidate.effect,
        form=tried.candidate.form,
        held_out_gap=trial.held_out_rms,
        fit_gap=trial.fitted.rms_residual(),
        delta_bic=float(gained - tried.candidate.size * np.log(rows)),
        parameters=values,
        intervals={key: wide[key] for key in values if key in wide},
    )


def _remarks(campaign: Campaign, tried: set[str], finding: Finding) -> tuple[str, ...]:
    lines = []
    if finding.confounder:
        lines.append(f"{finding.confounder} does better than any effect of the catalogue")
    silent = [
        e for e in ("lateral_friction", "turning_surface", "spring_misalignment") if e not in tried
    ]
    if silent:
        seen = any("y" in run.motion.channels for run in campaign.runs if run.track is not None)
        why = "no motion across was seen" if seen else "y was not measured"
        lines.append(f"{', '.join(silent)}: not tried, as {why}")
    if "stick_stiffness" not in tried:
        lines.append(
            "stick_stiffness: not tried, as along x it is the same as another mu_s; a campaign "
            "that states mu_s under [friction] can tell"
        )
    if any(run.track is None for run in campaign.runs):
        lines.append("runs of which only figures are known were not used")
    return tuple(lines)
