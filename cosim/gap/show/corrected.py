"""Data freed of a measurement fault that was named: a campaign beside the report.

What a filter took away, or rounding, is gone and stays in the data.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pandas as pd
import tomli_w

from cosim.files import write_text
from cosim.gap.data import Track
from cosim.gap.data.campaign_file import FILE_NAME
from cosim.gap.quantities import BESIDE_THE_MODEL, quantity
from cosim.gap.result import Gap
from cosim.gap.windows import camera

from .text import FAULT, faults_of

UNDONE = tuple(f"{FAULT}{name}" for name in camera.UNDONE)
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
            write_text(_csv(camera.undone(run.motion, numbers), numbers), files[-1])
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


def _csv(track: Track, numbers: Mapping[str, float]) -> str:
    """Rows in SI units, with a word on what was done."""
    columns = {"t": track.time + track.time_offset} | {name: track[name] for name in track.channels}
    said = [
        f"# {quantity(key, number, None).text}: "
        f"{'undone' if key.startswith(UNDONE) else 'still in the data, as it cannot be undone'}\n"
        for key, number in numbers.items()
        if key in BESIDE_THE_MODEL and numbers.get(f"{key}_in", 1.0)
    ]  # fmt: skip
    table = pd.DataFrame(columns)
    return "".join(said) + table.to_csv(index=False, float_format="%.12g", lineterminator="\n")
