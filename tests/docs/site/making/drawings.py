"""Drawings of the rig and of the coupling, from the rig's own default numbers.

`python tests/docs/site/making/drawings.py FOLDER` draws them without the site.
"""

import sys
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyArrowPatch, FancyBboxPatch, Rectangle
from stickslip import Rig

BLUE, RED, GREEN, INK, GREY, BELT, ICE = (
    *("#0072B2", "#D55E00", "#009E73", "#222222", "#7A7A7A"),
    *("#E9E4DA", "#D3E5F0"),
)
ARROW = {"arrowstyle": "-|>", "mutation_scale": 13, "shrinkA": 0, "shrinkB": 0}
RC = {"svg.hashsalt": "stickslip", "svg.fonttype": "path", "font.family": "DejaVu Sans"}


def write(folder: Path) -> None:
    """`rig.svg` and `coupling.svg` into a folder."""
    for name, draw in {"rig": rig, "coupling": coupling}.items():
        with matplotlib.rc_context(RC):
            draw().savefig(folder / f"{name}.svg", metadata={"Date": None}, facecolor="white")


def rig() -> Figure:
    """The block from above and from the side, as a scenario without a word about it has it."""
    figure = Figure(figsize=(9.6, 2.5), layout="constrained")
    above, side = figure.subplots(1, 2, width_ratios=(1.25, 1.0))
    _from_above(above, Rig())
    _from_the_side(side, Rig())
    for axes, title in ((above, "from above"), (side, "from the side")):
        axes.set_title(title, loc="left", fontsize=10, color=GREY)
        axes.set_aspect("equal", anchor="N")  # both titles at one height
        axes.axis("off")
    return figure


def _from_above(axes, rig: Rig) -> None:
    """Springs along x between the attachments and the frame, at their installed length."""
    axes.add_patch(Rectangle((-0.33, -0.085), 0.66, 0.17, facecolor=BELT, edgecolor=GREY))
    axes.text(-0.32, -0.077, "belt (drawn wide)", color=GREY, fontsize=9)
    for frame in (-1, 1):
        middle = frame * (rig.attachment_radius * np.cos(np.radians(20)) + rig.spring_length)
        axes.plot([middle] * 2, [-0.06, 0.06], color=INK, lw=4, solid_capstyle="butt")
    for angle in np.radians(rig.attachment_angles_deg):
        x, y = rig.attachment_radius * np.array([np.cos(angle), np.sin(angle)])
        axes.plot([0, x], [0, y], color=GREY, lw=1, zorder=3)
        axes.plot(*_spring(x, x + np.sign(x) * rig.spring_length, y), color=INK, lw=1.1, zorder=4)
        axes.plot(x, y, "o", color=INK, ms=4, zorder=5)
    disc = {"facecolor": ICE, "edgecolor": BLUE, "lw": 1.5, "zorder": 2}
    axes.add_patch(Circle((0, 0), rig.contact_radius, **disc))
    _arrow(axes, (0.10, 0.0), (0.17, 0.0), BLUE, "x", (0.175, -0.004))
    _arrow(axes, (0.0, 0.055), (0.0, 0.115), GREEN, "y", (0.006, 0.108))
    turn = FancyArrowPatch(
        (0.024, -0.012),
        (0.012, 0.024),
        connectionstyle="arc3,rad=0.6",
        color=RED,
        zorder=6,
        **ARROW,
    )
    axes.add_patch(turn)
    axes.text(-0.004, -0.021, "φ", color=RED, fontsize=12, zorder=6)
    axes.text(-0.145, 0.032, "four springs", fontsize=9, ha="center")
    axes.text(0.255, 0.045, "frame", fontsize=9, color=INK)
    _arrow(axes, (0.12, -0.062), (0.27, -0.062), GREY, "speed v", (0.155, -0.058))
    axes.annotate(
        "block of ice", (-0.022, 0.033), (-0.11, 0.105), fontsize=9, color=BLUE,
        arrowprops={"arrowstyle": "-", "color": BLUE, "lw": 0.8},
    )  # fmt: skip
    axes.set(xlim=(-0.34, 0.34), ylim=(-0.13, 0.13))


