"""The figure of the README: `python tests/docs/site/making/overview.py RESULT.nc FIGURE.png`.

RESULT.nc is what `stickslip run` writes.
"""

import sys

import numpy as np
import xarray as xr

from cosim.report.contents import slip_intervals
from cosim.report.palette import BLUE, GREEN, INK, RED, SLIP
from cosim.report.style import panels, png, styled

PANELS = (
    ("x", "x [mm]", 1e3, BLUE),
    ("y", "y [mm]", 1e3, GREEN),
    ("phi", "φ [°]", 180.0 / np.pi, RED),
    ("heat", "friction heat [J]", 1.0, INK),
    ("interface_temperature", "contact [K over air]", 1.0, RED),
)


@styled
def draw(dataset: xr.Dataset):
    """Three degrees of freedom, the heat of friction, and how the contact warms."""
    figure, axes = panels(len(PANELS), 1, height=1.25, sharex=True)
    for (name, label, factor, colour), panel in zip(PANELS, axes[:, 0], strict=True):
        values = dataset[name].values
        if name == "interface_temperature":
            values = values - values[0]
        for begin, end in slip_intervals(dataset):
            panel.axvspan(begin, end, color=SLIP, lw=0)
        panel.plot(dataset["time"], factor * values, color=colour, lw=1.1)
        panel.set_ylabel(label, fontsize=8)
        panel.set_xlim(0, float(dataset["time"][-1]))
    axes[-1, 0].set_xlabel("t [s]; shaded: slip")
    figure.align_ylabels(axes[:, 0])
    return figure


if __name__ == "__main__":
    with xr.open_dataset(sys.argv[1]) as data:
        image = png(draw(data))
    with open(sys.argv[2], "wb") as file:
        file.write(image)
