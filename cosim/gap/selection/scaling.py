"""How an effect's strength goes with mass, speed and stiffness, where not as the catalogue has it.

A law can be right and its strength another in every set-up: heat weakens by the joule, or by the
joule and kilogram. About the settled model that holds the law, every run answers linearly to a
strength of its own. These are

    s_r = s (q_r / q_0)^n (1 + e_r),      e_r ~ N(0, tau^2),

with n the exponent of a quantity q beyond what the law itself says, and tau what strengths differ
by from run to run without it. tau and the spread of friction from run to run are those of largest
likelihood, all else integrated over (see `evidence.mixed`); n is told from nothing by Student's
t, with degrees of freedom by Satterthwaite (Biometrics Bulletin 2, 1946): where strengths scatter,
runs are what counts, where they do not, samples.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import minimize
from scipy.stats import chi2
from scipy.stats import t as student
from stickslip.effects.candidate import Candidate, FreeParameter

from cosim.gap.data import MeasuredRun
from cosim.gap.estimation.drive import (
    FRICTION_OFFSET,
    REFERENCE,
    SCALING,
    quantities_of,
    strength_keys,
)
from cosim.gap.estimation.segmented_run import SegmentedRun
from cosim.gap.estimation.trial import Model
from cosim.gap.evidence.mixed import Deviations, MixedModel, RunProducts, eliminated
from cosim.gap.evidence.products import LEAST, MOST, USUAL, deviations
from cosim.gap.evidence.settled import Settled, settled

#: What a strength may go with; each is looked at where it varies in the runs for fitting.
QUANTITIES = ("mass", "speed", "stiffness")
#: An exponent is stated where none at all were this unlikely, over all quantities that vary.
LEVEL = 0.05
#: One that is less unlikely than this is not looked for any further.
_PERHAPS = 0.1
#: Part of what a model leaves that exponents must promise to take, to be looked for any further.
_REPAIRS = 0.01
#: Part of the probability that an interval holds.
BAND = 0.90
#: No law of friction goes with a higher power.
HIGHEST = 4.0
#: What strengths differ by from run to run: the least, which is nothing, and the most, parts.
_SAME, _ANY = 1e-3, 1.0
#: A search ends where -2 ln likelihood, some 1e4, falls by less than a thousandth.
_CLOSE = {"ftol": 1e-7}
#: Difference of an exponent over which the curvature of -2 ln likelihood is taken.
_SMALL = 0.02


@dataclass(frozen=True)
class Exponent:
    """By which power of a quantity a strength goes, beyond what the law says.

    Attributes
    ----------
    value, low, high : the exponent and its 90 % interval
    gain : -2 ln likelihood that it takes away
    p : probability of so large a one in runs without: the larger of Student's and of the ratio's
    needed : p is below the level, shared by the quantities that vary
    instead : quantities that vary with this one, so that these runs cannot tell which it is
    """

    value: float
    low: float
    high: float
    gain: float
    p: float
    needed: bool
    instead: tuple[str, ...] = ()


@dataclass(frozen=True)
class Strengths:
    """A settled model's runs, as they answer to the strength of one effect.

    Attributes
    ----------
    runs : of every run, products of [own | shared | e0], states integrated over
    offsets : (runs, k) where a run's own stand
    shared : (g,) scaled values of the shared numbers, those that are no strength 0
    centre : (g,) where they stand, 0 their centre
    wide : standard deviations of the settled model
    friction : which of the run's own is its friction
    held_out : (runs,) never used for fitting
    """

    runs: tuple[np.ndarray, ...]
    offsets: np.ndarray
    shared: np.ndarray
    centre: np.ndarray
    wide: Deviations
    friction: int
    held_out: tuple[bool, ...]

    def model(self, parts: np.ndarray) -> MixedModel:
        """With strengths that are these parts (runs,) of the campaign's, and e of each its own."""
        runs = [
            RunProducts(_with_part(gram, len(own), self.shared, part), np.zeros((1, 0)), own, out)
            for gram, own, part, out in zip(
                self.runs, _with_own(self.offsets), parts, self.held_out, strict=True
            )
        ]
        return MixedModel(runs, self.centre, ())

    def deviations(self, friction: float, differ: float) -> Deviations:
        """With these spreads of friction and of strengths from run to run."""
        own = np.append(self.wide.own, differ)
        own[self.friction] *= friction
        return replace(self.wide, states=np.zeros(0), own=own)

    def deviance(self, logarithms: np.ndarray, parts: np.ndarray) -> float:
        """-2 ln likelihood but for a constant; of the spreads of friction and strengths."""
        friction, differ = np.exp(logarithms)
        wide = self.deviations(friction, differ)
        mixed = self.model(parts)
        found = mixed.solved(mixed.forms(wide), wide, predict=False).deviance
        return found + (friction / USUAL.friction) ** 2


