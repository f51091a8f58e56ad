"""The block's motion: position and rotation over time, friction."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from stickslip.kernel.layout import P_MU_K, P_MU_S, P_NORMAL_FORCE

from cosim.report.columns import Data
from cosim.report.contents import mechanics_of
from cosim.report.live import Curve, Panel, TimeFigure
from cosim.report.palette import BLUE, GREEN, RED, Scaled, readable

Array = NDArray[np.float64]
#: Name, rows, colour and width of a part of a run.
Part = tuple[str, NDArray[np.int64], str, float]

# what a camera over the rig would just see; smaller motions are not blown up to fill the axis
SMALLEST_LENGTH = 1e-4
SMALLEST_ANGLE_DEG = 0.1
# of these: a channel that moves less is told in words instead of drawn as a flat line
FLAT = 0.05


def motion(dataset: Data) -> TimeFigure:
    """x, y and phi over time; where the block keeps to its line or does not turn, words say so."""
    x, y = (readable(dataset[name].values, "m", floor=1e-3) for name in ("x", "y"))
    shown = [
        ("x", BLUE, x, SMALLEST_LENGTH),
        ("y", GREEN, y, SMALLEST_LENGTH),
        ("phi", RED, DEGREES, np.radians(SMALLEST_ANGLE_DEG)),
    ]
    panels, said = [], []
    for name, colour, scaled, smallest in shown:
        symbol = {"phi": "φ"}.get(name, name)
        values = scaled(dataset[name].values)
        known = values[np.isfinite(values)]
        if name != "x" and (known.size == 0 or np.ptp(known) < FLAT * scaled.factor * smallest):
            said.append(_flat(symbol, known, scaled, FLAT * smallest))
            continue
        panels.append(
            Panel(
                f"{symbol} [{scaled.unit}]",
                [Curve(symbol, values, colour)],
                span=scaled.factor * smallest,
            )
        )
    note = f"Not drawn, as flat: {'; '.join(said)}." if said else ""
    return TimeFigure(
        dataset["time"].values, panels, title="Motion of the block", note=note, height=2.0
    )


def _flat(symbol: str, values: Array, scaled: Scaled, least: float) -> str:
    """What a channel that does not move is."""
    level = float(values.mean()) if values.size else 0.0
    if abs(level) < scaled.factor * least:
        return f"{symbol} is 0 throughout"
    return f"{symbol} is {level:.3g} {scaled.unit} throughout".replace("-", "−")


DEGREES = Scaled(180.0 / np.pi, "°")


COMPONENTS = (
    ("friction_force_x", "N", "friction along x", BLUE),
    ("friction_force_y", "N", "friction along y", GREEN),
    ("friction_moment", "N.m", "friction moment", RED),
)
# of the limit of static friction: a component below it is left out
SMALLEST_SHARE = 1e-6


def friction_force(dataset: Data) -> TimeFigure:
    """Friction along x with the limits of stick and slip; the other components where they act."""
    p = mechanics_of(dataset).pack()
    limits = {"μₛ m g": P_MU_S, "μₖ m g": P_MU_K}
    sizes = {text: p[place] * p[P_NORMAL_FORCE] for text, place in limits.items()}
    panels, left_out = [], []
    for name, unit, label, colour in COMPONENTS:
        values = dataset[name].values
        acts = np.nanmax(np.abs(values), initial=0.0) > SMALLEST_SHARE * max(sizes.values())
        if name != "friction_force_x" and not acts:
            left_out.append(label)
            continue
        scaled = readable(values, unit)
        levels = _levels(scaled(values), scaled, sizes) if name == "friction_force_x" else ()
        panels.append(
            Panel(
                f"{label} [{scaled.unit}]",
                [Curve(label, scaled(values), colour)],
                levels=levels,
                span=1e-6,
            )
        )
    note = f"Not drawn, as 0 throughout: {', '.join(left_out)}." if left_out else ""
    height = 2.6 if len(panels) == 1 else 2.0
    return TimeFigure(
        dataset["time"].values, panels, title="Friction on the block", note=note, height=height
    )


def _levels(values: Array, scaled: Scaled, sizes: dict[str, float]) -> list[tuple[float, str]]:
    """The limits that the curve comes near to, of either sign."""
    known = values[np.isfinite(values)]
    low, high = (float(known.min()), float(known.max())) if known.size else (0.0, 0.0)
    return [
        (sign * scaled.factor * size, mark + text)
        for text, size in sizes.items()
        for sign, mark in ((1.0, ""), (-1.0, "−"))
        if size != 0.0
        and min(low, 0.0) * 1.1 <= sign * scaled.factor * size <= max(high, 0.0) * 1.1
    ]
