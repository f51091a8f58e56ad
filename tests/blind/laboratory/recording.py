"""The camera: frames, noise, gaps, outliers, a zero of each run's own; and the faults it can have.

A fault maps the path before the camera to the path on its film: an array of times, s, and a path
(n, 2), m, to the times and the path as written. The names are those of the product's answers.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Path = NDArray[np.float64]
Fault = Callable[[NDArray, Path, float, float], tuple[NDArray, Path]]


@dataclass(frozen=True)
class Tracker:
    """How a campaign is recorded. SI units."""

    rate: float  # frames a second
    noise: float  # m, white
    turn_noise: float  # rad
    stated: bool  # campaign.toml tells the noise
    jitter: float  # s, of the frames' (true) times
    gaps: int  # stretches without frames, in each run
    outliers: float  # share of the frames
    zero: float  # m, standard deviation of a run's own zero
    with_y: bool
    with_phi: bool


def draw_tracker(rng: np.random.Generator, planar: bool, bench: bool) -> Tracker:
    """Half of the trackers are clean: noise and zeros only."""
    clean = rng.random() < 0.5
    rate = float(rng.choice((60, 100, 120, 200, 240)))
    noise = float(rng.uniform(1e-5, 4e-5) if bench else rng.uniform(5e-5, 3e-4))
    return Tracker(
        rate=rate,
        noise=float(f"{noise:.2g}"),
        turn_noise=float(f"{rng.uniform(5e-4, 3e-3):.2g}"),
        stated=bool(rng.random() < 0.7),
        jitter=0.0 if clean else float(rng.choice((0.0, 0.05, 0.2))) / rate,
        gaps=0 if clean else int(rng.integers(0, 4)),
        outliers=0.0 if clean else float(rng.choice((0.0, 0.001, 0.004))),
        zero=float(rng.choice((0.0, 3.0))) * noise,
        with_y=planar,
        with_phi=planar and bool(rng.random() < 0.5),
    )


def frame_times(tracker: Tracker, duration: float, rng: np.random.Generator) -> NDArray:
    """True times of the frames, s."""
    t = np.arange(int(duration * tracker.rate)) / tracker.rate
    shift = np.clip(rng.normal(0, 1, t.size) * tracker.jitter * tracker.rate, -0.4, 0.4)
    t = np.clip(t + shift / tracker.rate, 0.0, duration)
    keep = np.ones(t.size, bool)
    for _ in range(tracker.gaps):
        first = int(rng.integers(t.size // 10, 9 * t.size // 10))
        keep[first : first + int(rng.uniform(0.05, 0.5) * tracker.rate)] = False
    return t[keep]


def scale(t: NDArray, path: Path, amount: float, duration: float):
    return t, path * (1 + amount)


def clock(t: NDArray, path: Path, amount: float, duration: float):
    return t * (1 + amount), path


def rotation(t: NDArray, path: Path, amount: float, duration: float):
    c, s = np.cos(amount), np.sin(amount)
    return t, path @ np.array([[c, s], [-s, c]])


def creep(t: NDArray, path: Path, amount: float, duration: float):
    """A camera that settles on its stand: fast at first, then slowly."""
    course = 0.5 * t / duration + 0.5 * (1 - np.exp(-5 * t / duration))
    return t, path + amount * course[:, None] * np.array([1.0, 0.3])


def sagging(t: NDArray, path: Path, amount: float, duration: float):
    """A camera whose arm gives way as the square root of time."""
    return t, path + amount * np.sqrt(t / duration)[:, None] * np.array([1.0, -0.5])


def rolling_shutter(t: NDArray, path: Path, amount: float, duration: float):
    """Read out line by line along x: what is 0.1 m further is seen `amount` seconds later."""
    seen = t + amount * path[:, 0] / 0.1
    return t, np.column_stack([np.interp(seen, t, axis) for axis in path.T])


def smoothing(t: NDArray, path: Path, amount: float, duration: float):
    """A tracker's filter: Gaussian, `amount` seconds of standard deviation."""
    return t, _filtered(t, path, amount, causal=False)


