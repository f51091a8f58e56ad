"""What a researcher wants to know of one run, as a row of numbers.

Means, extremes and spread are those of the constant-speed part: from the end of the surface's
speed ramp to the end of the run. The samples carry velocities, so integrals and extremes come from
the cubic through positions and velocities of two neighbouring rows (fourth order in their
distance); slip times, shares and the frequency come from the located events.
"""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicHermiteSpline
from stickslip import Trajectory
from stickslip.packaged import packaged_tables
from stickslip.packing import GRAVITY
from stickslip.trajectory import break_away_frequency, slip_share

Array = NDArray[np.float64]


class Feature(NamedTuple):
    """What a number of a run is; `features.toml` says what the fields are."""

    unit: str
    long_name: str
    label: str
    factor: float = 1.0
    usual: bool = False
    nothing: float = 0.0
    coupled: bool = False


_TABLES = packaged_tables(__package__, "features.toml")
#: All that is told of a coupled run; of a run of the mechanics alone.
ALL = {name: Feature(**entries) for name, entries in _TABLES.items()}
FEATURES = {name: one for name, one in ALL.items() if not one.coupled}


def features(run: Trajectory) -> dict[str, float]:
    """`FEATURES` of a complete run; NaN where there is nothing to take one from.

    A run that ends before the surface has its speed has no constant-speed part.
    """
    numbers = dict.fromkeys(FEATURES, math.nan)
    numbers |= {
        "heat": float(run["heat"][-1]),
        "sliding_distance": float(run["sliding_distance"][-1]),
        "energy_residual": float(np.max(np.abs(run["energy_residual"]))),
    }
    begin = run.parameters.surface.run_up_time
    late = run.time >= begin
    if np.count_nonzero(late) < 2:
        return numbers
    return numbers | _positions(run, late) | _phases(run, late) | _coefficients(run, late)


def _positions(run: Trajectory, late: NDArray[np.bool_]) -> dict[str, float]:
    time, x, vx = run.time[late], run["x"][late], run["vx"][late]
    mean = _mean(time, x, vx)
    away = x - mean  # the variance by its definition: no difference of large numbers
    low, high = _extremes(time, x, vx)
    turned = _extremes(time, run["phi"][late], run["omega"][late])
    return {
        "x_mean": mean,
        "x_min": low,
        "x_max": high,
        "x_std": math.sqrt(max(_mean(time, away * away, 2.0 * away * vx), 0.0)),
        "y_mean": _mean(time, run["y"][late], run["vy"][late]),
        "phi_max": max(abs(angle) for angle in turned),
    }


def _phases(run: Trajectory, late: NDArray[np.bool_]) -> dict[str, float]:
    time, mode = run.time[late], run["mode"][late]
    times, modes = run.events[:, 0], run.events[:, 1]
    inside = (times >= time[0]) & (times <= time[-1])
    times, modes = times[inside], modes[inside]
    # slip phases with both ends in the window
    whole = np.diff(times)[(modes[:-1] == 1.0) & (modes[1:] == 0.0)]
    return {
        "frequency": break_away_frequency(times[modes == 1.0]),
        "slip_time": float(whole.mean()) if whole.size else math.nan,
        "slip_share": slip_share(time, mode, run.events),
    }


def _coefficients(run: Trajectory, late: NDArray[np.bool_]) -> dict[str, float]:
    """Friction over normal force; the force jumps at re-stick, so the rows' mean is first order."""
    normal = run.parameters.rig.mass * GRAVITY
    time, along = run.time[late], run["friction_force_x"][late]
    size = np.hypot(along, run["friction_force_y"][late])
    slipping = run["mode"][late] == 1.0
    return {
        "friction_coefficient": float(np.trapezoid(along, time) / (time[-1] - time[0]) / normal),
        "kinetic_coefficient": float(size[slipping].mean() / normal)
        if slipping.any()
        else math.nan,
    }


def _extremes(time: Array, value: Array, slope: Array) -> tuple[float, float]:
    """Smallest and largest value of the cubics through values and slopes (n,)."""
    cubic = CubicHermiteSpline(time, value, slope)
    turns = cubic.derivative().roots(discontinuity=False, extrapolate=False)
    # NaN stands for a flat stretch, whose value is that of its rows
    every = np.append(value, cubic(turns[np.isfinite(turns)]))
    return float(every.min()), float(every.max())


def _mean(time: Array, value: Array, slope: Array) -> float:
    """Mean over time (n,) of the cubics through values and slopes (n,)."""
    cubic = CubicHermiteSpline(time, value, slope)
    return float(cubic.integrate(time[0], time[-1]) / (time[-1] - time[0]))
