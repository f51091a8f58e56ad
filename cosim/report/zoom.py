"""Which part of a long run is shown enlarged."""

from __future__ import annotations

import xarray as xr

from .phases import break_aways

MOST_CYCLES = 4
# of the run: a longer part shows little that the whole run does not
LARGEST_PART = 0.3
# of a cycle, so that the first break-away does not stand on the frame
MARGIN = 0.15


def last_cycles(dataset: xr.Dataset) -> tuple[float, float] | None:
    """Begin and end (s) of the last stick-slip cycles; None where a zoom is of no use.

    As many cycles, up to `MOST_CYCLES`, as fit into `LARGEST_PART` of the run.
    """
    starts = break_aways(dataset)
    if starts.size < MOST_CYCLES + 1:
        return None
    begin, end = float(dataset["time"][0]), float(dataset["time"][-1])
    for cycles in range(MOST_CYCLES, 0, -1):
        first = starts[-cycles - 1]
        first -= MARGIN * (starts[-1] - first) / cycles
        if end - first <= LARGEST_PART * (end - begin):
            return max(float(first), begin), end
    return None
