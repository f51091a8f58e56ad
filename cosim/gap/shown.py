"""An answer in a notebook: a dataset of the runs, and the figures of the page one by one."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from cosim.gap.result import FittedModel, Gap
from cosim.gap.show.numbers import as_data
from cosim.gap.show.regime_figure import draw_regimes
from cosim.gap.show.run_figures import channels, draw_overlay, draw_residuals
from cosim.gap.show.score_figures import (
    analysis_of,
    draw_gaps,
    draw_ladder,
    draw_laws,
    draw_parameters,
    draw_ranking,
)
from cosim.names import unknown_name
from cosim.report.files import json_text, provenance
from cosim.report.style import displayed, shown

UNITS = {"x": "m", "y": "m", "phi": "rad"}
MEANING = {
    "x": "place along the surface's motion", "y": "place across it", "phi": "rotation",
}  # fmt: skip


def gap_dataset(gap: Gap) -> xr.Dataset:
    """Runs one after the other over ``sample`` (n,): measured, modelled, and what is left.

    Of each channel `x`, `x_plain`, `x_extended` (where something was added), and `x_left_plain`,
    `x_left_extended`, measured less modelled in units of the noise; ``time`` in the run, s, and
    ``run``, its number. Over ``run`` (r,): its name, whether it was held out, the gap before and
    after, speed, mass, stiffness. Attribute `gap`: what `gap.json` holds, as text.
    """
    models = {"plain": gap.plain} | ({"extended": gap.extended} if gap.extended else {})
    runs = gap.plain.runs
    variables: dict[str, Any] = {}
    for channel in (name for name in UNITS if any(name in r.track.channels for r in runs)):
        said = {"units": UNITS[channel], "long_name": MEANING[channel]}
        variables[channel] = ("sample", _measured(gap, channel), said)
        for label, model in models.items():
            variables[f"{channel}_{label}"] = (
                "sample", _modelled(model, channel, False),
                {**said, "long_name": f"{MEANING[channel]}, {label} model"},
            )  # fmt: skip
            variables[f"{channel}_left_{label}"] = (
                "sample", _modelled(model, channel, True),
                {"units": "1", "long_name": f"{channel} less the {label} model over the noise"},
            )  # fmt: skip
    number = np.concatenate([np.full(run.track.time.size, i) for i, run in enumerate(runs)])
    time = np.concatenate([run.track.time for run in runs])
    dataset = xr.Dataset(variables | _of_runs(gap, models))
    dataset = dataset.assign_coords(
        time=("sample", time, {"units": "s", "long_name": "time in the run"}),
        number=("sample", number, {"units": "1", "long_name": "number of the run"}),
        run=("run", [run.name for run in runs]),
    )
    dataset.attrs.update(
        title=gap.campaign.name, case="gap", verdict=gap.verdict, effects=list(gap.effects),
        gap=json_text(as_data(gap, "")), **provenance(),
    )  # fmt: skip
    return dataset


def _of_runs(gap: Gap, models: dict[str, FittedModel]) -> dict[str, Any]:
    measured = [run.track.run for run in gap.plain.runs]
    of_run: dict[str, Any] = {
        "surface_speed": ("run", [run.surface_speed for run in measured], {"units": "m/s"}),
        "mass": ("run", [run.mass for run in measured], {"units": "kg"}),
        "stiffness": ("run", [run.stiffness for run in measured], {"units": "N/m"}),
        "held_out": ("run", [run.hold_out for run in measured]),
    }
    for label, model in models.items():
        said = {"units": "1", "long_name": f"gap of the {label} model, noise units"}
        of_run[f"gap_{label}"] = ("run", [run.gap for run in model.runs], said)
    return of_run


def _measured(gap: Gap, channel: str) -> np.ndarray:
    """(n,) of all runs; NaN in one that has not the channel."""
    return np.concatenate(
        [
            run.track.run.motion[channel]
            if channel in run.track.run.motion.channels
            else np.full(run.track.time.size, np.nan)
            for run in gap.plain.runs
        ]
    )


def _modelled(model: FittedModel, channel: str, left: bool) -> np.ndarray:
    """(n,) of all runs, the motion or what it leaves."""
    return np.concatenate(
        [
            (run.track.residual(channel) if left else getattr(run.track, channel))
            if channel in run.track.channels
            else np.full(run.track.time.size, np.nan)
            for run in model.runs
        ]
    )


def figure_of(gap: Gap, name: str) -> Figure:
    """A figure of the page by its name; ValueError for one that this answer has not."""
    found = _drawers(gap)
    if name not in found:
        raise ValueError(unknown_name("figure of this answer", name, found))
    return found[name]()


def _drawers(gap: Gap) -> dict[str, Callable[[], Figure]]:
    """Name -> what draws it, of those that the answer has something for."""
    found: dict[str, Callable[[], Figure]] = {
        "gaps": lambda: shown(draw_gaps, gap),
        "residuals": lambda: shown(draw_residuals, gap),
        "parameters": lambda: shown(draw_parameters, gap),
        "atlas": lambda: shown(draw_regimes, analysis_of(gap)),
    }
    for channel in channels(gap):
        found[f"overlay_{channel}"] = partial(shown, draw_overlay, gap, channel)
    if gap.ranking:
        found["ranking"] = lambda: shown(draw_ranking, gap)
    if len(gap.ladder) > 1:
        found["ladder"] = lambda: shown(draw_ladder, gap)
    if gap.laws:
        found["curves"] = lambda: displayed(draw_laws(gap))
    return found
