"""A model at its best: aligned, its numbers as the mixed model about that has them, aligned anew.

In every turn the shared numbers (friction, contact, what an effect adds) take the step that the
mixed model asks for, what belongs to runs and segments follows, and the fit is laid along the data
again. The spreads of friction are those of largest likelihood, half normal about none.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import minimize
from stickslip.effects.candidate import OFFSETS, FreeParameter

from cosim.gap.data import MeasuredRun
from cosim.gap.estimation.drive import FRICTION_OFFSET, LOADING, SPEED_OFFSET, SPRINGS_OFFSET
from cosim.gap.estimation.fit import fit, fit_runs, follow, with_columns
from cosim.gap.estimation.fitted import Fitted, Point, start
from cosim.gap.estimation.initial_states import with_lost_velocities
from cosim.gap.estimation.phases import with_phases
from cosim.gap.estimation.problem import Problem
from cosim.gap.estimation.segmented_run import SegmentedRun
from cosim.gap.estimation.trial import Model
from cosim.processes import Map, map_here

from .alignment import LOOSELY, NEAR, SPRINGS, aligned, loosened
from .mixed import Law, MixedModel, Solution
from .products import LEAST, MOST, USUAL, Spreads, deviations, mixed_model

#: Steps of the search for spreads.
STEPS, _FEWER = 12, 5
#: Most turns of a model that is carried to its end.
_MOST_TURNS = 20
#: Turns, rounds of the fit in each, and how far what is a run's own may follow in one.
TURNS, _ROUNDS, _SETTLES, _FOLLOWS = 8, 2, 3, 200.0
#: Most turns with runs that are alike.
_SAME = 5
#: Part of a step that a turn takes, and whether what is a run's own is loose; the next where one
#: leads nowhere any more.
_WAYS = ((1.0, False), (0.4, False), (0.3, True))
#: What is a run's own is never held closer than this: a fit would stand still.
HELD, HELD_SPRINGS = Spreads(2e-3, 1e-3, 2e-3, 0.1, 5e-4), 1e-3
#: Rounds in which a run's own follow a wave: without it, they made up for it.
_WAVES = 6
#: A model that leaves so much wherever it is laid is wrong; it takes no further turn after one that
#: gained less than this part of what is left.
_POOR, _LEADS_ON = 2.0, 0.1
#: A run is astray that leaves so much a sample.
_ASTRAY = 1.1
#: A model gains by further turns at most so many times what a linear one would.
REACH = 3.0
#: A turn that gains less leads nowhere.
_ENOUGH = 0.3


@dataclass(frozen=True)
class Settled:
    """A model at its best.

    Attributes
    ----------
    model : what is free and set
    problem, fitted : the aligned fit about which the mixed model is taken
    mixed, solution, ahead : that model, its solution, and the spreads that are likeliest there
    promised : -2 ln likelihood of the runs for fitting, with what is usual of spreads, at the
        solution, as far as all is linear
    deviance, spreads, left_out : the same where the model stands, with the spreads that are
        likeliest there, and (runs,) -2 ln likelihood of every run with them, predicted from the
        others: what is promised far away need not be kept
    loose : the same model laid loosely along the data, if it began there
    """

    model: Model
    problem: Problem
    fitted: Fitted
    mixed: MixedModel
    solution: Solution
    ahead: Spreads
    promised: float
    deviance: float
    spreads: Spreads
    left_out: np.ndarray
    loose: Settled | None = None

    @property
    def rows(self) -> int:
        """Measured samples of all runs and channels."""
        return sum(run.segment_of_rows().size for run in self.problem.segmented_runs)

    @property
    def evidence(self) -> float:
        """-2 ln probability of all runs: those for fitting, and those held out as predicted."""
        held_out = [run.held_out for run in self.mixed.runs]
        return self.deviance + float(self.left_out[held_out].sum())

    @property
    def promise(self) -> float:
        """The evidence, were all linear: of a model that is on its way."""
        held_out = [run.held_out for run in self.mixed.runs]
        return self.promised + float(self.solution.left_out[held_out].sum())

    @property
    def springs(self) -> float:
        """How far a run's springs may be off: NEAR or FAR, or less, where they are held."""
        said = next(free.prior for free in self.problem.own if free.key == SPRINGS_OFFSET)
        return said or NEAR

    @property
    def reach(self) -> float:
        """The least -2 ln evidence that it may be expected to come to: all is but nearly linear."""
        return self.evidence - REACH * (self.evidence - self.promise)

    @property
    def values(self) -> dict[str, float]:
        """Shared numbers as the mixed model has them."""
        shared = self.fitted.point.shared + self.solution.values
        pairs = zip(self.problem.shared, shared, strict=True)
        return {free.key: free.value(free.inside(s)) for free, s in pairs}

    @property
    def errors(self) -> dict[str, float]:
        """Standard deviations of the shared numbers, in steps of each."""
        covariance = np.linalg.pinv(self.solution.information, hermitian=True)
        sizes = np.sqrt(np.clip(np.diag(covariance), 0.0, None))
        return {f.key: float(s) for f, s in zip(self.problem.shared, sizes, strict=True)}

    @property
    def squares(self) -> float:
        """Sum of squared residuals of the aligned fit, over measured samples."""
        runs = zip(self.problem.segmented_runs, self.fitted.residuals, strict=True)
        return float(sum(np.sum(r[: run.segment_of_rows().size] ** 2) for run, r in runs))

    @property
    def rms_residual(self) -> float:
        """Of the aligned fit: what no friction of any stretch takes away."""
        return float(np.sqrt(self.squares / self.rows))


