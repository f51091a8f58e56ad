"""How large a hidden effect is, in units of the tracker's noise, whatever product looks for it.

The plain model (Coulomb friction in closed form) starts afresh from the true state at every cycle
of the hidden motion; its two friction coefficients and the zero of the tracker are those that
make the root-mean-square difference smallest. A wrong number is then no effect, and a small
difference of the period cannot pile up to a large one. A block that also swings sideways turns a
little, which the plain model along x leaves out: up to 2 units where y reaches 6 mm.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from scipy.optimize import minimize

from .motion import COARSE, DENSE, Motion, walk
from .simulator.coulomb import replay
from .simulator.hidden import Hidden, State

THIN = 10  # every so manieth dense row is compared: 100 Hz
ZERO = 2e-3  # m, how far off the zero of a tracker may be
ERRORS = 2.0  # standard deviations by which a known coefficient may be off
LIFTS, LEVELS = (1.0, 2.0, 4.0), (0.6, 1.0, 1.4)  # where the fit may begin, of the planned friction


Known = dict[str, tuple[float, float]]  # mu_s and mu_k with their standard deviations, or empty


@dataclass(frozen=True)
class Size:
    """Misfit of the best plain model in units of noise, by channel, and its numbers."""

    x: float
    y: float
    mu_s: float
    mu_k: float
    offset: float  # m

    @property
    def largest(self) -> float:
        """The channel that shows it best."""
        return max(self.x, self.y)


def cycle_starts(x: np.ndarray) -> np.ndarray:
    """Rows where x passes its mean upwards, at least 0.1 s apart, and the first row."""
    above = x > x.mean()
    ups = np.flatnonzero(~above[:-1] & above[1:]) + 1
    starts, gap = [0], int(0.1 / DENSE)
    for up in ups:
        if up - starts[-1] >= gap:
            starts.append(int(up))
    return np.array(starts)


@dataclass(frozen=True)
class Cycles:
    """A hidden motion cut where x passes its mean, ready for the plain model."""

    hidden: Hidden
    edges: np.ndarray  # rows where the plain model starts afresh, and the end
    x: np.ndarray  # true, m
    v: np.ndarray  # true, m/s
    seen: np.ndarray  # x as the tracker's optics show it, m

    @classmethod
    def of(cls, motion: Motion) -> Self:
        """Cut a motion."""
        x, v = (np.ascontiguousarray(motion.rows[:, column]) for column in (0, 3))
        edges = np.append(cycle_starts(x), len(x))
        return cls(motion.run.hidden, edges, x, v, np.ascontiguousarray(motion.x))

    def misfit(self, mu_s: float, mu_k: float, offset: float) -> tuple[float, int]:
        """Sum of squares of x seen less x of the plain model in m2, and how many; 100 Hz."""
        p = self.hidden
        model = (p.mass, 4 * p.stiffness, p.speed, mu_s, mu_k)
        return replay(self.edges, self.x, self.v, self.seen, model, offset, THIN, DENSE)


def side_misfit(motion: Motion, mu_s: float, mu_k: float) -> np.ndarray:
    """y less y of the plain model in the plane, re-synchronised at every cycle, m."""
    p = motion.run.hidden._replace(mu_s=mu_s, mu_k=mu_k)
    path, misfits = motion.rows, []
    edges = [*cycle_starts(path[:, 0]), len(path)]
    for begin, end in zip(edges[:-1], edges[1:], strict=True):
        if end - begin > 1:
            start = State(*(float(value) for value in path[begin, :6]))
            model = walk(p, start, True, COARSE[True], end - begin - 1)
            misfits.append(path[begin + 1 : end, 1] - model[:, 1])
    return np.concatenate(misfits)


def rms(parts: Sequence[np.ndarray]) -> float:
    """Root mean square of all parts together."""
    return float(np.sqrt(np.mean(np.concatenate(parts) ** 2)))


def free_numbers(free: np.ndarray, known: Known) -> tuple[float, float, float]:
    """mu_s, mu_k and offset of a point of the search; what is known stays within its error."""
    mu_k, mu_s = abs(free[1]), abs(free[1]) + abs(free[0])
    if known:
        mu_s, mu_k = (
            float(np.clip(mu, value - ERRORS * deviation, value + ERRORS * deviation))
            for mu, (value, deviation) in zip((mu_s, mu_k), known.values(), strict=True)
        )
    return float(mu_s), float(mu_k), float(ZERO * np.tanh(free[2]))


def fit_plain(motions: Sequence[Motion], known: Known) -> tuple[float, tuple]:
    """Smallest misfit of x in m, and mu_s, mu_k, offset that reach it."""
    p = motions[0].run.hidden
    cut = [Cycles.of(each) for each in motions]

    def misfit(free: np.ndarray) -> float:
        numbers = free_numbers(free, known)
        sums = [each.misfit(*numbers) for each in cut]
        return math.sqrt(sum(square for square, _ in sums) / sum(count for _, count in sums))

    grid = [
        np.array([(p.mu_s * lift - p.mu_k) * level, p.mu_k * level, 0.0])
        for lift in LIFTS
        for level in LEVELS
    ]
    first = min(grid, key=misfit)
    simplex = first + np.vstack([np.zeros(3), np.diag([0.03, 0.02, 0.3])])
    best = minimize(
        misfit,
        first,
        method="Nelder-Mead",
        options={"initial_simplex": simplex, "xatol": 1e-4, "fatol": 2e-6, "maxfev": 150},
    )
    return float(best.fun), free_numbers(best.x, known)


def effect_size(motions: Sequence[Motion], noise: float, sideways: bool, known: Known) -> Size:
    """Size of whatever is hidden in the motions.

    Parameters
    ----------
    noise : standard deviation of the tracker, m
    sideways : whether the block leaves the line and the tracker shows it
    known : mu_s and mu_k with their standard deviations, or nothing
    """
    misfit, (mu_s, mu_k, offset) = fit_plain(motions, known)
    side = 0.0
    if sideways:
        side = rms([side_misfit(each, mu_s, mu_k) for each in motions]) / noise
    return Size(misfit / noise, side, mu_s, mu_k, offset)
