"""A friction map drawn, on logarithmic axes, one curve a temperature; and its page."""

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.patheffects import withStroke
from stickslip import friction_coefficient

from cosim.report.files import write_json, write_table
from cosim.report.page import Picture, render, sentences, texts, tiles_of
from cosim.report.palette import GREY, INK, PALE_GREY, SERIES
from cosim.report.style import logarithmic_x, logarithmic_y, panels, picture
from cosim.studies import FIGURES

from .laws import Measured, measured_beside, own_point
from .laws import differences as differences
from .map import SAME, FrictionMap, steady_scenario

#: The law is drawn this far beyond the slowest and the fastest run.
BELOW, ABOVE = 300.0, 5.0
#: A law that is the same at all speeds only so far: there is nothing else to see beyond.
BESIDE = 2.0
#: Least slope of the law, either sign, at which a regime is named.
NAMED = 0.3


@picture("friction_map", **FIGURES["friction_map"])
def draw_map(found: FrictionMap) -> Figure:
    """Lines: the law at the ambient temperature. Points: coupled runs, interface warmer."""
    figure, ((ax,),) = panels(1, 1, height=5.2, width=9.0)
    speeds = [point.speed for point in found.points]
    wide = np.geomspace(min(speeds) / BELOW, max(speeds) * ABOVE, 400)
    laws = [_law(found, ambient, wide) for ambient in found.ambients]
    is_flat = all(float(np.ptp(law)) <= SAME * float(np.max(law)) for law in laws)
    if is_flat:
        wide = np.geomspace(min(speeds) / BESIDE, max(speeds) * BESIDE, 400)
        laws = [_law(found, ambient, wide) for ambient in found.ambients]
    for index, (ambient, law) in enumerate(zip(found.ambients, laws, strict=True)):
        points, colour = found.at(ambient), SERIES[index % len(SERIES)]
        ax.plot(wide, law, color=colour, label=f"air at {ambient:g} °C".replace("-", "−"))
        ax.plot([p.speed for p in points], [p.friction for p in points], "o", color=colour)
    _name_regimes(ax, wide, laws[0])
    _mark_slopes(ax, wide, laws[-1])
    alike = "at all temperatures of the air" if is_flat else "at the ambient temperature"
    ax.set(
        xscale="log",
        xlabel="sliding speed [m/s]",
        ylabel="friction coefficient [1]",
        title=f"lines: the law {alike}; points: coupled runs",
    )
    measured, own = measured_beside(found.scenario), own_point(found.scenario)
    for each in measured:
        _draw_measured(ax, each, is_own=each == own)
    low, high = ax.dataLim.intervaly
    ax.set_xlim(left=min(speeds) / BELOW)
    if is_flat:
        logarithmic_x(ax)
        ax.set_ylim(0.0, 1.4 * high)
    else:
        logarithmic_y(ax)
        ax.set_ylim(low / 1.5, 2.5 * high)  # room for words
    for each in measured:
        _name_range(ax, each)
    figure.legend(loc="outside lower center", ncols=len(found.ambients))
    return figure


def _law(found: FrictionMap, ambient: float, speeds: np.ndarray) -> np.ndarray:
    """The law at an ambient temperature, degC, over speeds (n,): (n,)."""
    case = steady_scenario(found.scenario, found.at(ambient)[0].speed, ambient, found.duration)
    return friction_coefficient(case.mechanics, speeds, ambient)


def _draw_measured(ax: Axes, measured: Measured, is_own: bool) -> None:
    """A range as a pale box, a published curve dotted between its ends, the rig's own as a star."""
    speeds, friction = measured.speeds, measured.friction
    if measured.is_range:
        (width,), (height,) = np.diff(speeds), np.diff(friction)
        box = Rectangle((speeds[0], friction[0]), width, height, color=PALE_GREY, zorder=0)
        ax.add_artist(box)  # which, unlike a patch, leaves the axes' limits alone
        return
    style, size = ("*", 12.0) if is_own else ("s:", 5.0)
    label = f"measured: {measured.what}"
    ax.plot(speeds, friction, style, color=INK, ms=size, label=label, zorder=4)