def settled(
    segmented: Sequence[SegmentedRun],
    runs: Sequence[MeasuredRun],
    model: Model,
    before: Settled | None = None,
    turns: int = TURNS,
    mapped: Map = map_here,
    springs: float | None = None,
) -> Settled:
    """The model at its best, from where a simpler one was left or from the balance of forces.

    mapped : over runs; springs : from the balance of forces, see `aligned`
    """
    held_out = [run.hold_out for run in runs]
    if before is None:
        problem, fitted = aligned(segmented, runs, model, mapped, springs)
        spreads = Spreads()
    else:
        free_parameters = loosened(model.free_parameters, before.springs)
        problem = Problem(segmented, free_parameters, model.settings, LOOSELY)
        point = _carried(problem, before)
        new = {free.key for free in problem.own} - {free.key for free in before.problem.own}
        waves = any(key.endswith("phase_deg") for key in new)
        point = with_phases(problem, point, new)
        fitted = fit_runs(problem, point, _WAVES if waves else 1, mapped)
        fitted = with_columns(problem, fitted, mapped=mapped)
        spreads = before.ahead
    begun = _solved(model, problem, fitted, held_out, spreads, STEPS)
    loose = _loosely(begun, turns, mapped)
    if loose.rms_residual > _POOR or (before is not None and turns < TURNS):
        return loose
    return replace(ended(loose, mapped), loose=loose)


def _loosely(best: Settled, turns: int, mapped: Map) -> Settled:
    """A model with its shared numbers fitted and all that is a run's own loose."""
    part = 1.0
    for _ in range(turns):
        now = _turned(best, best.ahead, part, True, mapped)
        gained = best.promised - now.promised
        best = now if gained > 0.0 else best
        poor = best.rms_residual > _POOR and gained < _LEADS_ON * best.promised
        if poor or (gained < _ENOUGH and part < 1.0):
            break
        part = 0.3 if gained < _ENOUGH else 1.0
    return best


def carried_on(
    best: Settled, turns: int = TURNS, mapped: Map = map_here, beyond: float = np.inf
) -> Settled:
    """A model on its way, so many turns further, unless it stays ``beyond`` (see `ended`).

    A turn that holds what is a run's own as its spreads say ends where the mixed model is taken
    about its own mode; where the model is wrong that leads nowhere, and one by loose numbers does.
    """
    ways = list(_WAYS)
    for _ in range(turns):
        if best.deviance - best.promised < _ENOUGH or best.reach > beyond:  # no step leads on
            break
        now = _turned(best, best.ahead, *ways[0], mapped)
        gained = best.evidence - now.evidence
        best = now if gained > 0.0 else best
        if gained < _ENOUGH:
            ways.pop(0)
            if not ways:
                break
    return best