def exponents(
    base: Settled, runs: Sequence[MeasuredRun], candidate: Candidate, level: float = LEVEL
) -> dict[str, Exponent]:
    """By quantity that varies, of the strength of a candidate that is in a settled model.

    Quantities enter one after the other, best first, as long as one is needed; each is stated
    beside those that are. Empty where the model has nothing of the effect, and for runs too few.
    """
    strengths = strengths_of(base, candidate)
    fitted = [i for i, run in enumerate(runs) if not run.hold_out]
    varied = {name: values for name, values in _logarithms(runs).items() if np.ptp(values[fitted])}
    chosen: list[str] = []
    found: dict[str, Exponent] = {}
    if not strengths.shared.any():
        return found
    while len(chosen) < len(varied) and len(fitted) > len(chosen) + 2:
        beside = [varied[name] for name in chosen]
        before = _best(strengths, beside)
        rest = {name: values for name, values in varied.items() if name not in chosen}
        each = {
            name: _exponent(strengths, [*beside, values], before[1], fitted, level / len(varied))
            for name, values in rest.items()
        }
        found.update(each)
        best = max(each, key=lambda name: each[name].gain)
        if not each[best].needed:
            break
        chosen.append(best)
    for name in found:
        also = tuple(o for o in varied if o != name and _same(varied[o], varied[name], fitted))
        found[name] = replace(found[name], instead=also)
    return found


def strengths_of(base: Settled, candidate: Candidate) -> Strengths:
    """Of a candidate that is in a settled model."""
    problem, fitted = base.problem, base.fitted
    wide = deviations(problem, fitted, base.model.free_parameters, base.ahead)
    keys = strength_keys(candidate.effect)
    point = fitted.point.shared
    shared = np.array(
        [s if f.key in keys else 0.0 for f, s in zip(problem.shared, point, strict=True)]
    )
    friction = [free.key for free in problem.own].index(FRICTION_OFFSET)
    own = wide.own.copy()
    own[friction] = 1.0 / problem.own[friction].step  # times the spread that is looked for
    grams = []
    for run in base.mixed.runs:
        rest, _ = eliminated(run.grams, wide.states, run.states, run.states.shape[1])
        grams.append(rest.sum(axis=0))
    return Strengths(
        tuple(grams),
        np.array([run.own for run in base.mixed.runs]),
        shared,
        base.mixed.shared,
        replace(wide, own=own),
        friction,
        tuple(run.held_out for run in base.mixed.runs),
    )


def scaled(model: Model, candidate: Candidate, found: Mapping[str, Exponent], runs) -> Model:
    """The model with those exponents of a candidate's strength free that are needed.

    They count from the geometric mean of the runs for fitting.
    """
    needed = {name: one for name, one in found.items() if one.needed}
    free = tuple(
        FreeParameter(f"{SCALING}{name}.{candidate.effect}", one.value, 0.1, -HIGHEST, HIGHEST)
        for name, one in needed.items()
    )
    return replace(
        model,
        free_parameters=(*model.free_parameters, *free),
        settings={
            **model.settings,
            **{REFERENCE + name: _reference(runs, name) for name in needed},
        },
    )


