"""A formula for the force that the catalogue has no name for: proposed, and judged."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from stickslip.effects.candidate import Candidate, FreeParameter

from cosim.gap.candidates.extend import extended
from cosim.gap.data import Campaign, MeasuredRun
from cosim.gap.diagnostics.spectrum import Period, strongest_period
from cosim.gap.estimation.preparation import Data
from cosim.gap.estimation.trial import Trial, coarse_fit, try_model
from cosim.processes import Map

from .features import HELD, Feature, library
from .force_term import Term, forced, formula, key
from .slips import Slip, holding, slips_of
from .sparse_regression import Formula, formulas

#: What a break-away takes, over kinetic friction, where no break-away was seen.
_UNSEEN_RATIO = 1.3
#: Break-aways differ between the two directions when they do by this part.
_UNLIKE = 0.05
#: Rounds of the fit in short segments with the force acting.
_ROUNDS = 4
#: The formula is kept when it takes away this part of the held-out excess chi-square.
_WORTH = 0.2
#: Part of what fewer terms leave of the held-out runs that further terms must take away.
_EARNED = 0.1
#: Highest frequency that is searched for, in free vibrations: a block hardly follows faster ones.
_HIGHEST = 4.0
#: A held-out root mean square residual at which no other formula is tried.
_ENOUGH = 1.5
#: A step of a coefficient, part of what the regression gave.
_STEP = 0.1


def empirical_term(
    campaign: Campaign, data: Data, base: Trial, mapped: Map
) -> dict[str, Any] | None:
    """A formula for the force along x that a model lacks, or None where none helps.

    base : the model that is left, fitted to `data`. mapped : as `processes` gives it.
    The features are chosen by sparse regression on the measured slips of the runs for fitting,
    their number by the held-out runs; the force then acts in the model, from the model's own state,
    and coefficients and friction are refitted. It is kept only where the held-out residual
    becomes smaller. (The held-out runs choose among a handful of formulas: what they leave is not
    as independent as that of a named effect.)
    Keys: kind ("empirical"), formula, terms ([{feature, coefficient, unit}]), parameters (friction,
    refitted with it), fit_gap_before, fit_gap_after, held_out_gap_before, held_out_gap_after, text.
    """
    names = {segmented.name for segmented in data.fit}
    fit_runs = [run for run in campaign.runs if run.name in names]
    names = {segmented.name for segmented in data.held_out}
    held_out = [run for run in campaign.runs if run.name in names]
    fit_slips, held_slips = slips_of(fit_runs), slips_of(held_out)
    if not fit_slips:
        return None
    found = formulas(fit_slips, held_slips, _library(fit_slips, fit_runs))
    acting: list[tuple[Trial, tuple[Feature, ...]]] = []
    tasks = [(data, base, one, fit_runs) for one in _promising(found)]
    for each in mapped(_closed_loop, tasks):
        acting.append(each)
        if acting[-1][0].held_out_rms <= _ENOUGH:
            break
    trial, features = base, tuple[Feature, ...]()
    for tried, terms in sorted(acting, key=lambda pair: len(pair[1])):
        if tried.held_out_rms < (1.0 - _EARNED) * trial.held_out_rms:
            trial, features = tried, terms
    return _described(base, trial, features) if _worth(base, trial) else None


def _promising(found: Sequence[Formula]) -> Sequence[Formula]:
    """The one that the held-out runs choose, and one with another number of terms beside it.

    A term must earn its place: without taking away a part of what fewer terms leave, it is noise.
    """
    best = found[0]
    for one in found[1:]:
        if one.left_held_out < (1.0 - _EARNED) * best.left_held_out:
            best = one
    if not best.features:
        return []
    return [best, found[1]] if len(best.features) > 1 else found[1:3]


def _library(slips: Sequence[Slip], runs: Sequence[MeasuredRun]) -> list[Feature]:
    """With the strongest periods in time and along the surface, where there are any."""
    stretches = [slip.stretch for slip in slips]
    along_time = [run.motion.time for run in runs]
    places = [_by_run(slips, i, len(run.motion.time)) for i, run in enumerate(runs)]
    fastest = _HIGHEST * max(run.natural_frequency for run in runs) / (2.0 * np.pi)
    slowest = min(abs(run.surface_speed) for run in runs) or np.inf
    rates = [
        _strongest(strongest_period(stretches, along_time), fastest),
        _strongest(strongest_period(stretches, places), fastest / slowest),
    ]
    signs = {np.sign(run.surface_speed) for run in runs}
    x = np.concatenate([slip.moment.x for slip in slips])
    low, high = (float(end) for end in np.percentile(x, (0.5, 99.5)))
    return library(len(signs - {0.0}) > 1, (low, high), *rates)


def _strongest(period: Period | None, highest: float) -> float | None:
    """Rate of the strongest period that a block can follow, whether it is real or not."""
    if period is None:
        return None
    followed = period.rates <= highest
    if not followed.any():
        return None
    return float(period.rates[followed][period.power[followed].argmax()])


def _by_run(slips: Sequence[Slip], run: int, count: int) -> np.ndarray:
    """(n,) place on the surface at the samples of a run; those outside all stretches are NaN."""
    place = np.full(count, np.nan)
    for slip in slips:
        if slip.stretch.track == run:
            place[slip.stretch.rows] = slip.moment.place
    return place


def _closed_loop(
    data: Data, base: Trial, best: Formula, runs: Sequence[MeasuredRun]
) -> tuple[Trial, tuple[Feature, ...]]:
    """The force in the model, fitted in short segments and judged in long ones; its features."""
    friction, best = _friction(best, runs)
    segmented_runs = [
        tuple(forced(segmented, best.features) for segmented in part)
        for part in (data.fit, data.short, data.held_out, data.held_out_short)
    ]
    free_parameters = tuple(
        FreeParameter(key(i), float(c), _STEP * abs(float(c)))
        for i, c in enumerate(best.coefficients)
    )
    acting = Data(*segmented_runs)
    model = extended(base.model, Candidate("empirical", "formula", free_parameters), friction)
    trial = try_model(acting, model, coarse_fit(acting, model, _ROUNDS), rounds=0)
    return trial, best.features


def _friction(best: Formula, runs: Sequence[MeasuredRun]) -> tuple[dict[str, float], Formula]:
    """Where the fit starts: kinetic from the slips, static from the break-aways under the force.

    Where these differ between the two directions of the surface, the formula gets a term for it.
    """

    def force(m):
        return sum(c * f.of(m) for c, f in zip(best.coefficients, best.features, strict=True))

    signed = [[run for run in runs if np.sign(run.surface_speed) == sign] for sign in (1.0, -1.0)]
    seen = [float(np.median(found)) for those in signed if (found := holding(those, force))]
    mu_s = float(np.mean(seen)) if seen else _UNSEEN_RATIO * best.mu_k
    friction = {"friction.mu_k": best.mu_k, "friction.mu_s": max(mu_s, best.mu_k)}
    if len(seen) < 2 or abs(seen[0] - seen[1]) < _UNLIKE * mu_s:
        return friction, best
    terms = (*best.features, HELD)
    coefficients = np.append(best.coefficients, 0.5 * (seen[0] - seen[1]))
    return friction, replace(best, features=terms, coefficients=coefficients)


def _worth(base: Trial, trial: Trial) -> bool:
    before, after = (max(t.held_out_rms**2 - 1.0, 0.0) for t in (base, trial))
    return after < (1.0 - _WORTH) * before


def _described(base: Trial, trial: Trial, features: Sequence[Feature]) -> dict[str, Any]:
    values = trial.fitted.values
    terms = [Term(f, float(values[key(i)])) for i, f in enumerate(features)]
    text = formula(terms)
    gaps = {
        "fit_gap_before": base.fitted.rms_residual(), "fit_gap_after": trial.fitted.rms_residual(),
        "held_out_gap_before": base.held_out_rms, "held_out_gap_after": trial.held_out_rms,
    }  # fmt: skip
    return {
        "kind": "empirical",
        "formula": text,
        "terms": [
            {"feature": t.feature.name or "1", "coefficient": t.coefficient, "unit": t.feature.unit}
            for t in terms
        ],  # fmt: skip
        "parameters": {
            name: float(value) for name, value in values.items() if name.startswith("friction.")
        },
        **{name: float(value) for name, value in gaps.items()},
        "text": (
            f"{text} (empirical, no catalogued effect; held-out gap {base.held_out_rms:.3g} "
            f"to {trial.held_out_rms:.3g})"
        ),
    }