def _from_the_side(axes, rig: Rig) -> None:
    """Block on the upper run of a belt around two rollers; what warms, and what cools."""
    top, roller, half = 0.0, 0.03, 0.2
    for x in (-half, half):
        axes.add_patch(Circle((x, top - roller), roller, facecolor="white", edgecolor=GREY))
    for y in (top, top - 2 * roller):
        axes.plot([-half, half], [y, y], color="#B58900", lw=3, solid_capstyle="butt")
    for x, turn in ((-half, (90, 270)), (half, (-90, 90))):
        angle = np.radians(np.linspace(*turn, 40))
        arc = x + roller * np.cos(angle), top - roller + roller * np.sin(angle)
        axes.plot(*arc, color="#B58900", lw=3, solid_capstyle="butt")
    width, height = 2 * rig.contact_radius, 0.10
    block = {"facecolor": ICE, "edgecolor": BLUE, "lw": 1.5}
    axes.add_patch(Rectangle((-width / 2, top + 0.002), width, height, **block))
    axes.text(0, 0.06, "ice", ha="center", color=BLUE)
    axes.plot([-width / 2, width / 2], [top + 0.001] * 2, color=RED, lw=4, solid_capstyle="butt")
    axes.annotate(
        "friction heat", (0.038, 0.001), (0.085, 0.045), fontsize=9, color=RED,
        arrowprops={"arrowstyle": "-", "color": RED, "lw": 0.8},
    )  # fmt: skip
    _arrow(axes, (0.0, -0.008), (0.0, -0.045), RED, "into the belt", (0.008, -0.037))
    _arrow(axes, (0.0, 0.008), (0.0, 0.045), RED, "", (0, 0))
    for x in (-0.155, -0.105):
        _arrow(axes, (x, 0.006), (x, 0.036), GREY, "", (0, 0))
    axes.text(-0.13, 0.04, "to the air", fontsize=9, ha="center", color=GREY)
    _arrow(axes, (0.09, -0.08), (-0.09, -0.08), GREY, "", (0, 0))
    axes.text(0, -0.1, "and round again: loop of length L", fontsize=9, ha="center", color=GREY)
    axes.set(xlim=(-0.25, 0.25), ylim=(-0.12, 0.14))


def _spring(begin: float, end: float, y: float) -> tuple[np.ndarray, np.ndarray]:
    """A line of windings along x."""
    along = np.linspace(begin, end, 400)
    part = (along - begin) / (end - begin)
    wound = (part > 0.12) & (part < 0.88)
    phase = 2 * np.pi * 14 * (part - 0.12) / 0.76
    return along, y + np.where(wound, 0.0065 * np.sin(phase), 0.0)


def _arrow(axes, begin, end, colour, text, place) -> None:
    axes.add_patch(FancyArrowPatch(begin, end, color=colour, zorder=6, **ARROW))
    axes.text(*place, text, color=colour, fontsize=9, zorder=6)


def coupling() -> Figure:
    """What crosses between the two participants in every macro step."""
    figure = Figure(figsize=(9.6, 3.1), layout="constrained")
    axes = figure.subplots()
    _box(axes, 0.0, "Mechanics", "StickSlip3DOF.fmu (C)\nstick and slip as exact events,\n"
         "x, y, φ on exact spring geometry", ICE, BLUE)  # fmt: skip
    _box(
        axes,
        6.6,
        "Heat",
        "belt and ice\nfinite elements, advanced by\nexact propagators",
        "#F8EAD0",
        RED,
    )
    for y, begin, end, colour, text in (
        (1.65, 3.4, 6.6, RED, "heat, in joules; travel of the belt; x"),
        (0.95, 6.6, 3.4, BLUE, "temperature of the interface; water film"),
    ):
        axes.add_patch(FancyArrowPatch((begin, y), (end, y), color=colour, lw=1.6, **ARROW))
        axes.text(5.0, y + 0.09, text, ha="center", fontsize=9, color=colour)
    axes.plot([1.7, 1.7, 8.3, 8.3], [0.45, 0.1, 0.1, 0.45], color=GREY, lw=1, ls=":")
    axes.text(
        5.0, 0.18, "master: scheme, macro steps, energy ledger, checkpoints",
        ha="center", fontsize=9, color=GREY,
    )  # fmt: skip
    axes.set(xlim=(-0.1, 10.1), ylim=(-0.05, 2.4))
    axes.axis("off")
    return figure


def _box(axes, x: float, title: str, text: str, face: str, edge: str) -> None:
    shape = {"boxstyle": "round,pad=0,rounding_size=0.12", "facecolor": face, "edgecolor": edge}
    axes.add_patch(FancyBboxPatch((x, 0.5), 3.4, 1.75, lw=1.5, **shape))
    axes.text(x + 1.7, 1.88, title, ha="center", fontsize=12, color=edge, weight="bold")
    axes.text(x + 1.7, 1.15, text, ha="center", va="center", fontsize=9, color=INK)


if __name__ == "__main__":
    write(Path(sys.argv[1]))
