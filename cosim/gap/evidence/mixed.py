"""A campaign as a linear mixed model about an aligned fit: every model of it by algebra alone.

About a fit that lies along the data (see `alignment`) the residuals answer linearly to everything:
to the segments' states and their friction (u), to what is a run's own (o), to the shared numbers
(t) and to what laws would add (l),

    e = e0 + X (u - u0) + O (o - o0) + T (t - t0) + L l,      e ~ N(0, 1),

u, o and t normal about their centres with stated standard deviations (infinite for positions and
velocities). Products of all columns, segment by segment, are all that is kept; a model is a choice
of laws and of standard deviations. Eliminating u and o leaves, for every run, a quadratic form in
(t, l): -2 ln likelihood of the run, u and o integrated over (Laird & Ware, Biometrics 38, 1982).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from scipy.optimize import lsq_linear


@dataclass(frozen=True)
class RunProducts:
    """Products of one run's columns, in steps of the free parameters.

    Attributes
    ----------
    grams : (segments, n, n) of the columns [u | o | t | l | e0] over each segment's rows
    states : (segments, m) where u stands in its steps, 0 its centre; NaN: no such number there
    own : (k,) where o stands
    held_out : never used for fitting
    """

    grams: np.ndarray
    states: np.ndarray
    own: np.ndarray
    held_out: bool


@dataclass(frozen=True)
class Deviations:
    """Standard deviations in steps of the free parameters: inf is anything.

    Attributes
    ----------
    states : (m,) of u, own : (k,) of o, shared : (g,) of t
    low, high : (g,) bounds of steps of t
    """

    states: np.ndarray
    own: np.ndarray
    shared: np.ndarray
    low: np.ndarray
    high: np.ndarray


@dataclass(frozen=True)
class RunForm:
    """-2 ln likelihood of a run as a quadratic form in z = (t - t0, l, 1): z' q z + constant."""

    form: np.ndarray
    constant: float


@dataclass(frozen=True)
class Solution:
    """A model's best shared numbers, and how well it predicts.

    Attributes
    ----------
    values : (g + c,) steps of t and strengths of the chosen laws
    information : (g + c, g + c) of them, half the Hessian of -2 ln likelihood
    deviance : -2 ln likelihood of the runs for fitting, priors included
    here : the same without the steps, where the mixed model is taken
    left_out : (runs,) -2 ln likelihood of every run, predicted from the others
    """

    values: np.ndarray
    information: np.ndarray
    deviance: float
    here: float
    left_out: np.ndarray


class MixedModel:
    """All runs, to be asked of any choice of laws.

    shared : (g,) where t stands, 0 its centre; laws : names of the laws' columns, in order
    """

    def __init__(self, runs: Sequence[RunProducts], shared: np.ndarray, laws: Sequence[str]):
        self.runs, self.shared, self.laws = tuple(runs), shared, tuple(laws)
        self._of_random: dict[bytes, _Random] = {}

    def __getstate__(self) -> dict:
        """What was eliminated is not sent to other processes: it is soon found again."""
        return {**self.__dict__, "_of_random": {}}

    def only(self, numbers: Sequence[int]) -> MixedModel:
        """The same with some of the laws alone."""
        first = self.runs[0].states.shape[1] + self.runs[0].own.size + self.shared.size
        keep = [*range(first), *(first + i for i in numbers), first + len(self.laws)]
        runs = [replace(run, grams=run.grams[:, keep][:, :, keep]) for run in self.runs]
        return MixedModel(runs, self.shared, [self.laws[i] for i in numbers])

    def forms(self, deviations: Deviations) -> list[RunForm]:
        """Of every run, in all shared numbers and all laws at once.

        Segment states and what is the run's own are integrated over.
        """
        random = np.isfinite(deviations.states)
        if random.tobytes() not in self._of_random:  # the same for all spreads that are tried
            self._of_random[random.tobytes()] = _random(self.runs, random)
        left, widths = self._of_random[random.tobytes()], deviations.states[random]
        rest, cost = eliminated(left.forms, widths, left.at, widths.size, left.inner)
        rest, cost = (np.add.reduceat(each, left.first, axis=0) for each in (rest, cost))
        own = np.array([run.own for run in self.runs])
        forms, more = eliminated(rest, deviations.own, own, own.shape[1])
        return [RunForm(*each) for each in zip(forms, (cost + more).tolist(), strict=True)]

    def solved(
        self,
        forms: Sequence[RunForm],
        deviations: Deviations,
        chosen: Sequence[Law] = (),
        predict: bool = True,
    ) -> Solution:
        """The model with these laws; a run's prediction is from the runs for fitting less itself.

        What is not known of the shared numbers is integrated over, so that a prediction is
        p(run | others) = p(run, others) / p(others).
        """
        count = self.shared.size
        keep = [*range(count), *(count + law.number for law in chosen), -1]
        parts = [f.form[np.ix_(keep, keep)] for f in forms]
        widths = np.concatenate([deviations.shared, [law.width for law in chosen]])
        centres = np.concatenate([self.shared, np.zeros(len(chosen))])
        low = np.concatenate([deviations.low, [law.low for law in chosen]])
        high = np.concatenate([deviations.high, [np.inf for _ in chosen]])
        prior = prior_form(widths, centres)
        said = widths[np.isfinite(widths)]
        price = 2.0 * float(np.sum(np.log(said)))
        fitted = [i for i, run in enumerate(self.runs) if not run.held_out]
        whole = prior + np.sum([parts[i] for i in fitted], axis=0)
        constant = sum(forms[i].constant for i in fitted)
        best = minimum(whole, low, high)
        evidence = _evidence(whole, best)
        left_out = np.empty(len(forms) if predict else 0)
        for i in range(left_out.size):
            other = whole + parts[i] if self.runs[i].held_out else whole - parts[i]
            difference = _evidence(other, minimum(other, low, high)) - evidence
            sign = 1.0 if self.runs[i].held_out else -1.0
            left_out[i] = sign * difference + forms[i].constant
        here = _evidence(whole, np.zeros(best.size))
        rest = price + constant
        return Solution(best, whole[:-1, :-1], evidence + rest, here + rest, left_out)


