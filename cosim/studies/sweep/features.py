"""What a researcher wants to know of one run, as a row of numbers.

Means, extremes and spread are those of the constant-speed part: from the end of the surface's
speed ramp to the end of the run. They are the numbers of its summary, with some more.
"""

import math
from typing import NamedTuple

from stickslip.packaged import packaged_tables

from cosim.report import heat_numbers as heat
from cosim.report.columns import Data
from cosim.report.contents import ramp_end, slip_intervals
from cosim.report.run_summary import after_ramp, mean_of_cubics


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


def features(dataset: Data) -> dict[str, float]:
    """`FEATURES` of a complete run, of a coupled one `ALL`; NaN where there is nothing to take.

    A run that ends before the surface has its speed has no constant-speed part.
    """
    found = _motion(dataset) | {
        "heat": heat.last(dataset, "heat"),
        "sliding_distance": heat.growth(dataset, "sliding_distance"),
        "energy_residual": heat.largest_of(dataset, "energy_residual"),
    }
    if "heat_received" in dataset:
        found |= _heat(dataset)
    known = {name: number for name, number in found.items() if number is not None}
    return {name: float(known.get(name, math.nan)) for name in ALL if name in found}


def _motion(dataset: Data) -> dict[str, float | None]:
    """Of the constant-speed part; None where there is none, or nothing of the kind in it."""
    late = dataset.sel(time=slice(ramp_end(dataset), None))
    if late.sizes["time"] < 2:
        return {name: None for name in FEATURES}
    motion, slips = after_ramp(dataset), slip_intervals(dataset)
    time, mean = late["time"].values, motion["mean_x"]
    # slips with both ends in the window
    whole = slips[(slips[:, 0] >= time[0]) & (slips[:, 1] < time[-1])]
    away = late["x"].values - mean  # the variance by its definition: no difference of large numbers
    variance = mean_of_cubics(time, away * away, 2.0 * away * late["vx"].values)
    return {
        "x_mean": mean,
        "x_min": motion["min_x"],
        "x_max": motion["max_x"],
        "x_std": math.sqrt(max(variance or 0.0, 0.0)),
        "y_mean": motion["mean_y"],
        "phi_max": math.radians(motion["max_rotation_deg"] or 0.0),
        "frequency": motion["frequency"],
        "slip_time": heat.mean_of(whole[:, 1] - whole[:, 0]),
        "slip_share": motion["slip_share"],
        # the force jumps at re-stick, so the rows' mean is first order
        "friction_coefficient": (motion["mean_friction_force_x"] or 0.0) / heat.normal_force(late),
        "kinetic_coefficient": heat.mean_of(heat.friction_coefficient(late)),
    }


def _heat(dataset: Data) -> dict[str, float | None]:
    rises = heat.temperatures(dataset)
    late = dataset["interface_temperature"].values[dataset["time"].values >= ramp_end(dataset)]
    return {
        "interface_rise": rises["interface"]["end_rise"],
        "interface_drift": float(late[-1] - late[0]) if late.size > 1 else None,
        "belt_entry_rise": rises["belt_entry"]["end_rise"],
        "ice_face_rise": rises["ice_face"]["end_rise"],
        "belt_share": heat.last(dataset, "belt_share"),
        "melted_mass": heat.last(dataset, "melted_mass"),
        "heat_residual": heat.largest_of(dataset, "heat_residual"),
    }
