"""A friction map drawn, on logarithmic axes, one curve a temperature; and its page."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from stickslip import friction_coefficient

from cosim.report.page import Picture, render
from cosim.report.style import GREY, INK, SERIES, panels, picture

from .laws import laws_of
from .map import FrictionMap, steady_scenario

#: The law is drawn this far beyond the slowest and the fastest run.
BELOW, ABOVE = 300.0, 5.0
#: Least slope of the law, either sign, at which a regime is named.
NAMED = 0.3


@picture(
    "friction_map",
    "Friction over the speed of sliding. Lines: the law at the ambient temperature. Points: "
    "coupled runs, whose interface is warmer.",
)
def draw_map(found: FrictionMap) -> Figure:
    """Lines: the law at the ambient temperature. Points: coupled runs, interface warmer."""
    figure, ((ax,),) = panels(1, 1, height=4.6, width=8.0)
    speeds = [point.speed for point in found.points]
    wide = np.geomspace(min(speeds) / BELOW, max(speeds) * ABOVE, 400)
    for index, ambient in enumerate(found.ambients):
        law = _draw_ambient(ax, found, ambient, wide, SERIES[index % len(SERIES)])
        if index == 0:
            _name_regimes(ax, wide, law)
        if index == len(found.ambients) - 1:
            _mark_slopes(ax, wide, law)
    ax.set(
        xscale="log",
        yscale="log",
        xlabel="sliding speed [m/s]",
        ylabel="friction coefficient [1]",
        title="lines: the law at the ambient temperature; points: coupled runs",
    )
    low, high = ax.dataLim.intervaly
    ax.set_ylim(low / 1.5, 2.5 * high)  # room for words; a law without speed is a line in it
    figure.legend(loc="outside right upper", title="ambient")
    return figure


def _draw_ambient(
    ax: Axes, found: FrictionMap, ambient: float, speeds: np.ndarray, colour: str
) -> np.ndarray:
    """The law at an ambient temperature, degC, over speeds (n,), and the runs; the law (n,)."""
    points = found.at(ambient)
    case = steady_scenario(found.scenario, points[0].speed, ambient, found.duration)
    law = friction_coefficient(case.mechanics, speeds, ambient)
    ax.plot(speeds, law, color=colour, label=f"{ambient:g} °C".replace("-", "−"))
    ax.plot([p.speed for p in points], [p.friction for p in points], "o", color=colour)
    return law


def _local_slope(speed: np.ndarray, value: np.ndarray) -> np.ndarray:
    return np.gradient(np.log(value), np.log(speed))


def _name_regimes(ax: Axes, speed: np.ndarray, law: np.ndarray) -> None:
    """Above the curve, where the regime is purest; a regime that the law lacks is not named."""
    slope = _local_slope(speed, law)
    places = {}
    if slope.min() < -NAMED:
        places["dry"] = int(len(speed) * 0.06)
        places["boundary"] = int(np.argmin(slope))
    if slope.max() > NAMED:
        places["hydrodynamic"] = int(len(speed) * 0.94)
    if len(places) == 3:
        places["mixed"] = int(np.argmin(law))
    for name, at in places.items():
        # beside a falling or rising curve, above a flat one
        side = 0 if abs(slope[at]) < 0.1 else -int(np.sign(slope[at]))
        ax.annotate(
            name,
            (speed[at], law[at]),
            xytext=(8 * side, 8),
            textcoords="offset points",
            ha={-1: "right", 0: "center", 1: "left"}[side],
            va="bottom",
            color=INK,
        )


def _mark_slopes(ax: Axes, speed: np.ndarray, law: np.ndarray) -> None:
    """Dashed lines of slope -1/2 and +1/2 through the steepest places of the lowest curve."""
    slope = _local_slope(speed, law)
    for at, ideal in ((int(np.argmin(slope)), -0.5), (int(np.argmax(slope)), 0.5)):
        if abs(slope[at]) < NAMED:
            continue
        at = min(at, int(0.85 * len(speed)))  # room for the words
        near = (speed > speed[at] / 6.0) & (speed < speed[at] * 6.0)
        line = 0.75 * law[at] * (speed[near] / speed[at]) ** ideal
        ax.plot(speed[near], line, "--", color=GREY, linewidth=0.9)
        ax.annotate(
            "slope −½" if ideal < 0 else "slope ½",
            (speed[at], 0.75 * law[at]),
            xytext=(-4 if ideal < 0 else 4, -6),
            textcoords="offset points",
            color=GREY,
            va="top",
            ha="right" if ideal < 0 else "left",
        )


def page(found: FrictionMap, picture: Picture, command: str) -> str:
    """HTML of a map, its figure, and the command line that made it."""
    return render(
        "friction_map.html.j2",
        "cosim.studies.friction_map",
        name=found.scenario.name,
        speeds=len({point.speed for point in found.at(found.ambients[0])}),
        duration=found.duration,
        regimes=[found.regimes(ambient) for ambient in found.ambients],
        points=found.points,
        failed=found.failed,
        laws=laws_of(found),
        picture=picture,
        scenario=found.scenario.to_toml(),
        command=command,
    )