@dataclass(frozen=True)
class Law:
    """One of the laws' columns in a model: its number, the least strength, and what is usual."""

    number: int
    low: float = -np.inf
    width: float = np.inf


def prior_form(widths: np.ndarray, centres: np.ndarray) -> np.ndarray:
    """Quadratic form of normal priors: (centre + z)^2 / width^2."""
    weights = np.where(np.isfinite(widths), 1.0 / np.maximum(widths, 1e-12) ** 2, 0.0)
    size = widths.size
    form = np.zeros((size + 1, size + 1))
    form[np.arange(size), np.arange(size)] = weights
    form[:size, size] = form[size, :size] = weights * centres
    form[size, size] = float(weights @ centres**2)
    return form


def minimum(form: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Of a quadratic form within bounds."""
    scale = np.sqrt(np.clip(np.diag(form)[:-1], 1e-9, None))
    matrix, right = form[:-1, :-1] / np.outer(scale, scale), -form[:-1, -1] / scale
    values, vectors = np.linalg.eigh(matrix)
    values = np.clip(values, 1e-10, None)
    at = (vectors @ ((vectors.T @ right) / values)) / scale
    if np.all((low <= at) & (at <= high)):
        return at
    root = np.sqrt(values)[:, None] * vectors.T
    target = (vectors.T @ right) / np.sqrt(values)
    wide = np.where(high - low > 1e-9, high, low + 1e-9)
    found = lsq_linear(root, target, bounds=(low * scale, wide * scale), method="bvls")
    return np.clip(found.x / scale, low, high)


def _evidence(form: np.ndarray, at: np.ndarray) -> float:
    """-2 ln of the integral over the numbers (Laplace), but for a constant."""
    z = np.append(at, 1.0)
    matrix = form[:-1, :-1]
    size = np.linalg.slogdet(matrix + 1e-9 * np.eye(len(matrix)))[1] if len(matrix) else 0.0
    return float(z @ form @ z + size)


class _Random(NamedTuple):
    """All segments, those numbers of their states eliminated that may be anything.

    Attributes
    ----------
    forms : (s, n, n) of what is left, the states' other numbers (r of them) first
    at : (s, r) where those stand
    inner : (s, r, r) their products as they were before
    first : (runs,) number of the first segment of each
    """

    forms: np.ndarray
    at: np.ndarray
    inner: np.ndarray
    first: np.ndarray


def _random(runs: Sequence[RunProducts], random: np.ndarray) -> _Random:
    """random : (m,) which numbers of a state have a stated standard deviation"""
    grams = np.concatenate([run.grams for run in runs])
    at = np.concatenate([run.states for run in runs])
    (flat,), (stays,) = np.nonzero(~random), np.nonzero(random)
    order = [*flat, *stays, *range(random.size, grams.shape[1])]
    inner = grams[:, stays][:, :, stays]
    grams = grams[:, order][:, :, order]
    anything = np.full(flat.size, np.inf)
    forms, _ = eliminated(grams, anything, np.zeros((len(grams), flat.size)), flat.size)
    first = np.cumsum([0, *(len(run.grams) for run in runs[:-1])])
    return _Random(forms, at[:, stays], inner, first)


def eliminated(
    forms: np.ndarray,
    widths: np.ndarray,
    at: np.ndarray,
    count: int,
    inner: np.ndarray | None = None,
) -> tuple[np.ndarray, np.ndarray]:
    """Forms (b, n, n) without their first numbers, and (b,) what integrating over them costs.

    widths : (count,) standard deviations about centres from which the numbers stand ``at``
    (b, count); inf: flat, and then without a cost. The cost is the logarithm of a determinant:
    of ``inner`` (b, count, count), which may be other than the forms say, where flat numbers were
    eliminated before.
    """
    random = np.isfinite(widths)
    first = forms[:, :count, :count].copy()
    cross = forms[:, :count, count:].copy()
    rest = forms[:, count:, count:].copy()
    cost = np.zeros(len(forms))
    if random.any():
        scaled = widths[random]
        products = (first if inner is None else inner)[:, random][:, :, random]
        products = products * scaled[:, None] * scaled
        cost = np.linalg.slogdet(np.eye(scaled.size) + products)[1]
    weights = np.where(random, 1.0 / widths**2, 0.0)
    first[:, range(count), range(count)] += weights
    cross[:, :, -1] += weights * at
    rest[:, -1, -1] += at**2 @ weights
    scale = np.sqrt(np.clip(first[:, range(count), range(count)], 1e-12, None))
    first /= scale[:, :, None] * scale[:, None, :]
    first[:, range(count), range(count)] += 1e-10  # numbers that are not there, or not felt
    cross /= scale[:, :, None]
    return rest - np.swapaxes(cross, 1, 2) @ np.linalg.solve(first, cross), cost
