"""Periods in the misfit: in time (a rippling surface speed), along the surface (a pattern)."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np

from cosim.gap.diagnostics.dependence import log10_chance
from cosim.gap.diagnostics.model_track import ModelTrack
from cosim.gap.diagnostics.response import Stretch
from cosim.gap.diagnostics.sources import Source, sources
from cosim.gap.diagnostics.variables import surface_position

#: Steps from one period to the next, parts of one more over the longest run.
STEP = 0.4
#: Samples per period at the least.
NYQUIST = 4.0
#: Periods that a run must hold.
FEWEST = 2.0
#: Rates at the most, and how many are worked on together.
MOST, TOGETHER = 1000, 250
#: Samples of a run that are searched for a period.
SAMPLES = 10000
#: A period counts where chance makes as strong a one less often than this.
CHANCE = 0.01


@dataclass(frozen=True)
class Period:
    """The strongest period of a misfit.

    Attributes
    ----------
    rate : periods per second (Hz) or per metre of surface (1/m)
    amplitude, phase : of each run's sinusoid at that rate: in the unit of the misfit (m/s, N), and
        where it is largest, in periods; NaN for a run in which it cannot be seen
    log10_p : logarithm of the false-alarm probability: of as much power at any of the rates, by
        chance
    rates, power : (f,) the whole spectrum: sum of squares that a sinusoid in each run explains, in
        units of the misfit that is left
    """

    rate: float
    amplitude: tuple[float, ...]
    phase: tuple[float, ...]
    log10_p: float
    rates: np.ndarray = field(repr=False)
    power: np.ndarray = field(repr=False)

    @property
    def length(self) -> float:
        """1 / rate: the period in s, or the wavelength in m."""
        return 1.0 / self.rate

    @property
    def certain(self) -> bool:
        """Not to be expected by chance."""
        return self.log10_p < math.log10(CHANCE)


def _time(track: ModelTrack) -> np.ndarray:
    return track.time - track.time[0]


def _surface(track: ModelTrack) -> np.ndarray:
    return np.abs(surface_position(track))


#: What a phase is counted along.
COORDINATES = {"time_phase": _time, "surface_phase": _surface}


def phase_of(period: Period, along: np.ndarray, run: int) -> np.ndarray:
    """(n,) where samples of a run are between two crests of a period, 0 to 1."""
    return (period.rate * along - period.phase[run]) % 1.0


def ripple_frequency(
    tracks: Sequence[ModelTrack], every: Sequence[Source] | None = None
) -> Period | None:
    """Of the speed that the model lacks in stick, against time; None without long enough sticks."""
    return _of_source(tracks, every, "stick", _time)


def pattern_wavelength(
    tracks: Sequence[ModelTrack], every: Sequence[Source] | None = None
) -> Period | None:
    """Of the friction that the model lacks in slip, against the place on the surface."""
    return _of_source(tracks, every, "slip", _surface)


def _of_source(
    tracks: Sequence[ModelTrack],
    every: Sequence[Source] | None,
    regime: str,
    coordinate: Callable[[ModelTrack], np.ndarray],
) -> Period | None:
    every = sources(list(tracks)) if every is None else every
    found = [s for s in every if s.channel == "x" and s.regime == regime]
    if not found:
        return None
    stretches = [piece for piece in found[0].pieces if isinstance(piece, Stretch)]
    return strongest_period(stretches, [coordinate(track) for track in tracks])


def strongest_period(stretches: Sequence[Stretch], along: Sequence[np.ndarray]) -> Period | None:
    """The rate whose sinusoid, one in each run, explains most of the misfit of the stretches.

    A periodogram by least squares (Lomb 1976, Scargle 1982) of inputs that are seen through their
    response, with the motion at the start of each stretch and a constant of each run projected
    out. ``along`` holds the coordinate at every sample of each run.
    """
    owners = np.array([stretch.track for stretch in stretches])
    present = np.unique(owners)
    spans = [_span(stretches, along, run) for run in present]
    rates = _grid(spans)
    if not rates.size:
        return None
    found = [
        _in_run(_some([s for s in stretches if s.track == run]), along[run], rates)
        for run in present
    ]
    gains, waves = (np.stack(parts, axis=1) for parts in zip(*(f[:2] for f in found), strict=True))
    total, freedom = sum(f[2] for f in found), sum(f[3] for f in found)
    power = gains.sum(axis=1)
    best = int(np.argmax(power))
    pair = (2 * len(present), freedom - 2 * len(present))
    if pair[1] <= 0:
        return None
    scale = max((total - power[best]) / pair[1], 1.0)
    single = log10_chance(power[best] / pair[0] / scale, pair)
    independent = max(len(rates) * STEP, 1.0)
    wave = np.full(len(along), np.nan + 0j)
    wave[present] = waves[best]
    return Period(
        float(rates[best]), tuple(np.abs(wave).tolist()),
        tuple((np.angle(wave) / (2.0 * np.pi)).tolist()),
        min(single + float(np.log10(independent)), 0.0), rates, power / scale,
    )  # fmt: skip


def _in_run(
    own: Sequence[Stretch], along: np.ndarray, rates: np.ndarray
) -> tuple[np.ndarray, np.ndarray, float, int]:
    """Of one run, for each rate: what it explains, its wave; sum of squares, freedom."""
    residual = np.concatenate([stretch.free(stretch.residual) for stretch in own])
    level = np.concatenate([_answer(s, np.ones((len(s.rows), 1))) for s in own])[:, 0]
    level = level / np.linalg.norm(level)
    residual = residual - level * (level @ residual)
    parts = np.array_split(rates, -(-len(rates) // TOGETHER))
    found = [_sinusoids(own, along, part, level, residual) for part in parts]
    gains, waves = (np.concatenate(each) for each in zip(*found, strict=True))
    freedom = len(residual) - 1 - sum(stretch.nuisance.shape[1] for stretch in own)
    return gains, waves, float(residual @ residual), freedom


def _some(stretches: list[Stretch]) -> list[Stretch]:
    """Every so many stretches of a long record: enough to see a period, few enough to be quick."""
    samples = sum(len(stretch.rows) for stretch in stretches)
    return stretches[:: -(-samples // SAMPLES)]


def _span(
    stretches: Sequence[Stretch], along: Sequence[np.ndarray], run: int
) -> tuple[float, float]:
    """Length of a run's coordinate, and its typical step between samples."""
    parts = [along[run][stretch.rows] for stretch in stretches if stretch.track == run]
    steps = np.concatenate([np.abs(np.diff(part)) for part in parts])
    ends = np.concatenate(parts)
    return float(np.ptp(ends)), float(np.median(steps[steps > 0.0])) if np.any(steps > 0) else 0.0