def _name_range(ax: Axes, measured: Measured) -> None:
    """In the upper left corner of a box that begins within the axes, else in the lower right."""
    if not measured.is_range:
        return
    place, shift = (measured.speeds[-1], min(measured.friction)), (-3, 3)
    if measured.speeds[0] > ax.get_xlim()[0]:
        place = (measured.speeds[0], min(max(measured.friction), ax.get_ylim()[1]))
        shift = (3, -3)
    halo = [withStroke(linewidth=2.5, foreground=PALE_GREY)]
    _say(ax, measured.what, place, shift, color=INK, fontsize=8.0, path_effects=halo)


def _say(
    ax: Axes, words: str, place: tuple[float, float], shift: tuple[float, float], **style: Any
) -> None:
    """Words beside a place, shifted (points) to where they stand."""
    ax.annotate(
        words,
        place,
        xytext=shift,
        textcoords="offset points",
        ha={-1: "right", 0: "center", 1: "left"}[int(np.sign(shift[0]))],
        va="bottom" if shift[1] > 0.0 else "top",
        **style,
    )


def _local_slope(speed: np.ndarray, value: np.ndarray) -> np.ndarray:
    return np.asarray(np.gradient(np.log(value), np.log(speed)))


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
        _say(ax, name, (speed[at], law[at]), (8 * side, 8), color=INK)


def _mark_slopes(ax: Axes, speed: np.ndarray, law: np.ndarray) -> None:
    """Dashed lines of slope -1/2 and +1/2 along the lowest curve, where it falls and rises so."""
    slope = _local_slope(speed, law)
    falling = np.flatnonzero(slope <= -0.5)  # steeper first where melt begins to carry
    fall = int(falling[-1]) if falling.size else int(np.argmin(slope))
    for at, ideal in ((fall, -0.5), (int(np.argmax(slope)), 0.5)):
        if abs(slope[at]) < NAMED:
            continue
        at = min(at, int(0.85 * len(speed)))  # room for the words
        near = (speed > speed[at] / 6.0) & (speed < speed[at] * 6.0)
        line = 0.75 * law[at] * (speed[near] / speed[at]) ** ideal
        ax.plot(speed[near], line, "--", color=GREY, linewidth=0.9)
        words, side = ("slope −½", -4) if ideal < 0 else ("slope ½", 4)
        _say(ax, words, (speed[at], 0.75 * law[at]), (side, -6), color=GREY)


def headline(found: FrictionMap) -> str:
    """How friction goes with the speed, of the coldest air."""
    return " ".join(sentences(_text().headline(found)))


def tiles(found: FrictionMap) -> list[tuple[str, str]]:
    """Up to four figures, over all temperatures of the air."""
    return tiles_of(_text().tiles(found))


def printed(found: FrictionMap) -> str:
    """What the command prints."""
    return str(_text().printed(found))


def _text() -> Any:
    """The macros of `friction_map.txt.j2`, which call what this module knows."""
    return texts("friction_map.txt.j2", __package__ or "", globals())


def slope_in_words(slope: float, digits: int = 3) -> str:
    """With its sign, unless it is 0."""
    told = f"{slope:+z.{digits}f}".replace("-", "−")
    return "0" if not told.strip("+0.") else told


def write_numbers(found: FrictionMap, folder: Path) -> None:
    """The map as JSON, and its points as a table."""
    write_json(found.summary(), folder / "friction_map.json")
    write_table(pd.DataFrame(found.points), folder / "friction_map.csv", index=False)


def page(found: FrictionMap, command: str = "") -> tuple[str, list[Picture]]:
    """HTML of a map, and its figure."""
    drawn = draw_map(found)
    # the template calls what this module knows
    told = {"found": found, "drawn": drawn, "command": command}
    return render("friction_map.html.j2", __package__ or "", **globals() | told), [drawn]