@dataclass(frozen=True)
class Rescaled:
    """A settled model whose strength goes with a quantity, and what that repairs.

    Attributes
    ----------
    settled : with the exponents fitted
    gain : -2 ln likelihood of the runs for fitting that they take away
    left_out : (runs,) the same of every run, predicted from the others
    intervals : exponent's key -> its 90 % interval
    """

    settled: Settled
    gain: float
    left_out: np.ndarray
    intervals: Mapping[str, tuple[float, float]]

    @property
    def repairs(self) -> bool:
        """Whether runs are predicted better with the exponents, of which each is surely not 0."""
        sure = all(low > 0.0 or high < 0.0 for low, high in self.intervals.values())
        return bool(self.intervals) and sure and float(self.left_out.sum()) > 0.0


def rescaled(
    segmented: Sequence[SegmentedRun],
    runs: Sequence[MeasuredRun],
    base: Settled,
    candidate: Candidate,
    found: Mapping[str, Exponent],
) -> Rescaled:
    """The base settled anew with the exponents that are needed among its free parameters."""
    after = settled(segmented, runs, scaled(base.model, candidate, found, runs), base)
    far = {f.key: student.ppf(0.5 + 0.5 * BAND, len(runs)) * f.step for f in after.problem.shared}
    intervals = {
        key: (value - far[key] * after.errors[key], value + far[key] * after.errors[key])
        for key, value in after.values.items()
        if key.startswith(SCALING)
    }
    left_out = base.left_out - after.left_out
    return Rescaled(after, base.deviance - after.deviance, left_out, intervals)


def better_rescaled(
    segmented: Sequence[SegmentedRun],
    runs: Sequence[MeasuredRun],
    base: Settled,
    candidate: Candidate,
) -> Settled:
    """The base, or with exponents that a candidate's strength needs, if runs are likelier so.

    Where none is surely needed, friction of every run may have made up for the likeliest. Those
    that do not promise to take a hundredth of what is left repair nothing.
    """
    tested = exponents(base, runs, candidate)
    left = base.evidence - base.rows
    if max((one.gain for one in tested.values()), default=0.0) <= max(0.0, _REPAIRS * left):
        return base
    if not any(one.needed for one in tested.values()):
        name = min(tested, key=lambda each: tested[each].p)
        if tested[name].p > _PERHAPS:
            return base
        tested = {name: replace(tested[name], needed=True)}
    after = rescaled(segmented, runs, base, candidate, tested)
    return after.settled if after.repairs and after.settled.evidence < base.evidence else base


def fitted_exponents(settled: Settled, candidate: Candidate, runs: int) -> dict[str, Exponent]:
    """Exponents of a candidate's strength that are in the model, of so many runs."""
    found = {}
    for key, value in settled.values.items():
        quantity, _, effect = key.removeprefix(SCALING).partition(".")
        if key.startswith(SCALING) and effect == candidate.effect:
            free = next(f for f in settled.problem.shared if f.key == key)
            error = free.step * settled.errors[key]
            reach = float(student.ppf(0.5 + 0.5 * BAND, runs)) * error
            p = float(2.0 * student.sf(abs(value) / error, runs))
            found[quantity] = Exponent(
                value, value - reach, value + reach, (value / error) ** 2, p, True
            )
    return found


def _exponent(strengths, logarithms, before: float, fitted, level: float) -> Exponent:
    """The last of the quantities' (each (runs,) ln (q / q_0)); before : deviance without it."""
    at, deviance, spreads = _best(strengths, logarithms)
    error, noise = (
        _error(strengths, logarithms, at, np.append(spreads[0], differ))
        for differ in (spreads[1], np.log(_SAME))
    )
    from_runs = max(1.0 - (noise / error) ** 2, 1e-6)  # part of the variance that is estimated
    freedom = (len(fitted) - 1 - len(logarithms)) / from_runs**2
    value = float(at[-1])
    gain = max(before - deviance, 0.0)
    # strengths that scatter explain the same with few runs: the exponent has to beat that as well
    p = max(2.0 * student.sf(abs(value) / error, freedom), chi2.sf(gain, 1))
    reach = float(student.ppf(0.5 + 0.5 * BAND, freedom) * error)
    return Exponent(value, value - reach, value + reach, gain, float(p), bool(p < level))


