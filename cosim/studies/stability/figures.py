"""The two maps as figures."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from stickslip.steady_motion.regimes import SLIDING, STICK_SLIP
from stickslip.steady_motion.starts import RAMP, REST, RIDING

from cosim.report.palette import BLUE, INK, RED, SAND, SOFT_GREY
from cosim.report.style import panels, picture
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


def _cross(ax: Axes, x: float, y: float) -> None:
    """The scenario's own place, where it is on the map."""
    (left, right), (low, high) = ax.get_xlim(), ax.get_ylim()
    if left <= x <= right and low <= y <= high:
        ax.plot(x, y, "x", color="white", ms=10.0, mew=4.5)
        ax.plot(x, y, "x", color=RED, ms=9.0, mew=2.0)
