"""Whether mass, springs and surface speed are in SI units: seen before anything is smoothed.

Times and places that cannot be are refused when they are read (`data.units`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from cosim.gap.data import MeasuredRun
from cosim.gap.data.units import cycle_of, friction_of, velocity_of
from cosim.gap.result import Doubt

#: Sticks only make cycles longer than free vibrations, hardening springs shorter by a factor of
#: two: cycles that are shorter than this part of one are of another mass, or of other springs.
SHORT_CYCLE = 1.0 / 3.0
#: A surface that is so many times faster than x ever moves, while the springs' force swings by this
#: part of the weight: x would have to move at 0.005 g / omega, a few mm/s, at least.
UNIT_SPEED, SWINGS = 300.0, 0.01


def doubts_of_units(runs: Sequence[MeasuredRun]) -> list[Doubt]:
    """One for each run whose mass and springs, or surface speed, cannot be in SI units."""
    found = [(run.name, _wrong(run)) for run in runs]
    return [Doubt("units", f"{name}: {text}", (name,), True) for name, text in found if text]


def _wrong(run: MeasuredRun) -> str:
    """What is in another unit, and in which; "" for nothing."""
    period, cycle = 2.0 * math.pi / run.natural_frequency, cycle_of(run)
    if cycle < SHORT_CYCLE * period:
        free = f"the free block of {run.mass:g} kg on springs of {run.stiffness:g} N/m swings in"
        return f"x swings in {cycle:.3g} s, but {free} {period:.3g} s: mass in g, springs in N/mm?"
    fastest = float(np.nanquantile(np.abs(velocity_of(run)[0]), 0.99))
    if friction_of(run) > SWINGS and abs(run.surface_speed) > UNIT_SPEED * fastest:
        return f"surface_speed = {run.surface_speed:g} m/s, but x moves at {fastest:.2g} m/s: mm/s?"
    return ""