def averaging(t: NDArray, path: Path, amount: float, duration: float):
    """A tracker's filter: the mean of a window whose standard deviation is `amount` seconds."""
    return t, _filtered(t, path, amount, causal=False, window=True)


def lagging(t: NDArray, path: Path, amount: float, duration: float):
    """A tracker's filter: exponential, of the past alone, `amount` seconds."""
    return t, _filtered(t, path, amount, causal=True)


def _filtered(t: NDArray, path: Path, amount: float, causal: bool, window: bool = False) -> Path:
    step = 1e-3
    grid = np.arange(t[0], t[-1] + step, step)
    half = int(np.ceil(10 * amount / step))
    u = np.arange(-half, half + 1) * step
    kernel = np.exp(-0.5 * (u / amount) ** 2)
    if window:
        kernel = (np.abs(u) < np.sqrt(3) * amount).astype(float)
    if causal:
        kernel = np.where(u < 0, 0.0, np.exp(-u / amount)) * np.where(u == 0, 0.5, 1.0)
    kernel /= kernel.sum()
    margin = u.size // 2
    columns = []
    for axis in path.T:
        fine = np.pad(np.interp(grid, t, axis), margin, mode="edge")
        columns.append(np.interp(t, grid, np.convolve(fine, kernel, mode="valid")[: grid.size]))
    return np.column_stack(columns)


def quantisation(t: NDArray, path: Path, amount: float, duration: float):
    return t, np.round(path / amount) * amount


# fault: how it can show; the amounts it is drawn from; whether the amount is sought for a size
FAULTS: dict[str, tuple[tuple[Fault, ...], tuple[float, float], bool]] = {
    "measurement.scale": ((scale,), (0.025, 0.04), False),
    "measurement.clock": ((clock,), (0.025, 0.04), False),
    "measurement.rotation": ((rotation,), (0.03, 0.1), False),
    "measurement.drift": ((creep,), (5e-4, 1e-2), True),
    "measurement.latency": ((rolling_shutter,), (5e-3, 0.04), True),
    "measurement.smoothing": ((smoothing, lagging), (5e-3, 0.05), True),
    "measurement.quantisation": ((quantisation,), (2e-4, 4e-3), True),
}

FRESH_FAULTS = FAULTS | {
    "measurement.drift": ((sagging,), (5e-4, 1e-2), True),
    "measurement.smoothing": ((averaging,), (5e-3, 0.05), True),
}


def film(
    rows: NDArray,
    sample: float,
    tracker: Tracker,
    fault: tuple[Fault, float] | None,
    rng: np.random.Generator,
) -> dict[str, NDArray]:
    """Columns of a run's file, from rows every `sample`, s."""
    dense = np.arange(len(rows)) * sample
    duration = float(dense[-1])
    t = frame_times(tracker, duration, rng)
    path = np.column_stack([np.interp(t, dense, rows[:, j]) for j in range(2)])
    noise = rng.normal(0, tracker.noise, path.shape)
    written = t
    if fault:
        what, amount = fault
        if what is quantisation:  # what the chip resolves, noise and all
            path = path + noise
            noise = np.zeros_like(noise)
        elif what is rolling_shutter:
            full = what(dense, rows[:, :2], amount, duration)[1]
            path = np.column_stack([np.interp(t, dense, axis) for axis in full.T])
        if what is not rolling_shutter:
            written, path = what(t, path, amount, duration)
    path = path + noise + rng.normal(0, tracker.zero, 2)
    wrong = rng.random(path.shape) < tracker.outliers
    path[wrong] += (rng.choice((-1, 1), wrong.sum()) * rng.uniform(10, 60, wrong.sum())) * (
        tracker.noise
    )
    columns = {"t": written, "x": path[:, 0]}
    if tracker.with_y:
        columns["y"] = path[:, 1]
    if tracker.with_phi:
        columns["phi"] = np.interp(t, dense, rows[:, 2]) + rng.normal(0, tracker.turn_noise, t.size)
    return columns
