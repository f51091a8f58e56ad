"""Figures over the time of a run, slip shaded, a part of it enlarged: motion and friction."""

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from stickslip.kernel.layout import P_MU_K, P_MU_S, P_NORMAL_FORCE

from cosim.report.columns import Array, Data
from cosim.report.contents import break_aways, mechanics_of, ramp_end, slip_intervals
from cosim.report.live import Curve, Panel, TimeFigure
from cosim.report.palette import BLUE, GREEN, RED, Scaled, readable

from .events import through_events

MOST_CYCLES = 4
# of the run: a longer part shows little that the whole run does not
LARGEST_PART = 0.3
# of a cycle, so that the first break-away does not stand on the frame
MARGIN = 0.15
# cycles shown behind the last break-away, where the run goes on without any
AFTERWARDS = 2.0


#: What a run's figure shows of its rows.
Describe = Callable[[Data], TimeFigure]


def time_figure(describe: Describe, dataset: Data) -> TimeFigure:
    """A run's figure with its events, slip, speed ramp and last cycles."""
    rows, events = through_events(dataset)
    described = describe(rows)
    ramp, time = ramp_end(dataset), dataset["time"].values
    return replace(
        described,
        keep=events,
        phases=slip_intervals(dataset),
        phase="slip",
        marks=[(ramp, "speed ramp ends")] if time[0] < ramp < time[-1] else (),
        part=zoom_of(dataset),
        title=titled(described.title, dataset),
    )


class Zoom(NamedTuple):
    """A part of the run, s, and what it is."""

    begin: float
    end: float
    title: str


def zoom_of(dataset: Data) -> Zoom | None:
    """The last stick-slip cycles, else the last vibrations; None where a zoom is of no use."""
    return _last_cycles(dataset) or _last_vibrations(dataset)


def _last_cycles(dataset: Data) -> Zoom | None:
    """As many cycles, up to `MOST_CYCLES`, as fit into `LARGEST_PART` of the run."""
    starts = break_aways(dataset)
    if starts.size < MOST_CYCLES + 1:
        return None
    time = dataset["time"].values
    for cycles in range(MOST_CYCLES, 0, -1):
        period = (starts[-1] - starts[-cycles - 1]) / cycles
        begin = max(starts[-cycles - 1] - MARGIN * period, time[0])
        end = min(starts[-1] + AFTERWARDS * period, time[-1])
        if 0.0 < end - begin <= LARGEST_PART * (time[-1] - time[0]):
            return Zoom(float(begin), float(end), "the last stick-slip cycles")
    return None


def _last_vibrations(dataset: Data) -> Zoom | None:
    """Some periods of the free vibration at the end, in a run too long to show single ones."""
    time = dataset["time"].values
    frequency = mechanics_of(dataset).natural_frequency
    if time.size == 0 or frequency == 0.0:
        return None
    length = 2.0 * MOST_CYCLES / frequency
    if length > 0.5 * LARGEST_PART * (time[-1] - time[0]) or np.sum(time > time[-1] - length) < 3:
        return None
    return Zoom(float(time[-1] - length), float(time[-1]), "the end of the run")


def titled(text: str, dataset: Data) -> str:
    """With the case's name, and how a run ended that is not complete."""
    status = dataset.attrs["status"]
    ending = "" if status == "complete" else f"  ({status})"
    return f"{text}: {dataset.attrs['title']}{ending}"


# what a camera over the rig would just see; smaller motions are not blown up to fill the axis
SMALLEST_LENGTH = 1e-4
SMALLEST_ANGLE_DEG = 0.1
# of these: a channel that moves less is told in words instead of drawn as a flat line
FLAT = 0.05
DEGREES = Scaled(180.0 / np.pi, "°")
CHANNELS = (
    ("x", BLUE, SMALLEST_LENGTH),
    ("y", GREEN, SMALLEST_LENGTH),
    ("phi", RED, np.radians(SMALLEST_ANGLE_DEG)),
)


def motion(dataset: Data) -> TimeFigure:
    """x, y and phi over time; where the block keeps to its line or does not turn, words say so."""
    panels, said = [], []
    for name, colour, smallest in CHANNELS:
        symbol, values = {"phi": "φ"}.get(name, name), dataset[name].values
        scaled = DEGREES if name == "phi" else readable(values, "m", floor=1e-3)
        span, known = scaled.factor * smallest, scaled(values[np.isfinite(values)])
        if name != "x" and (known.size == 0 or np.ptp(known) < FLAT * span):
            said.append(_flat(symbol, known, scaled, FLAT * span))
        else:
            curve = Curve(symbol, scaled(values), colour)
            panels.append(Panel(f"{symbol} [{scaled.unit}]", [curve], span=span))
    note = f"Not drawn, as flat: {'; '.join(said)}." if said else ""
    time, title = dataset["time"].values, "Motion of the block"
    return TimeFigure(time, panels, title=title, note=note, height=2.0)


def _flat(symbol: str, values: Array, scaled: Scaled, least: float) -> str:
    """What a channel that does not move is."""
    level = float(values.mean()) if values.size else 0.0
    if abs(level) < least:
        return f"{symbol} is 0 throughout"
    return f"{symbol} is {level:.3g} {scaled.unit} throughout".replace("-", "−")


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
        is_first = name == "friction_force_x"
        acts = np.nanmax(np.abs(values), initial=0.0) > SMALLEST_SHARE * max(sizes.values())
        if not is_first and not acts:
            left_out.append(label)
            continue
        scaled = readable(values, unit)
        curve = Curve(label, scaled(values), colour)
        levels = _levels(curve.values, scaled, sizes) if is_first else ()
        panels.append(Panel(f"{label} [{scaled.unit}]", [curve], levels=levels, span=1e-6))
    note = f"Not drawn, as 0 throughout: {', '.join(left_out)}." if left_out else ""
    height, title = 2.6 if len(panels) == 1 else 2.0, "Friction on the block"
    return TimeFigure(dataset["time"].values, panels, title=title, note=note, height=height)


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
