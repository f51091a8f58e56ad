"""A run on an even grid: smoothed motion, sliding speed, slips and sticks."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import permutations
from typing import Any

import numpy as np
from numpy.polynomial import Polynomial
from scipy import sparse
from scipy.ndimage import uniform_filter1d
from scipy.signal import savgol_coeffs

from cosim.gap.data import MeasuredRun
from cosim.gap.weak_form.constants import (
    AT_REST,
    COARSEST,
    CUBIC_REACH,
    EVEN,
    FAR_STIFFER,
    FINE_ENOUGH,
    HOLE,
    KNOTS,
    LEAST_FINE,
    LEAST_SLIDING,
    LEAST_SLIDING_SHARE,
    MOVES,
    QUINTIC_REACH,
    SLIP_PERCENTILE,
    SLIP_SIGMAS,
    SLOW_PART,
    STICK_AHEAD,
    STICK_SIGMAS,
    VELOCITY_SIGMAS,
)


@dataclass(frozen=True)
class SmoothTrack:
    """Motion of one run on a grid of n times.

    Attributes
    ----------
    time, interval : (n,) s, and its step, s
    errors : (n, m) sparse, in units of the noise: of the values on the grid by the samples' own and
        by interpolation's; None: the samples are the grid
    x, y, phi : (n,) values on the grid (m, m, rad), not smoothed; None where not measured
    place, velocity, acceleration : (n,) of x, smoothed by local polynomials; of a block at rest
        its course, 0 and 0: what noise pretends there would be motion that no damping damps
    place_y, velocity_y : (n,) of y; zeros where it was not measured
    surface_speed : (n,) of the surface, m/s: the set-point, and what sticks show it to vary by
    sliding : (n,) speed of the surface less that of the block, m/s
    seen : (n,) whether there are samples about it
    slips, sticks : (first, last + 1) of their grid points
    stiffness : along x, N/m, as stated, or as the swings show it where it is far above that
    at_rest : (n,) whether the block swings by no more than noise pretends
    part : (n,) of friction, the part that acts along x, with its sign; None: all of it
    """

    run: MeasuredRun
    time: np.ndarray
    interval: float
    errors: sparse.csr_array | None
    x: np.ndarray
    y: np.ndarray | None
    phi: np.ndarray | None
    place: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray
    place_y: np.ndarray
    velocity_y: np.ndarray
    surface_speed: np.ndarray
    sliding: np.ndarray
    seen: np.ndarray
    slips: tuple[tuple[int, int], ...]
    sticks: tuple[tuple[int, int], ...]
    stiffness: float
    at_rest: np.ndarray
    part: np.ndarray | None = None

    @property
    def direction(self) -> np.ndarray:
        """(n,) of friction on the block along x: the sign of the sliding speed, or less."""
        return np.sign(self.sliding) if self.part is None else self.part

    @property
    def slips_mask(self) -> np.ndarray:
        """(n,) whether the block slips."""
        return mask(self.slips, self.time.size)

    @property
    def cause(self) -> np.ndarray:
        """(n,) m: x as what it brings about is asked for: as measured, without the noise at rest.

        That noise is in the rows, too, and would bring itself about.
        """
        return np.where(self.at_rest, self.place, self.x)

    @property
    def surface_place(self) -> np.ndarray:
        """(n,) place on the surface that lies under the block, m, from the start of the run."""
        travel = np.cumsum(self.surface_speed) - self.surface_speed[0]
        return np.asarray(travel * self.interval - self.place)


def mask(stretches: tuple[tuple[int, int], ...], size: int) -> np.ndarray:
    """(size,) whether a grid point is in one of the stretches."""
    inside = np.zeros(size, dtype=bool)
    for first, last in stretches:
        inside[first:last] = True
    return inside


@dataclass(frozen=True)
class GridTrack:
    """The samples of one run on an even grid of n times, whatever its surface does.

    Attributes
    ----------
    time, interval, errors, x, y, phi, seen : as of `SmoothTrack`
    omega : frequency of the swings, rad/s
    rough : (3, n) x and its first two derivatives, smoothed across everything
    across : (3, n) the same of y; zeros where it was not measured
    threshold : sliding speed above which the block slips, m/s
    """

    run: MeasuredRun
    time: np.ndarray
    interval: float
    errors: sparse.csr_array | None
    x: np.ndarray
    y: np.ndarray | None
    phi: np.ndarray | None
    seen: np.ndarray
    omega: float
    rough: np.ndarray
    across: np.ndarray
    threshold: float

    @classmethod
    def of(cls, run: MeasuredRun) -> GridTrack:
        """The grid has the samples' median step."""
        track = run.motion
        present = np.isfinite(track.x)
        time, samples, remainder, seen = _grid(track.time[present])
        interval = time[1] - time[0]

        def values(channel: str) -> np.ndarray | None:
            if channel not in track.channels:
                return None
            raw, at = track[channel][present], track.time[present]
            raw = np.interp(at, at[np.isfinite(raw)], raw[np.isfinite(raw)])
            return np.asarray(raw if samples is None else samples @ raw)

        x, y, phi = values("x"), values("y"), values("phi")
        assert x is not None  # every track has it
        omega = _frequency(x, interval, run)
        errors = None
        if samples is not None:
            off = omega**4 * float(np.std(x)) / run.noise["x"] * remainder
            errors = sparse.hstack([samples, sparse.diags_array(off)], format="csr")
        rough = derivatives(x, interval, CUBIC_REACH / omega, 3)
        across = np.zeros((3, x.size))
        if y is not None:
            across = derivatives(y, interval, QUINTIC_REACH / omega, 5)
        threshold = _sliding_threshold(run, interval, rough[1])
        return cls(run, time, interval, errors, x, y, phi, seen, omega, rough, across, threshold)

    def smoothed(
        self, varies: Callable[[np.ndarray], np.ndarray] | None = None, band: float = 0.0
    ) -> SmoothTrack:
        """Smoothed again inside the slips.

        varies : times (n,), s, to the part by which the surface is faster than its set-point;
        band : a block moves with the surface up to this part of its speed

        A polynomial that reaches over a break-away would round it off; inside a slip the motion is
        that of an oscillator, which a quintic over two radians follows to 1e-3.
        """
        run, time, interval, seen, x = self.run, self.time, self.interval, self.seen, self.x
        threshold = max(self.threshold, band * abs(run.surface_speed))
        surface = np.full(time.size, run.surface_speed)
        if varies is not None:
            surface *= 1.0 + varies(time)
        sliding = surface - self.rough[1]
        # a slip is of one direction: where it changes, a short stick may hide between two samples
        ways = [each for way in (1.0, -1.0)
                for each in stretches((way * sliding > threshold) & seen)]  # fmt: skip
        # in a slip the surface gets ahead by more than noise can
        slips = tuple(
            (first, last) for first, last in sorted(ways)
            if abs(np.sum(sliding[first:last])) * interval > SLIP_SIGMAS * run.noise["x"]
        )  # fmt: skip
        margin = round(KNOTS / self.omega / interval)
        ahead = np.cumsum(sliding) * interval
        most = max(band, STICK_AHEAD) * abs(run.surface_speed) * interval
        sticks = tuple(
            (first + margin, last - margin)
            for first, last in stretches(seen & ~mask(slips, time.size))
            if last - first > 2 * margin
            and np.ptp(ahead[first:last]) < STICK_SIGMAS * run.noise["x"] + most * (last - first)
        )
        fine = self.rough.copy()
        reach = QUINTIC_REACH / self.omega
        for first, last in slips:
            if min(last - first, _window(reach, interval)) > 6:
                fine[:, first:last] = derivatives(x[first:last], interval, reach, 5)
        at_rest = self._at_rest
        fine[0, at_rest], fine[1:, at_rest] = self._course(at_rest), 0.0
        return SmoothTrack(
            run, time, interval, self.errors, x, self.y, self.phi, fine[0], fine[1], fine[2],
            self.across[0], self.across[1], surface, surface - fine[1], seen,
            slips, sticks, run.mass * self.omega**2, at_rest,
        )  # fmt: skip

    @property
    def _at_rest(self) -> np.ndarray:
        """(n,) where x, less its mean over a period, is no more than noise: over two periods."""
        swing = self.x - uniform_filter1d(self.x, self._period)
        square = uniform_filter1d(swing**2, 2 * self._period)
        return np.asarray(square < (AT_REST * self.run.noise["x"]) ** 2)

    @property
    def _period(self) -> int:
        """Samples in a period of the swings."""
        return max(round(2.0 * np.pi / self.omega / self.interval), 1)

    def _course(self, at_rest: np.ndarray) -> np.ndarray:
        """(k,) m: x in the stretches at rest, a cubic of the time, less in one of a few periods."""
        courses = [np.zeros(0)]
        for first, last in stretches(at_rest):
            time, degree = np.arange(last - first), min((last - first) // (2 * self._period), 3)
            courses.append(Polynomial.fit(time, self.x[first:last], degree)(time))
        return np.concatenate(courses)


def smooth(run: MeasuredRun) -> SmoothTrack:
    """The track of a run whose surface moves steadily."""
    return GridTrack.of(run).smoothed()


def _grid(
    time: np.ndarray,
) -> tuple[np.ndarray, sparse.csr_array | None, np.ndarray, np.ndarray]:
    """An even grid, the cubic interpolation to it from the samples, and where samples are near.

    Third: (n,) what the interpolation is off by for each m/s4 of the fourth derivative, s4.
    """
    interval = float(np.median(np.diff(time)))
    count = round((time[-1] - time[0]) / interval) + 1
    grid = time[0] + interval * np.arange(count)
    if count == time.size and np.max(np.abs(grid - time)) < EVEN * interval:
        return grid, None, np.zeros(count), np.ones(count, dtype=bool)
    nodes = np.clip(np.searchsorted(time, grid) - 2, 0, time.size - 4)[:, None] + np.arange(4)
    near = time[nodes]
    weights = np.ones((count, 4))  # Lagrange's
    for a, b in permutations(range(4), 2):
        weights[:, a] *= (grid - near[:, b]) / (near[:, a] - near[:, b])
    rows = np.repeat(np.arange(count), 4)
    samples = sparse.csr_array((weights.ravel(), (rows, nodes.ravel())), shape=(count, time.size))
    remainder = np.prod(np.abs(grid[:, None] - near), axis=1) / 24.0
    return grid, samples, remainder, near[:, 2] - near[:, 1] < HOLE * interval


def _window(reach: float, interval: float) -> int:
    """Samples of a window that reaches so many seconds to either side; odd, 5 at least."""
    return 2 * max(2, round(reach / interval)) + 1


def derivatives(values: np.ndarray, interval: float, reach: float, degree: int) -> np.ndarray:
    """(3, n) value, first and second derivative by local polynomials (Savitzky and Golay 1964).

    reach : of the window to either side, s
    """
    window = min(_window(reach, interval), (values.size - 1) // 2 * 2 + 1)
    half, found = window // 2, np.empty((3, values.size))
    for n, weights in enumerate(_local_polynomials(window, min(degree, window - 2))):
        found[n, :half] = weights[:half] @ values[:window]
        found[n, half:-half] = np.correlate(values, weights[half], "valid")
        found[n, -half:] = weights[-half:] @ values[-window:]
        found[n] /= (half * interval) ** n
    return found


@lru_cache(maxsize=256)
def _local_polynomials(window: int, degree: int) -> np.ndarray:
    """(3, window, window) value and derivatives at each place of a window that is 2 long."""
    place = np.linspace(-1.0, 1.0, window)
    powers = [Polynomial.basis(power) for power in range(degree + 1)]
    at = [np.stack([power.deriv(n)(place) if n else power(place) for power in powers], axis=1)
          for n in range(3)]  # fmt: skip
    return np.array(at) @ np.linalg.pinv(at[0])


def _sliding_threshold(run: MeasuredRun, interval: float, velocity: np.ndarray) -> float:
    """Sliding speed above which a block slips, m/s: beyond the contact's own and the noise's.

    velocity : (n,) of the block, m/s: slow rigs have slow contacts
    """
    window = _window(CUBIC_REACH / run.natural_frequency, interval)
    noise = run.noise["x"] * float(np.linalg.norm(savgol_coeffs(window, 3, 1, interval)))
    fastest = float(np.percentile(np.abs(run.surface_speed - velocity), SLIP_PERCENTILE))
    own = max(min(LEAST_SLIDING, SLOW_PART * fastest), LEAST_SLIDING_SHARE * abs(run.surface_speed))
    return max(own, VELOCITY_SIGMAS * noise)


def _frequency(x: np.ndarray, interval: float, run: MeasuredRun) -> float:
    """Frequency of the swings, rad/s: as stated, or as they are where springs are far stiffer.

    From the slope of x'' over x where the block moves against the surface: of noise alone, as a
    block has that slides at rest, it is that of the smoothing.
    """
    stated = run.natural_frequency
    if np.std(x) < MOVES * run.noise["x"]:
        return stated
    place, velocity, acceleration = derivatives(x, interval, 0.5 * CUBIC_REACH / stated, 3)
    moving = np.abs(run.surface_speed - velocity) > 0.5 * abs(run.surface_speed)
    if moving.sum() < 10 or np.ptp(place[moving]) == 0.0:
        return stated
    omega = float(np.sqrt(max(-np.polyfit(place[moving], acceleration[moving], 1)[0], 0.0)))
    return omega if omega > FAR_STIFFER * stated else stated


def stretches(inside: np.ndarray) -> list[tuple[int, int]]:
    """(first, last + 1) of every run of true values."""
    steps = np.diff(np.pad(inside.astype(int), 1))
    return list(zip(np.flatnonzero(steps == 1), np.flatnonzero(steps == -1), strict=True))


def is_coarse(run: MeasuredRun) -> bool:
    """Whether the samples are too far apart for the motion in slip."""
    return run.natural_frequency * run.motion.interval > COARSEST


def with_rows(runs: Sequence[MeasuredRun]) -> list[MeasuredRun]:
    """Runs whose rows are asked: those of fine samples, all where these are too few."""
    fine = [run for run in runs if not is_coarse(run)]
    is_enough = sum(not run.hold_out for run in fine) >= LEAST_FINE
    return fine if is_enough else list(runs)


def thinned(run: MeasuredRun) -> MeasuredRun:
    """The run with means of neighbouring samples, where there are far more than its swings need."""
    if run.track is None:
        return run
    track = run.motion
    each = int(FINE_ENOUGH / run.natural_frequency / track.interval)
    if each < 2:
        return run
    bins = ((track.time - track.time[0]) / (each * track.interval)).astype(int)
    kept, place, count = np.unique(bins, return_inverse=True, return_counts=True)

    def mean(values: np.ndarray) -> np.ndarray:
        seen = np.isfinite(values)
        total = np.bincount(place[seen], values[seen], kept.size)
        with np.errstate(invalid="ignore"):
            return total / np.bincount(place[seen], minlength=kept.size)

    coarse: dict[str, Any] = {name: mean(track[name]) for name in track.channels}
    noise = {name: value / np.sqrt(np.median(count)) for name, value in run.noise.items()}
    return replace(run, noise=noise, track=replace(track, time=mean(track.time), **coarse))