def _best(strengths: Strengths, logarithms) -> tuple[np.ndarray, float, np.ndarray]:
    """Exponents, -2 ln likelihood there, and the logarithms of the two spreads."""
    count = len(logarithms)

    def deviance(numbers: np.ndarray) -> float:
        return strengths.deviance(numbers[count:], _parts(numbers[:count], logarithms, strengths))

    bounds = [(-HIGHEST, HIGHEST)] * count
    bounds += [(np.log(LEAST.friction), np.log(MOST.friction)), (np.log(_SAME), np.log(_ANY))]
    starts = [
        np.array([*[first] * count, np.log(USUAL.friction), np.log(differ)])
        for first, differ in (((0.0, 0.1), (-1.0, 0.03), (1.0, 0.03)) if count else ((0.0, 0.1),))
    ]
    found = [
        minimize(deviance, s, method="L-BFGS-B", bounds=bounds, options=_CLOSE) for s in starts
    ]
    best = min(found, key=lambda one: one.fun)
    return best.x[:count], float(best.fun), best.x[count:]


def _error(strengths: Strengths, logarithms, at: np.ndarray, spreads: np.ndarray) -> float:
    """Standard error of the last exponent, the others free."""
    steps = _SMALL * np.eye(at.size)

    def deviance(numbers: np.ndarray) -> float:
        return strengths.deviance(spreads, _parts(numbers, logarithms, strengths))

    curvature = np.array(
        [
            [
                (
                    deviance(at + a + b)
                    - deviance(at + a - b)
                    - deviance(at - a + b)
                    + deviance(at - a - b)
                )
                for b in steps
            ]
            for a in steps
        ]
    ) / (4.0 * _SMALL**2)
    return float(np.sqrt(max(np.linalg.pinv(0.5 * curvature)[-1, -1], 1e-12)))


def _parts(powers: np.ndarray, logarithms, strengths: Strengths) -> np.ndarray:
    """(runs,) strengths as parts of the campaign's."""
    if not len(logarithms):
        return np.ones(len(strengths.runs))
    return np.exp(powers @ np.array(logarithms))


def _with_part(gram: np.ndarray, own: int, shared: np.ndarray, part: float) -> np.ndarray:
    """(1, n + 1, n + 1) products with strengths so many times the campaign's.

    Columns [own, T, e0] become [own, e, T part, e0 + T s (part - 1)] for strengths s, and e the
    response to a relative change of them.
    """
    before = own - 1
    size = gram.shape[0]
    change = np.zeros((size, size + 1))
    change[range(before), range(before)] = 1.0
    strengths = slice(before, size - 1)
    change[strengths, before] = part * shared
    change[range(before, size - 1), range(own, size)] = np.where(shared != 0.0, part, 1.0)
    change[-1, -1] = 1.0
    change[strengths, -1] = (part - 1.0) * shared
    return (change.T @ gram @ change)[None]


def _with_own(offsets: np.ndarray) -> np.ndarray:
    """(runs, k + 1) with where e stands: at its centre."""
    return np.column_stack([offsets, np.zeros(len(offsets))])


def _logarithms(runs: Sequence[MeasuredRun]) -> dict[str, np.ndarray]:
    """By quantity (runs,) ln (q / q_0), q_0 the geometric mean of the runs for fitting."""
    return {
        name: np.log([quantities_of(run)[name] / _reference(runs, name) for run in runs])
        for name in QUANTITIES
    }


def _reference(runs: Sequence[MeasuredRun], quantity: str) -> float:
    values = [quantities_of(run)[quantity] for run in runs if not run.hold_out]
    return float(np.exp(np.mean(np.log(values))))


def _same(a: np.ndarray, b: np.ndarray, fitted: Sequence[int]) -> bool:
    """Whether one quantity is a power of the other in the runs for fitting."""
    return bool(abs(np.corrcoef(a[fitted], b[fitted])[0, 1]) > 1.0 - 1e-9)