def ended(best: Settled, mapped: Map = map_here, beyond: float = np.inf) -> Settled:
    """A model on its way, carried on to its end.

    beyond : -2 ln evidence; a model that cannot be expected to come so low is left as it is
    """
    if best.reach > beyond:
        return best
    return carried_on(repeatable(best, mapped), _MOST_TURNS, mapped, beyond)


def repeatable(best: Settled, mapped: Map = map_here) -> Settled:
    """The model as if every run were like every other, if that is better.

    Laid loosely along the data, friction of a run and the tracker's zero may have made up for one
    another; a model that has all there is finds back from there.
    """
    same = Spreads(*np.minimum(np.array(best.ahead), np.array(HELD)))
    if best.ahead.friction < 2.0 * HELD.friction and best.ahead.zero < 2.0 * HELD.zero:
        return best
    found = [best]
    for turn in range(_SAME):
        from_here = _with_contact_anew(found[-1], same) if turn == 0 else found[-1]
        found.append(_turned(from_here, same, 1.0, False, mapped))
        if found[-1].deviance - found[-1].promised < _ENOUGH:
            break
    return min(found, key=lambda each: each.evidence)


def _with_contact_anew(best: Settled, spreads: Spreads) -> Settled:
    """With a step that takes the contact back to where it set out, if it has left its range.

    At the end of its range a contact's shape is not felt any more, and would stay.
    """
    gone = {"friction.transition_speed", "friction.transition_exponent", LOADING}
    shared, point = best.problem.shared, best.fitted.point.shared
    at_end = any(
        f.key == "friction.transition_speed" and not f.low * 1.1 < f.value(s) < f.high / 1.1
        for f, s in zip(shared, point, strict=True)
    )
    if not at_end:
        return best
    wide = deviations(best.problem, best.fitted, best.model.free_parameters, spreads)
    held = [f.key in gone for f in shared]
    back = np.array([f.scaled(f.start) for f in shared]) - point
    wide = replace(
        wide, low=np.where(held, back - 1e-6, wide.low), high=np.where(held, back + 1e-6, wide.high)
    )
    solution = best.mixed.solved(best.mixed.forms(wide), wide, predict=False)
    return replace(best, solution=solution, ahead=spreads)


def _turned(best: Settled, spreads: Spreads, part: float, loosely: bool, mapped: Map) -> Settled:
    """A part of a step of a model, with what is a run's own held loosely or as spreads say."""
    problem = best.problem
    if not loosely:
        held = Spreads(*map(max, spreads, HELD))
        own = as_meant(best.model.free_parameters, held)
        own = (*own, replace(SPRINGS, prior=HELD_SPRINGS))
        local = (held.stretch, held.static)
        problem = Problem(problem.segmented_runs, own, problem.settings, local)
    if spreads != best.ahead:
        wide = deviations(best.problem, best.fitted, best.model.free_parameters, spreads)
        best = replace(
            best, solution=best.mixed.solved(best.mixed.forms(wide), wide, predict=False)
        )
    held_out = [run.held_out for run in best.mixed.runs]
    fitted = _moved(problem, best, part, _ROUNDS if loosely else _SETTLES, mapped)
    return _solved(best.model, problem, fitted, held_out, spreads, _FEWER)


def as_meant(
    free_parameters: Sequence[FreeParameter], spreads: Spreads
) -> tuple[FreeParameter, ...]:
    """Free parameters with what is a run's own as far apart as these spreads say."""
    widths = {FRICTION_OFFSET: spreads.friction, SPEED_OFFSET: spreads.speed}
    return tuple(
        replace(f, prior=widths.get(f.key, (f.prior or 1.0) * spreads.zero))
        if f.key in widths or f.key in OFFSETS
        else f
        for f in free_parameters
    )


def _carried(problem: Problem, before: Settled) -> Point:
    """Where a simpler model was left; what it had not sets out as it starts."""
    values, point = before.fitted.values, before.fitted.point
    shared = np.array([free.scaled(values.get(free.key, free.start)) for free in problem.shared])
    own = [
        np.array(
            [
                free.scaled(before.fitted.own_values(i).get(free.key, free.start))
                for free in problem.own
            ]
        )
        for i in range(len(point.states))
    ]
    return Point(shared, tuple(own), point.states)


