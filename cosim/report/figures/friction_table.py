"""The table of friction that a run had: its points, what is between them, what the run slid at."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure
from stickslip import friction_coefficient

from cosim.report.columns import Data

from ..contents import mechanics_of
from ..palette import GREY, INK, SERIES, SLIP
from ..style import panels, styled

POINTS = 300
#: Part of the way between two points, and beyond the last, that is drawn.
BEYOND = 1.15


@styled
def draw_friction_table(dataset: Data) -> Figure:
    """mu over the sliding speed, a line for each temperature of the table, with its points.

    Shaded: the speeds at which the run slid. Grey: at the run's own interface temperature at its
    end, where the table is over temperatures too.
    """
    parameters = mechanics_of(dataset)
    friction = parameters.friction
    degrees = friction.table_temperature_degC
    fastest = BEYOND * max(friction.table_speed[-1], float(dataset["sliding_speed"].max()))
    speeds = np.linspace(0.0, fastest, POINTS + 1)[1:]
    figure, ((ax,),) = panels(1, 1, height=3.0, width=7.0)
    sliding = dataset["sliding_speed"].values[dataset["mode"].values == 1]
    if sliding.size:
        ax.axvspan(float(sliding.min()), float(sliding.max()), color=SLIP, label="the run's slips")
    for number, temperature in enumerate(degrees or (None,)):
        colour = SERIES[number % len(SERIES)]
        mu = friction_coefficient(parameters, speeds, temperature)
        row = slice(number * len(friction.table_speed), (number + 1) * len(friction.table_speed))
        said = "table" if temperature is None else f"{temperature:g} °C"
        ax.plot(speeds, mu, color=colour, label=said)
        ax.plot(friction.table_speed, friction.table_mu[row], "o", color=colour)
    if degrees and "interface_temperature" in dataset:
        end = float(dataset["interface_temperature"].values[-1])
        mu = friction_coefficient(parameters, speeds, end)
        ax.plot(speeds, mu, color=GREY, linestyle="--", label=f"{end:.3g} °C, of the run's end")
    ax.axhline(friction.mu_s, color=INK, linewidth=0.8, linestyle=":")
    ax.annotate(
        "μ_s", (1.0, friction.mu_s), xycoords=("axes fraction", "data"), va="bottom", ha="right"
    )
    ax.set(xlabel="sliding speed [m/s]", ylabel="friction coefficient", xlim=(0.0, fastest))
    ax.set_ylim(bottom=0.0)
    figure.suptitle("Table of friction", x=0.01, ha="left")
    figure.legend(loc="outside right upper")
    return figure