def _grid(spans: Sequence[tuple[float, float]]) -> np.ndarray:
    """Rates that are evenly spaced in periods of the longest run."""
    longest = max(span for span, _ in spans)
    finest = float(np.median([step for _, step in spans]))
    if longest <= 0.0 or finest <= 0.0:
        return np.empty(0)
    count = min(int((longest / (NYQUIST * finest) - FEWEST) / STEP), MOST)
    return (FEWEST + STEP * np.arange(max(count, 0))) / longest


def _answer(stretch: Stretch, inputs: np.ndarray) -> np.ndarray:
    return stretch.free(stretch.respond(inputs) / stretch.noise)


def _sinusoids(
    own: Sequence[Stretch], along: np.ndarray, rates: np.ndarray, level: np.ndarray,
    residual: np.ndarray,
) -> tuple[np.ndarray, np.ndarray]:  # fmt: skip
    """What a sinusoid of each rate explains of a run's misfit, and amplitude e^(i phase)."""
    columns = []
    for stretch in own:
        angle = 2.0 * np.pi * np.outer(along[stretch.rows], rates)
        columns.append(_answer(stretch, np.concatenate([np.cos(angle), np.sin(angle)], axis=1)))
    shapes = np.concatenate(columns)
    shapes -= np.outer(level, level @ shapes)
    even, odd = shapes[:, : len(rates)], shapes[:, len(rates) :]
    right = np.stack([residual @ even, residual @ odd])
    square = np.stack([np.sum(even * even, axis=0), np.sum(odd * odd, axis=0)])
    cross = np.sum(even * odd, axis=0)
    determinant = square[0] * square[1] - cross**2
    seen = determinant > 1e-9 * square[0] * square[1]
    safe = np.where(seen, determinant, 1.0)
    values = np.where(seen, (square[::-1] * right - cross * right[::-1]) / safe, 0.0)
    return np.sum(values * right, axis=0), values[0] + 1j * values[1]
