"""Figures over the time of a run: slip shaded, a part of a long run enlarged."""

from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from cosim.report.columns import Data
from cosim.report.contents import break_aways, mechanics_of, ramp_end, slip_intervals
from cosim.report.live import TimeFigure

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
