"""Where a periodic effect's period lies: the model's answer to every period of a grid.

A ripple too small to matter is put into the model, in two phases a quarter period apart; what of
the residuals its two answers can explain, beyond what the runs' own states can take up, is the
periodogram.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cosim.gap.candidates.candidate import Candidate
from cosim.gap.shooting.fitted import Fitted, Point
from cosim.gap.shooting.flight import Flight
from cosim.gap.shooting.problem import Problem
from cosim.gap.shooting.trial import Model

#: Amplitude of the ripple that is tried; small against 1, large against the integrator's error.
_SMALL = 1e-3
#: A step of the first grid is this part of one period more over the piece of the run looked at, ...
_COARSE = 0.8
#: ... and this part of its cycles that piece is: half the time, a quarter of the work.
_PIECE = 0.5
#: Then the whole run is looked at, about each peak: so many steps either way, each this much.
_STEPS, _FINE = 4, 0.25
#: The longest period tried is this part of a run; the shortest takes so many samples.
_LONGEST, _SAMPLES = 0.7, 8
#: Runs that a scan looks at, and the most periods: enough to find one, few enough to be quick.
_RUNS, _POINTS = 2, 200
#: A surface is best looked at where this much of it passes: long and short waves both show, m.
_PASSING = 1.2
#: Periods found.
_PEAKS = 2


def scan(
    candidate: Candidate, model: Model, fitted: Fitted, flights: Sequence[Flight]
) -> list[float]:
    """The strongest frequencies (Hz) or wavelengths (m); ``fitted``: the flights without any."""
    on_surface = candidate.periodic.endswith(".wavelength")
    chosen = _telling(flights, fitted, candidate.effect == "surface_pattern")
    pieces = [_Scanned(candidate, model, fitted, flights, i, _PIECE) for i in chosen]
    wholes = [_Scanned(candidate, model, fitted, flights, i, 1.0) for i in chosen]
    grid, step = _grid([piece.flight for piece in pieces], on_surface)
    power = _power(pieces, grid, on_surface)
    found = []
    for i in _peaks(power):
        fine = grid[i] + np.arange(-_STEPS, _STEPS + 1) * _FINE * step
        fine = fine[fine > 0.0]
        best = fine[_power(wholes, fine, on_surface).argmax()]
        found.append(float(1.0 / best if on_surface else best))
    return found


class _Scanned:
    """A run, or the first part of it, at the base model's fit."""

    def __init__(self, candidate, model: Model, fitted: Fitted, flights, run: int, part: float):
        flight = flights[run]
        count = max(1, round(part * len(flight.windows)))
        self.flight = flight.first(count)
        self.names = tuple(knob.key for knob in candidate.knobs)
        self.model = model
        self.at = fitted.point.shared, fitted.point.own[run], fitted.point.states[run][:count]
        problem = Problem([self.flight], model.knobs, model.settings)
        residuals = problem.residuals(0, *self.at)
        own, states = (self.at[1],), (self.at[2],)
        self.columns = problem.columns(0, Point(self.at[0], own, states), residuals, [])

    def explained(self, value: float) -> float:
        """Part of the sum of squares that a ripple of one period can take away, linearised."""
        residuals = self.columns.residuals
        answers = np.column_stack([self._answer(value, degrees) for degrees in (0.0, 90.0)])
        answers = self.columns.left(answers)
        change = answers @ -np.linalg.lstsq(answers, residuals, rcond=1e-8)[0]
        return float(-(2.0 * residuals + change) @ change)

    def _answer(self, value: float, degrees: float) -> np.ndarray:
        ripple = dict(zip(self.names, (_SMALL, value, degrees), strict=True))
        problem = Problem([self.flight], self.model.knobs, {**self.model.settings, **ripple})
        return (problem.residuals(0, *self.at) - self.columns.residuals) / _SMALL


def _power(scanned: Sequence[_Scanned], rates: np.ndarray, on_surface: bool) -> np.ndarray:
    """(rates,) explained by a ripple of so many periods per second, or per metre."""
    values = 1.0 / rates if on_surface else rates
    return np.array([sum(run.explained(value) for run in scanned) for value in values])


def _telling(flights: Sequence[Flight], fitted: Fitted, on_surface: bool) -> list[int]:
    """The runs to look at: a surface of a fair length passes, or most of the time is in stick."""
    if on_surface:
        passing = np.array([abs(f.speed) * f.time[-1] for f in flights])
        return list(np.argsort(np.abs(np.log(passing / _PASSING)), kind="stable")[:_RUNS])
    gaps = [float(r @ r) / r.size for r in fitted.residuals]
    held = [sum(np.isfinite(w.hold_since) for w in f.windows) / len(f.windows) for f in flights]
    order = sorted(range(len(flights)), key=lambda i: (-round(held[i], 1), -gaps[i]))
    return order[:_RUNS]


def _grid(flights: Sequence[Flight], on_surface: bool) -> tuple[np.ndarray, float]:
    """Periods per second, or per metre, evenly spaced, and their step."""
    longest = max(f.time[-1] for f in flights)
    interval = max(float(np.median(np.diff(f.time))) for f in flights)
    periods = np.arange(1.0 / _LONGEST, longest / (_SAMPLES * interval), _COARSE)[:_POINTS]
    way = max(abs(f.speed) * f.time[-1] for f in flights) if on_surface else longest
    return periods / way, _COARSE / way


def _peaks(power: np.ndarray) -> list[int]:
    """The highest local maxima."""
    padded = np.concatenate([[-np.inf], power, [-np.inf]])
    top = np.flatnonzero((padded[1:-1] >= padded[:-2]) & (padded[1:-1] >= padded[2:]))
    return sorted(top, key=lambda i: -power[i])[:_PEAKS]
