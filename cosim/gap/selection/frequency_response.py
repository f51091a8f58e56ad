"""A run's linear response to a small wave of any rate: of the surface's speed, or of its friction.

What a wave does inside a segment is a smooth function of its rate once its phase is counted from
the segment's middle. Some rates are simulated; between them the response follows by interpolation,
and a run that is cut into many segments is known at many more rates than were simulated.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from stickslip.effects.candidate import Candidate
from stickslip.kernel import layout

from cosim.gap.estimation.columns import Columns
from cosim.gap.estimation.fitted import Fitted
from cosim.gap.estimation.problem import Problem
from cosim.gap.estimation.segmented_run import SegmentedRun
from cosim.gap.estimation.trial import Model

#: Amplitude of the wave that is simulated; small against 1, large against the integrator's error.
_SMALL = 1e-3
#: Steps of the rates simulated, in periods over a segment: interpolation by cubics needs as many.
_STEP = 0.6
#: The most rates that are simulated in a run.
_RATES, _FEWEST = 32, 5
#: No direction of a wave is felt less than this part of the whole.
_LEAST = 0.02
#: What a segment's response is taken to be wrong by, as a part of a full wave's: where a small wave
#: changes much, as whether a block sticks, a larger one does not do so in proportion.
_WRONG = 0.1
#: The lowest of them stands for 0, in steps.
_ALL_BUT_NONE = 1e-6
#: A block that sticks all the time tells nothing of the surface's travel: segments count as so many
#: times the noise at least.
_SHORTEST = 50.0
#: A full ripple that moves the surface by less than so much of the noise is not to be seen.
_SEEN = 2.0


@dataclass(frozen=True)
class FrequencyResponse:
    """The response of one run; its coordinate is the time (s) or the travel of the surface (m).

    What the segments' states, the model's free parameters and the run's own can take up is left
    out. A segment counts the less, the worse the model fits in it, as one thrown off course does
    not respond linearly, and the more violently it responds: else a few would outweigh all others.

    Attributes
    ----------
    speed : set-point, m/s
    length : of the run in its coordinate
    step : of the rates simulated: 0, step, 2 step ..., periods per unit of the coordinate
    centres : (w,) of the segments
    products : (rates, w, c + 1) response (complex: e^(i angle)) times columns of the free
        parameters, times the residuals
    squares, turned : (rates, w) sum of squares of the response's modulus, and of the response
    misfit : sum of squares of the residuals, as they count here
    """

    speed: float
    length: float
    step: float
    centres: np.ndarray
    products: np.ndarray
    squares: np.ndarray
    turned: np.ndarray
    misfit: float

    @property
    def highest(self) -> float:
        """The highest rate that it is known at."""
        return (len(self.squares) - 2) * self.step

    def normal(self, rates: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Normal equations (n, 2, 2), (n, 2) of a wave's cosine and sine; 0 where not known."""
        known = rates <= self.highest
        place = np.where(known, rates, 0.0) / self.step
        first = np.floor(place).astype(int)
        f = place - first
        weights = np.array(
            [
                -f * (f - 1) * (f - 2) / 6,
                (f + 1) * (f - 1) * (f - 2) / 2,
                -(f + 1) * f * (f - 2) / 2,
                (f + 1) * f * (f - 1) / 6,
            ]
        )
        weights = np.where(known, weights, 0.0)
        turn = np.exp(2j * np.pi * np.outer(np.where(known, rates, 0.0), self.centres))
        products = _summed(self.products, first, weights, turn)
        turned = _summed(self.turned[:, :, None], first, weights, turn**2)[:, 0]
        squares = _summed(self.squares[:, :, None], first, weights, np.ones_like(turn))[:, 0].real
        squares = np.maximum(squares, np.abs(turned))
        matrix = _matrix(squares, turned)
        parts = np.stack([products.real, products.imag], axis=1)
        matrix = matrix - parts[:, :, :-1] @ parts[:, :, :-1].transpose(0, 2, 1)
        # what is interpolated need not be positive: a wave that is hardly felt explains nothing
        least = np.linalg.eigvalsh(matrix)[:, 0]
        lift = np.maximum(_LEAST * squares - least, 0.0)
        return matrix + lift[:, None, None] * np.eye(2), parts[:, :, -1]


def _summed(
    values: np.ndarray, first: np.ndarray, weights: np.ndarray, turn: np.ndarray
) -> np.ndarray:
    """(n, c) sums over segments of what lies between the rates simulated, turned.

    values : (rates, w, c) at the rates simulated; first : (n,) that below each; weights :
    (4, n) of that before, this and the two after it; turn : (n, w)
    """
    total = np.zeros((len(first), values.shape[2]), dtype=complex)
    for below in np.unique(first):
        rows = first == below
        for offset, weight in enumerate(weights[:, rows], start=-1):
            simulated = values[min(abs(below + offset), len(values) - 1)]
            if below + offset < 0:  # the response to a negative rate is the conjugate one
                simulated = np.conj(simulated)
            total[rows] += (weight[:, None] * turn[rows]) @ simulated
    return total


