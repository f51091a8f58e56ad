"""A misfit as a force (slip) or a velocity (stick) that acts on the block, stretch by stretch.

In slip the difference r of measurement and model obeys m r'' + K r = f, f the force that the model
lacks; in stick r' = w, w the velocity that it lacks. The motion that a stretch starts with (in slip
a free vibration, in stick a level) is unknown and is projected out: no drift of the phase, and no
error of an earlier stretch, gets into f or w. What is left is linear in f: a force that acts only
while a variable lies in a bin makes a response of its own, and least squares over the responses of
all bins gives the force in each, with its error. No derivative of a noisy track is taken.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from scipy.integrate import cumulative_trapezoid

#: A bin counts where it is known at least this well, relative to the best known one.
KNOWN = 1e-6
#: Combinations of inputs that are known this much worse than the best one are not told apart.
TOGETHER = 1e-8


@dataclass(frozen=True)
class Stretch:
    """A piece of a run between two corners.

    Attributes
    ----------
    track : number of the run
    rows : (n,) indices of its samples
    time : (n,) s
    residual : (n,) measured less modelled, in units of the noise
    noise : of a sample, m
    nuisance : (n, k) orthonormal columns: the motion that it starts with
    respond : (n, b) inputs at the samples -> (n, b) what they make of r, m
    """

    track: int
    rows: np.ndarray = field(repr=False)
    time: np.ndarray = field(repr=False)
    residual: np.ndarray = field(repr=False)
    noise: float
    nuisance: np.ndarray = field(repr=False)
    respond: Callable[[np.ndarray], np.ndarray] = field(repr=False)

    def free(self, columns: np.ndarray, level: bool = False) -> np.ndarray:
        """Columns less what the motion at the start can explain, and a constant input if asked."""
        columns = columns - self.nuisance @ (self.nuisance.T @ columns)
        if not level:
            return columns
        constant = self.free(self.respond(np.ones((len(self.rows), 1)))[:, 0])
        constant = constant / max(float(np.linalg.norm(constant)), 1e-300)
        return columns - np.tensordot(constant, constant @ columns, axes=0)

    def normal(self, inputs: np.ndarray, level: bool = False) -> Normal:
        """Normal equations of inputs (n, b) at its samples; ``level``: it has its own constant."""
        columns = self.free(self.respond(inputs) / self.noise, level)
        residual = self.free(self.residual, level)
        return Normal(
            columns.T @ columns,
            columns.T @ residual,
            float(residual @ residual),
            len(residual) - self.nuisance.shape[1] - level,
        )


@dataclass(frozen=True)
class Answer:
    """Least squares over all stretches.

    Attributes
    ----------
    values, covariance : (b,), (b, b) of the inputs
    misfit : sum of squares that is left
    known : (b,) whether the data say anything of an input
    count : how many numbers were fitted; fewer than inputs where some only go together
    """

    values: np.ndarray
    covariance: np.ndarray
    misfit: float
    known: np.ndarray
    count: int


@dataclass(frozen=True)
class Normal:
    """Normal equations of some inputs: A'A, A'r, r'r and the degrees of freedom of the data."""

    square: np.ndarray
    right: np.ndarray
    total: float
    freedom: int

    def __add__(self, other: Normal) -> Normal:
        return Normal(
            self.square + other.square,
            self.right + other.right,
            self.total + other.total,
            self.freedom + other.freedom,
        )

    def solve(self, combine: np.ndarray | None = None) -> Answer:
        """Values of the inputs, or of fewer that are combinations (b, c) of them."""
        square, right = self.square, self.right
        least = KNOWN * max(float(np.max(np.diag(square), initial=0.0)), 1e-300)
        if combine is not None:
            square, right = combine.T @ square @ combine, combine.T @ right
        known = np.diag(square) > least
        values, covariance = np.full(len(right), np.nan), np.full(square.shape, np.nan)
        part = square[np.ix_(known, known)]
        inverse = np.linalg.pinv(part, rcond=TOGETHER, hermitian=True)
        values[known] = inverse @ right[known]
        covariance[np.ix_(known, known)] = inverse
        misfit = self.total - float(right[known] @ values[known])
        count = int(np.linalg.matrix_rank(inverse, hermitian=True)) if part.size else 0
        return Answer(values, covariance, max(misfit, 0.0), known, count)


def slip_stretch(
    track: int, rows: np.ndarray, time: np.ndarray, residual: np.ndarray, noise: float,
    mass: float, omega: float,
) -> Stretch:  # fmt: skip
    """Inputs are forces, N."""
    angle = omega * (time - time[0])
    sin, cos = np.sin(angle), np.cos(angle)

    def respond(force: np.ndarray) -> np.ndarray:
        even = cumulative_trapezoid(cos[:, None] * force, time, axis=0, initial=0.0)
        odd = cumulative_trapezoid(sin[:, None] * force, time, axis=0, initial=0.0)
        return (sin[:, None] * even - cos[:, None] * odd) / (mass * omega)

    nuisance = np.linalg.qr(np.stack([cos, sin], axis=1))[0]
    return Stretch(track, rows, time, residual, noise, nuisance, respond)


def stick_stretch(
    track: int, rows: np.ndarray, time: np.ndarray, residual: np.ndarray, noise: float
) -> Stretch:
    """Inputs are velocities, m/s."""

    def respond(velocity: np.ndarray) -> np.ndarray:
        return cumulative_trapezoid(velocity, time, axis=0, initial=0.0)

    nuisance = np.full((len(time), 1), 1.0 / np.sqrt(len(time)))
    return Stretch(track, rows, time, residual, noise, nuisance, respond)
