"""An answer in a notebook: a dataset of the runs, and the figures of the page one by one."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from cosim.gap.result import Gap
from cosim.names import unknown_name
from cosim.report.files import json_text, provenance
from cosim.report.style import shown

from .answer_figures import draw_ladder, draw_laws, draw_run
from .numbers import as_data
from .run_figures import draw_overlay, draw_residuals
from .tracks import UNITS, channels, measured_run, modelled, residuals, run_names

MEANING = {
    "x": "place along the surface's motion", "y": "place across it", "phi": "rotation",
}  # fmt: skip


def gap_dataset(gap: Gap) -> xr.Dataset:
    """Runs one after the other over ``sample`` (n,): measured, modelled, and what is left.

    Of each channel `x`, `x_plain`, `x_extended`, and `x_left_plain`, `x_left_extended`, modelled
    less measured in units of the noise; ``time`` in the run, s, and ``number`` of the run. Over
    ``run`` (r,): its name, whether it was held out, the gap before and after, speed, mass,
    stiffness. Attribute `gap`: what `gap.json` holds, as text.
    """
    runs = [measured_run(gap, name) for name in run_names(gap)]
    models = {"plain": gap.plain, "extended": gap.extended}
    variables: dict[str, Any] = {}
    for channel in channels(gap):
        said = {"units": UNITS[channel], "long_name": MEANING[channel]}
        missing = [np.full(run.motion.time.size, np.nan) for run in runs]
        measured = [
            run.motion[channel] if channel in run.motion.channels else none
            for run, none in zip(runs, missing, strict=True)
        ]
        variables[channel] = ("sample", np.concatenate(measured), said)
        for label, model in models.items():
            tracks = [modelled(run, model.run(run.name), channel) for run in runs]
            left = [
                residuals(run, model.run(run.name)).get(channel, none)
                for run, none in zip(runs, missing, strict=True)
            ]
            said = {"units": UNITS[channel], "long_name": f"{MEANING[channel]}, {label} model"}
            variables[f"{channel}_{label}"] = ("sample", np.concatenate(tracks), said)
            said = {"units": "1", "long_name": f"{label} model less {channel} over the noise"}
            variables[f"{channel}_left_{label}"] = ("sample", np.concatenate(left), said)
    for label, model in models.items():
        said = {"units": "1", "long_name": f"gap of the {label} model, noise units"}
        variables[f"gap_{label}"] = ("run", [model.run(run.name).gap for run in runs], said)
    for name, unit in (("surface_speed", "m/s"), ("mass", "kg"), ("stiffness", "N/m")):
        variables[name] = ("run", [getattr(run, name) for run in runs], {"units": unit})
    variables["held_out"] = ("run", [run.hold_out for run in runs])
    sizes = [run.motion.time.size for run in runs]
    time = np.concatenate([run.motion.time for run in runs])
    dataset = xr.Dataset(variables).assign_coords(
        time=("sample", time, {"units": "s", "long_name": "time in the run"}),
        number=("sample", np.repeat(np.arange(len(runs)), sizes), {"units": "1"}),
        run=("run", [run.name for run in runs]),
    )
    dataset.attrs.update(
        title=gap.campaign.name, case="gap", verdict=gap.verdict, effects=list(gap.effects),
        gap=json_text(as_data(gap, "")), **provenance(),
    )  # fmt: skip
    return dataset


def figure_of(gap: Gap, name: str) -> Figure:
    """A figure of the page by its name; ValueError for one that this answer has not."""
    found = {"ladder": draw_ladder, "run": draw_run, "residuals": draw_residuals}
    if gap.laws:
        found["curve"] = draw_laws
    draws = {key: partial(shown, draw, gap) for key, draw in found.items()}
    for channel in channels(gap):
        draws[f"overlay_{channel}"] = partial(shown, draw_overlay, gap, channel)
    if name not in draws:
        raise ValueError(unknown_name("figure of this answer", name, draws))
    return draws[name]()
