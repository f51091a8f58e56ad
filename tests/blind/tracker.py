"""What a camera makes of a motion: noise, and what else goes wrong with a recording."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .motion import DENSE, Motion

PERIOD = 0.01  # s between frames
LOAD_CELL = 0.02  # N, noise of the force


@dataclass(frozen=True)
class Tracker:
    """How a campaign was recorded."""

    noise: float  # m, white
    stated: bool = True  # campaign.toml tells the noise
    jitter: float = 0.0  # s, scatter of the (true) times of the frames
    gaps: int = 0  # stretches without frames in each run
    outliers: float = 0.0  # part of the frames
    with_y: bool = True
    with_force: bool = False
    start: float = 0.0  # s, what the clock shows at the first frame


def draw_tracker(rng: np.random.Generator, clean: bool, with_y: bool, force: bool) -> Tracker:
    """A tracker: a clean one has white noise only, as a good laboratory's."""
    noise = 2e-4 if rng.random() < 0.5 else round(float(rng.uniform(1e-4, 5e-4)), 6)
    if clean:
        return Tracker(noise, with_y=with_y, with_force=force)
    return Tracker(
        noise=noise,
        stated=bool(rng.random() < 0.7),
        jitter=float(rng.choice((0.0, 5e-4, 2e-3))),
        gaps=int(rng.choice((0, 0, 1, 3))),
        outliers=float(rng.choice((0.0, 0.001, 0.004))),
        with_y=with_y and bool(rng.random() < 0.6),
        with_force=force,
        start=float(rng.choice((0.0, rng.uniform(-5, 100)))),
    )


def frame_times(tracker: Tracker, duration: float, rng: np.random.Generator) -> np.ndarray:
    """Times of the frames since the motion began, s; increasing."""
    t = np.arange(round(duration / PERIOD)) * PERIOD
    if tracker.jitter:
        t = t + np.clip(rng.normal(0, tracker.jitter, t.size), -0.4 * PERIOD, 0.4 * PERIOD)
    keep = np.ones(t.size, bool)
    for _ in range(tracker.gaps):
        begin = rng.integers(50, t.size - 50)
        keep[begin : begin + rng.integers(5, 50)] = False
    return np.clip(t[keep], 0.0, None)


def frames(motion: Motion, tracker: Tracker, rng: np.random.Generator) -> dict[str, np.ndarray]:
    """Columns of one run's file."""
    dense = (1 + np.arange(len(motion.rows))) * DENSE
    t = frame_times(tracker, dense[-1], rng)
    columns = {"t": t + tracker.start}
    shown = {"x": motion.x, "y": motion.rows[:, 1]} if tracker.with_y else {"x": motion.x}
    for name, path in shown.items():
        values = np.interp(t, dense, path) + rng.normal(0, tracker.noise, t.size)
        wrong = rng.random(t.size) < tracker.outliers
        values[wrong] += rng.choice((-1, 1), wrong.sum()) * rng.uniform(0.005, 0.02, wrong.sum())
        columns[name] = values
    if tracker.with_force:  # what the springs are stretched by, positive with x
        pull = -np.interp(t, dense, motion.rows[:, 6])
        columns["force"] = pull + rng.normal(0, LOAD_CELL, t.size)
    return columns
