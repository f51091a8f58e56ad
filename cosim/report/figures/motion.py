"""Position and rotation of the block over time."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from ..style import (
    BLUE,
    GREEN,
    RED,
    at_least,
    line,
    readable,
    slip_patch,
    styled,
    time_panels,
    title,
)

# what a camera over the rig would just see; smaller motions are not blown up to fill the axis
SMALLEST_LENGTH = 1e-4
SMALLEST_ANGLE_DEG = 0.1
# m or rad: below this a motion is told in words instead of drawn as a flat line
NOTHING = 1e-7
COLOURS = {"x": BLUE, "y": GREEN, "phi": RED}


@styled
def draw_motion(dataset: xr.Dataset) -> Figure:
    """x, y and phi over time, slip shaded; the last cycles beside the whole run.

    Where the block does not leave its line or does not turn, a line of text says so.
    """
    still = [name for name in ("y", "phi") if not _moves(dataset, name)]
    shown = [(name, colour) for name, colour in COLOURS.items() if name not in still]
    figure, axes = time_panels(dataset, rows=len(shown))
    time = dataset["time"].values
    for row, (name, colour) in enumerate(shown):
        if name == "phi":
            values, label, smallest = np.degrees(dataset[name].values), "φ [°]", SMALLEST_ANGLE_DEG
        else:
            scaled = readable(dataset[name].values, "m", floor=1e-3)
            values = scaled(dataset[name].values)
            label, smallest = f"{name} [{scaled.unit}]", scaled.factor * SMALLEST_LENGTH
        for panel in axes[row]:
            line(panel, time, values, color=colour)
        at_least(axes[row, 0], smallest)
        axes[row, 0].set_ylabel(label)
    figure.align_ylabels(axes[:, 0])
    title(figure, "Motion of the block", dataset)
    if still:
        words = " and ".join({"y": "y", "phi": "φ"}[name] for name in still)
        figure.supxlabel(f"{words}: 0 throughout, not drawn", x=0.008, ha="left", fontsize=9)
    figure.legend(handles=[slip_patch()], loc="outside upper right")
    return figure


def _moves(dataset: xr.Dataset, name: str) -> bool:
    return bool(np.nanmax(np.abs(dataset[name].values), initial=0.0) > NOTHING)
