"""What sticks say of the set-up: whether there are any, how fast they move, how straight."""

from __future__ import annotations

import math

import numpy as np

from cosim.gap.data.cycles import cycle_features
from cosim.gap.data.measured import MeasuredRun

#: Part of a track in stick from which on there is no slip in it.
ALL_STICK = 0.95
#: The speed in stick is off the set-point: by so many standard errors, and this part of it.
SPEED_ERRORS, SPEED_PART = 4.0, 0.02
#: Scatter about the sticks' lines, in units of the noise, that is more than noise; shorter sticks
#: than this many samples say nothing of it.
SCATTER, LONG = 1.25, 20


def stick_remarks(run: MeasuredRun) -> list[str]:
    """Remarks on a run whose sticks are found, without its name."""
    if not any(math.isfinite(stick.start_sd) for stick in run.sticks):
        if never_slips(run):
            return ["no slip is seen, it says nothing of kinetic friction"]
        return ["no stick is seen after the start"]
    remarks = []
    off = stick_speed_off(run)
    if off is not None:
        remarks.append(
            f"in stick x moves at {off:.3g} of the surface_speed given: if the surface ran so, say "
            f"surface_speed = {off * run.surface_speed:.4g} in this [[run]]; if it is as much in "
            f"every run, the camera's scale may be off, and x is to be divided by {off:.3g}"
            f"{'; else the contact creeps' if off < 1.0 else ''}"
        )
    scatter = line_scatter(run) / run.noise["x"]
    if scatter > SCATTER:
        remarks.append(
            f"scatter about the sticks' straight lines is {scatter:.2g} times the "
            "noise of a sample: creep, or noise that is not white"
        )
    return remarks


def stick_speed_off(run: MeasuredRun) -> float | None:
    """Speed in stick in parts of the set-point, where it is surely another; else None."""
    speed = cycle_features(run).stick_speed
    off = abs(speed.value - run.surface_speed)
    if off > max(SPEED_ERRORS * speed.error, SPEED_PART * abs(run.surface_speed)):
        return float(speed.value / run.surface_speed)
    return None


def never_slips(run: MeasuredRun) -> bool:
    """Whether the block goes with the surface all the time."""
    if any(math.isfinite(stick.start_sd) for stick in run.sticks):
        return False
    return sum(stick.duration for stick in run.sticks) > ALL_STICK * run.motion.duration


def line_scatter(run: MeasuredRun) -> float:
    """Standard deviation of x about a straight line through each long stick, m; NaN without one."""
    squares, freedom = 0.0, 0
    for stick in run.sticks:
        rows = slice(stick.first, stick.last + 1)
        there = np.isfinite(run.motion.x[rows])
        time, x = run.motion.time[rows][there], run.motion.x[rows][there]
        if len(x) < LONG:
            continue
        line = np.polynomial.Polynomial.fit(time, x, 1)
        squares += float(np.sum((x - line(time)) ** 2))
        freedom += len(x) - 2
    return math.sqrt(squares / freedom) if freedom else math.nan
