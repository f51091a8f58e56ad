"""Whether numbers can be in SI units, by what the rig can do."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from stickslip.packing import GRAVITY

from cosim.gap.data.campaign_file import Rig
from cosim.gap.data.errors import CampaignError
from cosim.gap.data.measured import MeasuredRun, Track

#: Swing of the spring force over weight that no contact without glue gives; and below which mass or
#: stiffness are doubtful.
MOST_FRICTION, LEAST_FRICTION = 5.0, 1e-4
LENGTHS = {"mm": 1e3, "cm": 1e2, "um": 1e6}
#: What is usual of the same swing, and of y's part of a spring's length.
USUAL_FRICTION, USUAL_PART = (0.05, 2.0), (1e-6, 0.5)
TIMES = {"milliseconds": 1e3, "microseconds": 1e6}
#: Part of a free vibration's period that two samples may at most be apart.
COARSEST = 0.5
#: Free vibrations that a record holds: with less than half of one there is no motion to look at;
#: more than hours of a usual rig are another unit of time, or would be fitted for days.
FEWEST_PERIODS, MOST_PERIODS = 0.5, 20_000.0
#: Part of a free vibration over which x is seen to move.
LAG = 1.0 / 8.0


def check_units(run: MeasuredRun, rig: Rig) -> list[str]:
    """Remarks on one run; CampaignError where the numbers are in another unit."""
    track = run.motion
    if wrong := _of_time(track, 2.0 * math.pi / run.natural_frequency) or _of_places(run, rig):
        raise CampaignError(f"{run.file}: column {wrong}")
    if (friction := friction_of(run)) >= LEAST_FRICTION:
        return []
    little = f"the spring force swings by only {friction:.1e} of the weight"
    return [f"{Path(str(run.file)).name}: {little}; check mass, stiffness and the unit of x"]


def _of_time(track: Track, period: float) -> str:
    """What is wrong with the times; "" for nothing. period : of the free block, s."""
    free, span = f"the block's free vibration takes {period:.3g} s", track.duration
    interval = track.interval
    if interval > COARSEST * period:
        units = [name for name, part in TIMES.items() if interval / part <= COARSEST * period / 5]
        hint = f" (are these {units[0]}?)" if units and interval > 5 * period else ""
        return f"t: {interval:.4g} s between samples, {free}; allowed is at most half of it{hint}"
    if span < FEWEST_PERIODS * period:
        again = 1e3 * span > 4.0 * FEWEST_PERIODS * period
        hint = " (thousandths of seconds, divided by 1000 once more?)" if again else ""
        return f"t: covers {span:.4g} s, {free}; allowed is at least half of it{hint}"
    if span > MOST_PERIODS * period:
        most = f"{MOST_PERIODS:g} times that: check mass and stiffness, or give a part of it"
        return f"t: covers {span:.4g} s, {free}; allowed are up to {most}"
    return ""


def _of_places(run: MeasuredRun, rig: Rig) -> str:
    """What is wrong with x, y or phi; "" for nothing."""
    track, friction = run.motion, friction_of(run)
    if friction == 0.0:
        return "x: does not change, allowed is a measured motion"
    if friction > MOST_FRICTION:
        allowed = f"metres ({_hint('x', friction, USUAL_FRICTION)}check mass and stiffness)"
        force = f"a spring force of {friction:.3g} times the weight"
        return f"x: swings by {swing(track.x):.4g} m, {force}; allowed is {allowed}"
    if track.y is not None and (part := swing(track.y) / rig.spring_length) > 1.0:
        springs = f"swings by {part:.3g} times rig.spring_length"
        return f"y: {springs}; allowed is metres ({_hint('y', part, USUAL_PART)}check the rig)"
    if track.phi is not None and (turn := np.nanmax(np.abs(track.phi))) > 2.0 * math.pi:
        return f"phi: reaches {turn:.4g} rad, allowed is radians up to a turn (are these degrees?)"
    return ""


def _hint(channel: str, value: float, usual: tuple[float, float]) -> str:
    """The unit in which a value would be usual, and how that is said."""
    units = [name for name, factor in LENGTHS.items() if usual[0] < value / factor < usual[1]]
    if not units:
        return ""
    return f'are these {units[0]}? then units.{channel} = "{units[0]}" in campaign.toml; else '


def friction_of(run: MeasuredRun) -> float:
    """Swing of the spring force in parts of the weight."""
    return run.total_stiffness * swing(run.motion.x) / (run.mass * GRAVITY)


def swing(values: np.ndarray) -> float:
    """Range of a channel without its most extreme samples."""
    return float(np.ptp(np.nanquantile(values, (0.01, 0.99))))


def velocity_of(run: MeasuredRun) -> tuple[np.ndarray, float]:
    """Of x, m/s, over a small part of a free vibration, of the samples that there are; that, s."""
    seen = np.isfinite(run.motion.x)
    time, x = run.motion.time[seen], run.motion.x[seen]
    lag = max(1, round(LAG * 2.0 * math.pi / run.natural_frequency / run.motion.interval))
    return (x[lag:] - x[:-lag]) / (time[lag:] - time[:-lag]), lag * run.motion.interval


def cycle_of(run: MeasuredRun) -> float:
    """Median time between upward crossings of the mean of x, s; infinite where there are few."""
    seen = np.isfinite(run.motion.x)
    time, level = run.motion.time[seen], run.motion.x[seen] - np.nanmean(run.motion.x)
    clear = np.abs(level) > max(0.2 * float(np.std(level)), 3.0 * run.noise["x"])
    time, above = time[clear], level[clear] > 0.0
    up = time[1:][above[1:] & ~above[:-1]]
    return float(np.median(np.diff(up))) if up.size > 2 else math.inf
