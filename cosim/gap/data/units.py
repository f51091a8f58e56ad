"""Whether numbers can be in SI units, by what the rig can do."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from cosim.gap.data.campaign_file import Rig
from cosim.gap.data.errors import CampaignError
from cosim.gap.data.measured import MeasuredRun, Track

GRAVITY = 9.81
#: Swing of the spring force over weight that no contact without glue gives.
MOST_FRICTION = 5.0
#: Swing of the spring force over weight below which mass or stiffness are doubtful.
LEAST_FRICTION = 1e-4
LENGTHS = {"millimetres": 1e3, "centimetres": 1e2, "micrometres": 1e6}
#: What is usual of the same swing, and of y's part of a spring's length.
USUAL_FRICTION, USUAL_PART = (0.05, 2.0), (1e-6, 0.5)
TIMES = {"milliseconds": 1e3, "microseconds": 1e6}
#: Part of a free vibration's period that two samples may at most be apart.
COARSEST = 0.5
#: Free vibrations that a record holds: with less than half of one there is no motion to look at;
#: more than hours of a usual rig are another unit of time, or would be fitted for days.
FEWEST_PERIODS, MOST_PERIODS = 0.5, 20_000.0


def check_units(file: Path, run: MeasuredRun, track: Track, rig: Rig) -> list[str]:
    """Remarks on one run; CampaignError where the numbers are in another unit."""
    period = 2.0 * math.pi / run.natural_frequency
    _check_time(file, track.interval, period)
    _check_span(file, track.duration, period)
    swing = _swing(track.x)
    if swing == 0.0:
        raise CampaignError(f"{file}: column x: does not change, allowed is a measured motion")
    friction = run.total_stiffness * swing / (run.mass * GRAVITY)
    if friction > MOST_FRICTION:
        raise CampaignError(
            f"{file}: column x: swings by {swing:.4g} m, a spring force of {friction:.3g} times "
            f"the weight; allowed is metres ({_length_hint(friction, USUAL_FRICTION)}check mass "
            "and stiffness)"
        )
    if track.y is not None and _swing(track.y) > rig.spring_length:
        raise CampaignError(
            f"{file}: column y: swings by {_swing(track.y):.4g} m, more than rig.spring_length = "
            f"{rig.spring_length:g} m; allowed is metres "
            f"({_length_hint(_swing(track.y) / rig.spring_length, USUAL_PART)}check the rig)"
        )
    if track.phi is not None and np.nanmax(np.abs(track.phi)) > 2.0 * math.pi:
        raise CampaignError(
            f"{file}: column phi: reaches {np.nanmax(np.abs(track.phi)):.4g} rad, more than a turn "
            "on four springs; allowed is radians (are these degrees?)"
        )
    if friction < LEAST_FRICTION:
        return [
            f"{file.name}: the spring force swings by only {friction:.1e} of the weight; check "
            "mass, stiffness and the unit of x"
        ]
    return []


def _check_time(file: Path, interval: float, period: float) -> None:
    if interval <= COARSEST * period:
        return
    units = [name for name, factor in TIMES.items() if interval / factor <= COARSEST * period / 5]
    hint = f" (are these {units[0]}?)" if units and interval > 5 * period else ""
    raise CampaignError(
        f"{file}: column t: {interval:.4g} s between samples, the block's free vibration takes "
        f"{period:.3g} s; allowed is at most half of it, in seconds{hint}"
    )


def _check_span(file: Path, span: float, period: float) -> None:
    if span < FEWEST_PERIODS * period:
        again = 1e3 * span > 4.0 * FEWEST_PERIODS * period
        hint = " (are these thousandths of seconds, divided by 1000 once more?)" if again else ""
        raise CampaignError(
            f"{file}: column t: covers {span:.4g} s, the block's free vibration takes "
            f"{period:.3g} s; allowed is at least half of it, in seconds{hint}"
        )
    if span > MOST_PERIODS * period:
        raise CampaignError(
            f"{file}: column t: covers {span:.4g} s, which is {span / period:.3g} free vibrations "
            f"of the block (each {period:.3g} s, by mass and stiffness); allowed are up to "
            f"{MOST_PERIODS:g}: check mass and stiffness, or give a part of the record"
        )


def _swing(values: np.ndarray) -> float:
    """Range of a channel without its most extreme samples."""
    low, high = np.nanquantile(values, (0.01, 0.99))
    return float(high - low)


def _length_hint(value: float, usual: tuple[float, float]) -> str:
    """The unit in which a value would be usual."""
    units = [name for name, factor in LENGTHS.items() if usual[0] < value / factor < usual[1]]
    return f"are these {units[0]}?, " if units else ""