def _moved(problem: Problem, now: Settled, part: float, rounds: int, mapped: Map) -> Fitted:
    """One step of the shared numbers, and laid along the data again."""
    step = now.solution.values
    columns = [
        replace(c, longest=np.full(len(problem.own), _FOLLOWS)) for c in now.fitted.derivatives
    ]
    point, _ = problem.tried(now.fitted.point, part * step, columns)
    fitted = follow(problem, point, now.fitted.derivatives, rounds, mapped)
    point = with_lost_velocities(problem, fitted)
    if point is not fitted.point:
        fitted = follow(problem, point, fitted.derivatives, rounds, mapped)
    found = _with_lost_runs_found(problem, fitted, rounds)
    return fitted if found is fitted else with_columns(problem, found, mapped=mapped)


def _with_lost_runs_found(problem: Problem, fitted: Fitted, rounds: int) -> Fitted:
    """Runs that were carried astray, from the states read off the data; the very same if none."""
    astray = {
        run
        for run, segmented in enumerate(problem.segmented_runs)
        if problem.misfit(run, fitted.residuals[run]) > _ASTRAY * segmented.segment_of_rows().size
    }
    if 2 * len(astray) > len(fitted.residuals):  # it is the model that is wrong
        return fitted
    alone = [fitted.of_run(run) for run in range(len(fitted.residuals))]
    found = [
        _found_again(problem.of_run(run), each, rounds) if run in astray else each
        for run, each in enumerate(alone)
    ]
    if all(new is old for new, old in zip(found, alone, strict=True)):
        return fitted
    return Fitted.joined(found)


def _found_again(problem: Problem, fitted: Fitted, rounds: int) -> Fitted:
    """One run, from the states read off the data and with the phases that it has, if better."""
    begun = start(problem.segmented_runs, problem.free_parameters)
    waves = [j for j, free in enumerate(problem.own) if free.key.endswith("phase_deg")]
    first = begun.own[0].copy()
    first[waves] = fitted.point.own[0][waves]
    point = Point(fitted.point.shared, (first,), begun.states)
    again = fit(problem, point, 2 * rounds, fixed=True)
    return again if again.cost < fitted.cost else fitted


def _solved(model, problem, fitted, held_out, spreads: Spreads, steps: int) -> Settled:
    mixed = mixed_model(problem, fitted, (), held_out, map_here)
    tight = model.free_parameters
    found, promised = best_spreads(mixed, problem, fitted, tight, spreads, steps=steps)
    wide = deviations(problem, fitted, tight, found)
    solution = mixed.solved(mixed.forms(wide), wide)
    deviance, standing, left_out = (
        promised + solution.here - solution.deviance,
        found,
        solution.left_out,
    )
    if deviance - promised > _ENOUGH:  # other spreads may be likelier here
        about = mixed, problem, fitted, tight, found
        other, least = best_spreads(*about, steps=steps, here=True)
        if least < deviance:
            wide = deviations(problem, fitted, tight, other)
            deviance, standing = least, other
            left_out = mixed.solved(mixed.forms(wide), wide).left_out
    return Settled(
        model, problem, fitted, mixed, solution, found, promised, deviance, standing, left_out
    )


def best_spreads(
    mixed: MixedModel,
    problem: Problem,
    fitted: Fitted,
    tight: Sequence[FreeParameter],
    start: Spreads,
    laws: Sequence[Law] = (),
    steps: int = STEPS,
    here: bool = False,
) -> tuple[Spreads, float]:
    """Spreads of largest likelihood, half normal about none, and -2 ln of it.

    here : of the model where it stands, and not at the solution
    """
    usual = np.array(USUAL)

    def deviance(logarithms: np.ndarray) -> float:
        spreads = np.exp(logarithms)
        wide = deviations(problem, fitted, tight, Spreads(*spreads))
        found = mixed.solved(mixed.forms(wide), wide, laws, predict=False)
        return (found.here if here else found.deviance) + float(np.sum((spreads / usual) ** 2))

    low, high = np.log(np.array(LEAST)), np.log(np.array(MOST))
    first = np.clip(np.log(np.array(start)), low + 0.3, high)
    options = {"maxiter": steps, "ftol": 1e-7}
    bounds = list(zip(low, high, strict=True))
    found = minimize(
        deviance, first, method="L-BFGS-B", bounds=bounds, options=options, jac="2-point"
    )
    return Spreads(*np.exp(found.x)), float(found.fun)
