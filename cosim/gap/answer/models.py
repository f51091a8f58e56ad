"""Settled models as they are shown: fitted in long segments, with friction that scatters.

All models of a ladder scatter by what the last one leaves to chance, so that they compare: a poor
model's own spreads would hide what it lacks.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from cosim.gap.data import Campaign, MeasuredRun
from cosim.gap.estimation.fit import fit
from cosim.gap.estimation.fitted import Fitted, Point, shared_of
from cosim.gap.estimation.intervals import intervals
from cosim.gap.estimation.preparation import SHORT_CYCLES, Data, prepare
from cosim.gap.estimation.problem import Problem
from cosim.gap.estimation.segmented_run import SegmentedRun
from cosim.gap.estimation.trial import Model, Trial, carried_over, try_model
from cosim.gap.evidence.products import Spreads
from cosim.gap.evidence.settled import Settled
from cosim.gap.evidence.tight import followed, scattering, tight_point
from cosim.gap.fitted_model import fitted_model
from cosim.gap.result import FittedModel

#: Rounds in which states follow a model that is ranked and not shown, and in which it is fitted.
_FEW = 3
#: Standard deviations of a 95 % interval.
_NINETY_FIVE = 1.96


@dataclass(frozen=True)
class Bench:
    """The runs that models are fitted to and judged on.

    Attributes
    ----------
    campaign : with noise as it counts
    runs : those with tracks, cut down to what a fit needs
    short : every run in short segments
    data : the same and long ones, for fitting and held out
    planar : models move across the surface
    """

    campaign: Campaign
    runs: tuple[MeasuredRun, ...]
    short: tuple[SegmentedRun, ...]
    data: Data
    planar: bool

    @classmethod
    def of(cls, campaign: Campaign, planar: bool) -> Bench:
        """A campaign's runs with tracks, cut into segments."""
        runs = tuple(run for run in campaign.runs if run.track is not None)
        short = prepare(campaign, runs, planar, SHORT_CYCLES)
        pairs = list(zip(runs, short, strict=True))
        fit = [run for run in runs if not run.hold_out]
        held_out = [run for run in runs if run.hold_out]
        data = Data(
            prepare(campaign, fit, planar),
            tuple(cut for run, cut in pairs if not run.hold_out),
            prepare(campaign, held_out, planar),
            tuple(cut for run, cut in pairs if run.hold_out),
        )
        return cls(campaign, runs, short, data, planar)

    @property
    def fitted(self) -> list[int]:
        """Which of the runs are for fitting."""
        return [i for i, run in enumerate(self.runs) if not run.hold_out]

    @property
    def channels(self) -> list[str]:
        """Lengths that models are compared with."""
        along = ("x", "y") if self.planar else ("x",)
        return [name for name in along if name in self.campaign.noise]


def long_fit(bench: Bench, settled: Settled, spreads: Spreads) -> Trial:
    """A settled model fitted in long segments, and judged on the runs that were held out."""
    model = scattering(settled.model, spreads)
    problem = model.problem(bench.data.short)
    short = followed(problem, tight_point(settled, problem, bench.fitted))
    return try_model(bench.data, model, short)


def glance(bench: Bench, settled: Settled, spreads: Spreads) -> tuple[float, float]:
    """Gaps (fit, held out) of a settled model after a few rounds: what is ranked needs no more."""
    model, data = scattering(settled.model, spreads), bench.data
    problem, point = _long(model, settled, data.fit, data.short, bench.fitted)
    fitted = fit(problem, fit(problem, point, _FEW, fixed=True).point, _FEW)
    if not data.held_out:
        return (_left(problem, fitted),) * 2
    rest = [i for i in range(len(bench.runs)) if i not in bench.fitted]
    problem_held, point = _long(model, settled, data.held_out, data.held_out_short, rest)
    point = replace(point, shared=fitted.point.shared)
    return _left(problem, fitted), _left(problem_held, fit(problem_held, point, _FEW, fixed=True))


def _long(
    model: Model,
    settled: Settled,
    long: Sequence[SegmentedRun],
    short: Sequence[SegmentedRun],
    which: Sequence[int],
) -> tuple[Problem, Point]:
    """Some runs of a settled model in long segments, and where they stand."""
    problem = model.problem(long)
    point = tight_point(settled, model.problem(short), which)
    return problem, carried_over(problem, short, point)


def _left(problem: Problem, fitted: Fitted) -> float:
    """Root mean square residual of the measured samples."""
    rows = [run.segment_of_rows().size for run in problem.segmented_runs]
    squares = sum(float(r[:n] @ r[:n]) for r, n in zip(fitted.residuals, rows, strict=True))
    return math.sqrt(squares / sum(rows))


def shown(campaign: Campaign, bench: Bench, trial: Trial) -> FittedModel:
    """A trial as a fitted model of a campaign, in units of that campaign's noise."""
    parts = [(trial.model.problem(bench.data.fit), trial.fitted)]
    if bench.data.held_out:
        parts.append((trial.model.problem(bench.data.held_out), trial.held_out))
    return fitted_model(campaign, parts, intervals(trial))


def added(settled: Settled, keys: Sequence[str]) -> dict[str, tuple[float, float, float]]:
    """Of some of a settled model's numbers: value and 95 % interval."""
    values, errors, found = settled.values, settled.errors, {}
    for free in shared_of(settled.problem.free_parameters):
        if free.key in keys:
            at, wide = free.scaled(values[free.key]), _NINETY_FIVE * errors[free.key]
            ends = [free.value(free.inside(at + side * wide)) for side in (-1.0, 1.0)]
            found[free.key] = (values[free.key], min(ends), max(ends))
    return found
