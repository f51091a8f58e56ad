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
from cosim.gap.data import MeasuredRun, Track
from cosim.gap.data.campaign_file import FILE_NAME
from cosim.gap.result import Gap

from .quantities import quantity
from .text import FAULT, faults_of

#: Faults that can be undone.
UNDONE = ("measurement.scale", "measurement.clock", "measurement.rotation", "measurement.drift")
OF_A_RUN = ("mass", "stiffness", "surface_speed", "ambient_degC", "hold_out")


def write_corrected(gap: Gap, folder: Path) -> list[Path]:
    """`corrected/campaign.toml` and the runs' files beside it; [] where nothing can be undone."""
    if not set(faults_of(gap)) & set(UNDONE):
        return []
    campaign, target = gap.campaign, folder / "corrected"
    target.mkdir(parents=True, exist_ok=True)
    values = {run.name: run.values for run in gap.extended.runs}
    files, entries = [], []
    for number, run in enumerate(campaign.runs, 1):
        if run.track is not None:
            files.append(target / f"run{number:02d}.csv")
            numbers = {k: v for k, v in values[run.name].items() if k.startswith(FAULT)}
            write_text(_csv(corrected(run, numbers).motion, numbers), files[-1])
            entries.append({"file": files[-1].name} | {key: getattr(run, key) for key in OF_A_RUN})
    noise = {k: v for k, v in campaign.noise.items() if k not in campaign.noise_estimated}
    friction: dict[str, Any] = {key: list(pair) for key, pair in campaign.friction.items()}
    if campaign.friction_table is not None:
        friction["table"] = str(campaign.friction_table.file.resolve())
    rig, errors = (part.model_dump(exclude_unset=True) for part in (campaign.rig, campaign.errors))
    known = {"rig": rig, "noise": noise, "errors": errors, "friction": friction, "run": entries}
    table = {"name": f"{campaign.name}, corrected"[:200], **known}
    write_text(tomli_w.dumps(table), target / FILE_NAME)
    return [target / FILE_NAME, *files]


def corrected(run: MeasuredRun, values: Mapping[str, float]) -> MeasuredRun:
    """The run as a faultless camera would have seen it. values : `measurement.*` -> value."""

    def value(name: str) -> float:
        return float(values.get(f"measurement.{name}", 0.0))

    track, turn = run.motion, value("rotation")
    time = track.time / (1.0 + value("clock"))
    settled = -np.expm1(-time / value("drift_time")) if value("drift_time") else 0.0 * time
    drift = [value(f"drift_rate_{a}") * time + value(f"drift_{a}") * settled for a in "xy"]
    places = np.stack([track.x, 0.0 * time if track.y is None else track.y]) - drift
    if turn:  # a missing y would take x with it
        places = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]]) @ places
    x, y = places / (1.0 + value("scale"))
    return replace(run, track=replace(track, time=time, x=x, y=None if track.y is None else y))


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