def _matrix(squares: np.ndarray, turned: np.ndarray) -> np.ndarray:
    """(n, 2, 2) of real and imaginary part, from |z|^2 and z^2."""
    matrix = np.empty((len(squares), 2, 2))
    matrix[:, 0, 0] = 0.5 * (squares + turned.real)
    matrix[:, 1, 1] = 0.5 * (squares - turned.real)
    matrix[:, 0, 1] = matrix[:, 1, 0] = 0.5 * turned.imag
    return matrix


def frequency_response(
    candidate: Candidate, model: Model, fitted: Fitted, segmented: SegmentedRun
) -> FrequencyResponse:
    """Of one run, at the fit of a model to it, with derivatives."""
    at = fitted.point.shared, fitted.point.own[0], fitted.point.states[0]
    problem = model.problem([segmented])
    (residuals,), (columns,) = fitted.residuals, fitted.derivatives
    segments = [rows for rows, _ in columns.states if rows.size]
    along = _along(problem, at, candidate, residuals.size)
    centres = np.array([along[rows].mean() for rows in segments])
    step = _STEP / max(
        float(np.quantile([np.ptp(along[rows]) for rows in segments], 0.9)),
        _SHORTEST * segmented.noise["x"],
    )
    weight, basis = _weight_and_basis(columns, segments)
    order = np.concatenate(segments)
    sizes = np.array([rows.size for rows in segments])
    centre = np.repeat(centres, sizes)
    found = []
    for rate in step * np.maximum(np.arange(_count(candidate, segmented, step)), _ALL_BUT_NONE):
        wave = _wave(candidate, model, segmented, at, rate) - (1.0 + 1.0j) * residuals
        wave = columns.without_states(wave / _SMALL) * weight
        found.append(sums(wave[order] * np.exp(-2j * np.pi * rate * centre), basis[order], sizes))
    products, squares, turned = (np.array(part) for part in zip(*found, strict=True))
    misfit = float(basis[:, -1] @ basis[:, -1])
    return FrequencyResponse(
        abs(segmented.speed), float(np.ptp(along)), step, centres, products, squares, turned, misfit
    )


def sums(
    wave: np.ndarray, basis: np.ndarray, sizes: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """By segment: of the wave times the basis, of its modulus squared, of its square."""
    begins = np.concatenate([[0], np.cumsum(sizes)[:-1]])
    products, squares, turned = (
        np.add.reduceat(part, begins, axis=0)
        for part in (wave[:, None] * basis, np.abs(wave) ** 2, wave**2)
    )
    trust = 1.0 / (1.0 + _WRONG**2 * squares / sizes)
    # the basis is of unit length, however much its segments count
    products[:, :-1] *= np.sqrt(trust)[:, None]
    products[:, -1] *= trust
    return products, trust * squares, trust * turned


def _count(candidate: Candidate, segmented: SegmentedRun, step: float) -> int:
    """Rates to simulate."""
    if not _in_time(candidate):
        return _RATES
    visible = abs(segmented.speed) / (2.0 * np.pi * _SEEN * segmented.noise["x"])
    return int(np.clip(visible / step, _FEWEST, _RATES))


def _in_time(candidate: Candidate) -> bool:
    return candidate.effect == "speed_ripple"


def _along(problem: Problem, at, candidate: Candidate, rows: int) -> np.ndarray:
    """(rows,) coordinate of each residual; of what is known beforehand, that of the first."""
    (segmented,) = problem.segmented_runs
    along = segmented.time
    if not _in_time(candidate):
        outputs = problem.simulated(0, *at)[0]
        along = outputs[:, layout.O_TRAVEL] - outputs[:, layout.O_X]
        along = np.interp(
            segmented.time, segmented.time[np.isfinite(along)], along[np.isfinite(along)]
        )
    seen = np.concatenate([along[segmented.seen[name]] for name in segmented.channels])
    return np.concatenate([seen, np.full(rows - seen.size, along[0])])


def _wave(
    candidate: Candidate, model: Model, segmented: SegmentedRun, at, rate: float
) -> np.ndarray:
    """Residuals under a small wave e^(i angle), its two parts as real and imaginary one."""
    effect, period = candidate.effect, candidate.periodic
    value = rate if period.endswith("frequency") else 1.0 / rate
    parts = []
    for degrees in (0.0, 90.0):
        wave = {f"{effect}.amplitude": _SMALL, period: value, f"{effect}.phase_deg": degrees}
        problem = replace(model, settings={**model.settings, **wave}).problem([segmented])
        parts.append(problem.residuals(0, *at))
    # the sine of the time's angle and its cosine, or the cosine of the place's and its sine
    return parts[1] + 1j * parts[0] if _in_time(candidate) else parts[0] + 1j * parts[1]


def _weight_and_basis(columns: Columns, segments) -> tuple[np.ndarray, np.ndarray]:
    """(rows,) weight by segment; what free parameters take up, orthonormal, and the residuals."""
    left = columns.without_states(columns.residuals)
    weight = np.empty(left.size)
    for rows in segments:
        weight[rows] = 1.0 / np.sqrt(1.0 + np.mean(left[rows] ** 2))
    free_parameters = columns.without_states(np.column_stack([columns.shared, columns.own]))
    basis = np.linalg.qr(free_parameters * weight[:, None])[0]
    left = left * weight
    return weight, np.column_stack([basis, left - basis @ (basis.T @ left)])
