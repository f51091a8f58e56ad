"""Eigenmodes of an assembled heat conduction problem with Newton cooling, and how they relax.

With the eigenmodes K phi = lambda C phi, phi^T C phi = 1, of C u' + K u = 0 any piecewise constant
load is propagated exactly: by the time integrals of u' = -rate u + p with p constant over a step.
Rates may be complex.
"""

from typing import Generic, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh

from .arrays import Array

Numbers = TypeVar("Numbers", NDArray[np.float64], NDArray[np.complex128])

#: Modes that carry the heat of long times; see `eigenmodes`.
_SLOWEST = 40

#: Below this x the closed forms cancel; their Taylor series of 16 terms are then exact.
_SERIES_BELOW = 0.7
_TERMS = 16

#: Durations of steps of which what a body does in one is kept.
STEP_SIZES = 8


def eigenmodes(factor: Array, capacity: Array) -> tuple[Array, Array]:
    """Rates (n,) 1/s and shapes (n, n), shapes^T capacity shapes = 1.

    capacity (n, n) J/K; factor (any, n): its square F^T F is the form K, W/K.

    A dense eigensolver errs by rounding times the fastest rate, which over long runs is not small
    against the slowest. A Rayleigh-Ritz step with the form's factor among the slowest modes, and
    Rayleigh quotients for all, err by rounding.
    """
    shapes = eigh(factor.T @ factor, capacity)[1]
    slow = shapes[:, :_SLOWEST]
    powers = factor @ slow
    slow[:] = slow @ eigh(powers.T @ powers, slow.T @ capacity @ slow)[1]
    shapes /= np.sqrt(np.sum(shapes * (capacity @ shapes), axis=0))
    return np.sum(np.square(factor @ shapes), axis=0), shapes


def decay(x: Numbers) -> Numbers:
    """exp(-x)."""
    return np.exp(-x)


def mean_decay(x: Numbers) -> Numbers:
    """(1 - exp(-x)) / x, the mean of the decay over a step; 1 at x = 0."""
    safe = np.where(x == 0.0, 1.0, x)
    return np.where(x == 0.0, 1.0, -np.expm1(-safe) / safe)


def mean_response(x: Numbers) -> Numbers:
    """(exp(-x) - 1 + x) / x^2, the mean over a step of the response to p; 1/2 at x = 0."""
    is_small = np.abs(x) < _SERIES_BELOW
    large = np.where(is_small, _SERIES_BELOW, x)
    result: Numbers = (np.expm1(-large) + large) / large**2
    small = x[is_small]
    series = np.zeros_like(small)
    for n in range(_TERMS + 1, 1, -1):
        series = (1.0 - small * series) / n
    result[is_small] = series
    return result


class Step(NamedTuple, Generic[Numbers]):
    """What a step does to amplitudes.

    decay: what it leaves of them, mean: the mean of that over the step; held, held_mean: amplitude
    at its end, and mean amplitude, for a load of 1.
    """

    decay: Numbers
    mean: Numbers
    held: Numbers
    held_mean: Numbers


def step(rates: Numbers, duration: float) -> Step[Numbers]:
    """Of some duration, s; rates in 1/s."""
    x = rates * duration
    mean = mean_decay(x)
    return Step(decay(x), mean, duration * mean, duration * mean_response(x))
