"""The two maps, and the range in which the block sticks and slips, as figures."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from stickslip.steady_motion.regimes import SLIDING, STICK_SLIP
from stickslip.steady_motion.starts import RAMP, REST, RIDING

from cosim.report.page import unit_text
from cosim.report.palette import BLUE, INK, RED, SAND, SOFT_GREY
from cosim.report.style import logarithmic_x, panels, picture
from cosim.studies import FIGURES

from .maps import Case, PretensionMap, RegimeMap

TITLES = {REST: "from rest", RIDING: "riding", RAMP: "from a speed ramp"}
KINDS = {STICK_SLIP: BLUE, SLIDING: SAND}
OTHER = SOFT_GREY
#: Growth of a cycle at which the colours of the map end.
LOW, HIGH = 0.5, 2.0


@picture("pretension_map", **FIGURES["pretension_map"])
def draw_pretension_map(found: PretensionMap, case: Case) -> Figure:
    """Growth as colour, its border as a line."""
    figure, axes = panels(1, 1, height=4.2, width=7.2)
    ax = axes[0, 0]
    ax.set_facecolor(OTHER)
    ax.grid(False)
    speeds, stretched = found.speeds, 1e3 * found.pretensions
    shown = np.log2(np.clip(found.growth, LOW, HIGH))
    ends = {"vmin": np.log2(LOW), "vmax": np.log2(HIGH)}
    mesh = ax.pcolormesh(speeds, stretched, shown, cmap="RdBu_r", shading="nearest", **ends)
    if np.nanmin(found.growth) < 1.0 < np.nanmax(found.growth):
        ax.contour(speeds, stretched, found.growth, levels=[1.0], colors=INK, linewidths=1.4)
    sliding = np.argwhere(found.sticks == 0.0)
    # seen on dark and on pale colours
    places = speeds[sliding[:, 1]], stretched[sliding[:, 0]]
    ax.plot(*places, "o", color="white", ms=3.2, mec=INK, mew=0.6)
    rig = case.parameters.rig
    own = 1e3 * (rig.spring_length - rig.spring_natural_length)
    _cross(ax, abs(case.parameters.surface.speed), own)
    ax.set(
        xlabel="speed of the surface [m/s]",
        ylabel="pretension [mm]",
        title=f"Growth of small disturbances: {case.name}",
    )
    bar = figure.colorbar(mesh, ax=ax, label="multiplier of a cycle [1]")
    ticks = {"≤ 0.5": 0.5, "0.7": 0.7, "1": 1.0, "1.4": 1.4, "≥ 2": 2.0}
    bar.set_ticks(np.log2([*ticks.values()]).tolist(), labels=[*ticks])
    return figure


@picture("regime_map", **FIGURES["regime_map"])
def draw_regime_map(found: RegimeMap, case: Case) -> Figure:
    """A panel for each start."""
    figure, axes = panels(1, len(found.simulated), height=3.6, width=11.0, sharey=True)
    kinds = list(KINDS)
    colours = ListedColormap([*KINDS.values(), OTHER])
    norm = BoundaryNorm(np.arange(len(kinds) + 2) - 0.5, len(kinds) + 1)
    for ax, (start, names) in zip(axes[0], found.simulated.items(), strict=True):
        is_kind = [names == kind for kind in kinds]
        numbers = np.select(is_kind, range(len(kinds)), default=len(kinds))
        ax.grid(False)
        ax.pcolormesh(
            found.speeds, found.ratios, numbers, cmap=colours, norm=norm, shading="nearest"
        )
        if start in found.closed_form_borders:
            border = found.closed_form_borders[start].T
            ax.plot(*border, "o", color=INK, ms=3.2, mec="white", mew=0.5)
        friction = case.parameters.friction
        _cross(ax, abs(case.parameters.surface.speed), friction.mu_s / friction.mu_k)
        ax.set(xlabel="speed of the surface [m/s]", title=TITLES[start])
    axes[0, 0].set_ylabel("µ_s / µ_k [1]")
    handles = [Patch(facecolor=colour, label=name) for name, colour in KINDS.items()]
    if not np.isin(list(found.simulated.values()), kinds).all():
        handles.append(Patch(facecolor=OTHER, label="other, or not followed"))
    figure.legend(handles=handles, loc="outside lower right", ncols=len(handles))
    figure.suptitle(f"Regimes: {case.name}", x=0.008, ha="left")
    return figure


@picture("stick_slip_range", **FIGURES["stick_slip_range"])
def draw_range(found: dict[str, Any], case: Case) -> Figure:
    """A bar for each start: what `stick_slip_range` says."""
    low, high = found["searched"]
    figure, axes = panels(1, 1, height=0.5 * len(found["stick_slip"]) + 1.5, width=5.6)
    ax = axes[0, 0]
    for row, windows in enumerate(found["stick_slip"].values()):
        for (begin, end), colour in [((low, high), SAND), *((each, BLUE) for each in windows)]:
            begin, end = low if begin is None else begin, high if end is None else end
            ax.barh(row, end - begin, left=begin, height=0.6, color=colour)
    ax.axvline(found["value"], color=RED, lw=2.0)
    ax.set_xlim(low, high)
    logarithmic_x(ax)
    unit = unit_text(found["unit"])
    ax.set(xlabel=f"{found['key']} [{unit}]", title=f"Stick-slip: {case.name}")
    ax.set_yticks(range(len(found["stick_slip"])), [TITLES[start] for start in found["stick_slip"]])
    ax.invert_yaxis()
    ax.grid(False)
    handles = [
        Patch(facecolor=BLUE, label="stick-slip"),
        Patch(facecolor=SAND, label="none"),
        Line2D([], [], color=RED, lw=2.0, label="the scenario"),
    ]
    figure.legend(handles=handles, loc="outside lower right", ncols=len(handles))
    return figure


def _cross(ax: Axes, x: float, y: float) -> None:
    """The scenario's own place, where it is on the map."""
    (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()
    if left <= x <= right and low <= y <= high:
        ax.plot(x, y, "x", color="white", ms=10.0, mew=4.5)
        ax.plot(x, y, "x", color=RED, ms=9.0, mew=2.0)
