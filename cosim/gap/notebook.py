"""An answer in a notebook: a dataset of the runs, and the figures of the page one by one."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from cosim.gap.result import Gap
from cosim.gap.show.figures import figures_of
from cosim.gap.show.numbers import as_data
from cosim.gap.show.tracks import channels, modelled, residuals, shown_runs
from cosim.names import unknown_name
from cosim.report.files import json_text, provenance
from cosim.report.style import shown

CHANNELS = {
    "x": ("m", "place along the surface's motion"), "y": ("m", "place across it"),
    "phi": ("rad", "rotation"),
}  # fmt: skip
OF_A_RUN = {"surface_speed": "m/s", "mass": "kg", "stiffness": "N/m", "hold_out": "1"}


def gap_dataset(gap: Gap) -> xr.Dataset:
    """Runs one after the other over ``sample`` (n,): measured, modelled, and what is left.

    Of each channel `x`, `x_plain`, `x_extended`, and `x_left_plain`, `x_left_extended`, modelled
    less measured in units of the noise; ``time`` in the run, s, and ``number`` of the run. Over
    ``run`` (r,): its name, whether it was held out, the gap before and after, speed, mass,
    stiffness. Attribute `gap`: what `gap.json` holds, as text.
    """
    runs = shown_runs(gap)
    found: dict[str, Any] = {
        name: ("run", [getattr(run, name) for run in runs], {"units": unit})
        for name, unit in OF_A_RUN.items()
    }

    def add(name: str, parts: list[np.ndarray], unit: str, meaning: str) -> None:
        found[name] = ("sample", np.concatenate(parts), {"units": unit, "long_name": meaning})

    for channel in channels(gap):
        unit, meaning = CHANNELS[channel]
        none = [np.full(run.motion.time.size, np.nan) for run in runs]
        seen = [getattr(run.motion, channel) for run in runs]
        seen = [n if s is None else s for s, n in zip(seen, none, strict=True)]
        add(channel, seen, unit, meaning)
        for label, model in (("plain", gap.plain), ("extended", gap.extended)):
            pairs = [(run, model.run(run.name)) for run in runs]
            moved = [modelled(*pair, channel) for pair in pairs]
            add(f"{channel}_{label}", moved, unit, f"{meaning}, {label} model")
            left = [residuals(*pair, channel) for pair in pairs]
            add(f"{channel}_left_{label}", left, "1", f"{label} model less {channel}, noise units")
            found[f"gap_{label}"] = ("run", [one.gap for _, one in pairs], {"units": "1"})
    add("time", [run.motion.time for run in runs], "s", "time in the run")
    number = [np.full(run.motion.time.size, place) for place, run in enumerate(runs)]
    add("number", number, "1", "number of the run")
    dataset = xr.Dataset(found).assign_coords(run=("run", [run.name for run in runs]))
    attributes = {"title": gap.campaign.name, "case": "gap", "verdict": gap.verdict}
    dataset.attrs |= attributes | {"effects": list(gap.effects), **provenance()}
    dataset.attrs["gap"] = json_text(as_data(gap, ""))
    return dataset.set_coords(["time", "number"])


def figure_of(gap: Gap, name: str) -> Figure:
    """A figure of the page by its name; ValueError for one that this answer has not."""
    found = figures_of(gap)
    if name not in found:
        raise ValueError(unknown_name("figure of this answer", name, found))
    return shown(found[name].func, *found[name].args)
