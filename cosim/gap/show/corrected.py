"""Data freed of a measurement fault that was named: a campaign beside the report.

What can be undone is: scale, clock, turned axes and drift. With t the time written, q the place
written, b the clock's fault, a the scale's, R the turn and d the drift,

    true time  s = t / (1 + b),      true place  r = R^-1 (q - d(s)) / (1 + a)

What a filter took away, or rounding, is gone and stays in the data.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import tomli_w

from cosim.files import write_text
from cosim.gap.data import Campaign, MeasuredRun, Track
from cosim.gap.data.campaign_file import FILE_NAME
from cosim.gap.result import Gap

from .quantities import quantity
from .text import FAULT, faults_of

#: Faults that can be undone.
UNDONE = ("measurement.scale", "measurement.clock", "measurement.rotation", "measurement.drift")


def write_corrected(gap: Gap, folder: Path) -> list[Path]:
    """`corrected/campaign.toml` and the runs' files beside it; [] where nothing can be undone."""
    if not set(faults_of(gap)) & set(UNDONE):
        return []
    target = folder / "corrected"
    target.mkdir(parents=True, exist_ok=True)
    values = {run.name: run.values for run in gap.extended.runs}
    written, entries = [], []
    for number, run in enumerate(gap.campaign.runs, 1):
        entry = {
            "mass": run.mass, "stiffness": run.stiffness, "surface_speed": run.surface_speed,
            "ambient_degC": run.ambient_degC, "hold_out": run.hold_out,
        }  # fmt: skip
        if run.track is None:
            summary = {key: list(pair) for key, pair in (run.summary or {}).items()}
            entries.append({"summary": summary, **entry})
            continue
        file = target / f"run{number:02d}.csv"
        numbers = {k: v for k, v in values.get(run.name, {}).items() if k.startswith(FAULT)}
        write_text(_csv(corrected(run, numbers).motion, numbers), file)
        written.append(file)
        entries.append({"file": file.name, **entry})
    write_text(tomli_w.dumps(_tables(gap.campaign, entries)), target / FILE_NAME)
    return [target / FILE_NAME, *written]


def corrected(run: MeasuredRun, values: Mapping[str, float]) -> MeasuredRun:
    """The run as a faultless camera would have seen it. values : `measurement.*` -> value."""

    def value(name: str) -> float:
        return float(values.get(f"measurement.{name}", 0.0))

    track = run.motion
    time = track.time / (1.0 + value("clock"))
    settled = -np.expm1(-time / value("drift_time")) if value("drift_time") else np.zeros_like(time)
    x, y = (
        None if channel is None
        else channel - value(f"drift_rate_{axis}") * time - value(f"drift_{axis}") * settled
        for axis, channel in (("x", track.x), ("y", track.y))
    )  # fmt: skip
    assert x is not None
    turn, scale = value("rotation"), 1.0 + value("scale")
    if y is None:
        return replace(run, track=replace(track, time=time, x=x / scale))
    if turn:
        x, y = np.cos(turn) * x - np.sin(turn) * y, np.cos(turn) * y + np.sin(turn) * x
    return replace(run, track=replace(track, time=time, x=x / scale, y=y / scale))


def _csv(track: Track, numbers: Mapping[str, float]) -> str:
    """Rows in SI units, with a word on what was done."""
    columns = {"t": track.time + track.time_offset} | {name: track[name] for name in track.channels}
    lines = [
        f"# {quantity(key, number, None).text}: "
        f"{'undone' if key.startswith(UNDONE) else 'still in the data, as it cannot be undone'}"
        for key, number in numbers.items()
    ]
    lines.append(",".join(columns))
    for row in np.stack(list(columns.values()), axis=1):
        lines.append(",".join("" if np.isnan(number) else f"{number:.12g}" for number in row))
    return "\n".join(lines) + "\n"


def _tables(campaign: Campaign, runs: list[dict[str, Any]]) -> dict[str, Any]:
    """The campaign with its corrected files."""
    stated = {k: v for k, v in campaign.noise.items() if k not in campaign.noise_estimated}
    friction: dict[str, Any] = {key: list(pair) for key, pair in campaign.friction.items()}
    if campaign.friction_table is not None:
        friction["table"] = str(campaign.friction_table.file.resolve())
    return {
        "name": f"{campaign.name}, corrected"[:200],
        "rig": campaign.rig.model_dump(exclude_unset=True),
        "model": {"scheme": campaign.scheme},
        "noise": stated,
        "errors": campaign.errors.model_dump(exclude_unset=True),
        "friction": friction,
        "run": runs,
    }
