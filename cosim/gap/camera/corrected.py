"""Data freed from a fault of the camera that was named: a campaign beside the report.

Only what can be undone is: scale, clock, turned axes, drift, and a rolling shutter's delay. What a
filter has taken away is gone, and what was rounded away as well: these stay in the data, as the
files say, and belong into the model of whoever goes on with them.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import tomli_w

from cosim.files import write_text
from cosim.gap.camera.camera import Camera
from cosim.gap.camera.faults import QUANTITIES, fault_of
from cosim.gap.data import Campaign, MeasuredRun
from cosim.gap.data.campaign_file import FILE_NAME
from cosim.gap.data.reading.csv_file import read_columns
from cosim.gap.data.reading.unit_names import SI

#: Faults that cannot be undone.
LASTING = ("measurement.smoothing", "measurement.quantisation")
#: Digits of a corrected number: far below any noise.
_DIGITS = 12


def write_corrected(
    campaign: Campaign,
    values: Mapping[str, float],
    own_values_by_run: Mapping[str, Mapping[str, float]],
    folder: Path,
) -> list[Path]:
    """`corrected/campaign.toml` and the runs' files beside it; [] where nothing can be undone.

    values : fitted and set, of the campaign; own_values_by_run : name of a run -> those of its own
    """
    cameras = {
        run.name: Camera.split({**values, **own_values_by_run.get(run.name, {})})[1]
        for run in campaign.runs
        if run.file is not None
    }
    if all(_undone(camera).is_perfect for camera in cameras.values()):
        return []
    target = folder / "corrected"
    target.mkdir(parents=True, exist_ok=True)
    written: list[Path] = []
    names: dict[Path, str] = {}
    for number, run in enumerate(campaign.runs, 1):
        if run.file is None:
            continue
        name = names[run.file.resolve()] = _free_name(run.file.name, number, names.values())
        written.append(target / name)
        write_text(_csv(run, cameras[run.name]), target / name)
    tables = _tables(campaign, names, _undone(Camera.split(values)[1]))
    said = "\n".join(f"# {line}" for line in _said(Camera.split(values)[1]))
    write_text(f"{said}\n{tomli_w.dumps(tables)}", target / FILE_NAME)
    return [target / FILE_NAME, *written]


def _undone(camera: Camera) -> Camera:
    """With the faults alone that can be undone."""
    return Camera({k: v for k, v in camera.numbers.items() if fault_of(k) not in LASTING})


def undone(
    camera: Camera, columns: Mapping[str, np.ndarray], time: str = "t"
) -> dict[str, np.ndarray]:
    """Columns t (n,), x [, y] ... as a faultless camera would have written them.

    Rows in the order of their true times; x and y are lost together where the axes were turned.
    """
    camera, result = _undone(camera), {name: a.copy() for name, a in columns.items()}
    first, x = columns[time][0], columns["x"]
    since = (columns[time] - first) / camera.clock
    if camera.per_metre:
        seen = np.isfinite(x)
        place = np.interp(since, since[seen], x[seen])
        since = since + camera.per_metre * (place - place[0])
    y = columns.get("y", np.zeros_like(x))
    places = camera.turned_back(np.stack([x, y], axis=1) - camera.drift(since))
    result["x"] = places[:, 0]
    if "y" in columns:
        result["y"] = places[:, 1]
    result[time] = first / camera.clock + since
    order = np.unique(result[time], return_index=True)[1]
    return {name: values[order] for name, values in result.items()}


def _csv(run: MeasuredRun, camera: Camera) -> str:
    """The rows of a run's file in SI units, corrected, with a word on what was done."""
    assert run.file is not None
    read = read_columns(run.file, run.reading).values
    columns = undone(camera, {name: read[name] for name in SI if name in read})
    rows = np.stack(list(columns.values()), axis=1)
    lines = [f"# {line}" for line in _said(camera)] + [",".join(columns)]
    for row in rows:
        lines.append(",".join("" if np.isnan(v) else f"{v:.{_DIGITS}g}" for v in row))
    return "\n".join(lines) + "\n"


def _said(camera: Camera) -> list[str]:
    """What was taken out of the data, and what is still in them."""
    lines = []
    for key, value in camera.numbers.items():
        unit, meaning = QUANTITIES[key]
        what = "still in the data, as it cannot be undone" if fault_of(key) in LASTING else "undone"
        lines.append(f"{key} = {value:.6g}{f' {unit}' if unit else ''} ({meaning}): {what}")
    return lines


def _free_name(name: str, number: int, taken) -> str:
    """Files of several folders come together in one."""
    return f"run{number:02d}-{name}" if name in taken or name == FILE_NAME else name


def _tables(campaign: Campaign, names: Mapping[Path, str], camera: Camera) -> dict[str, Any]:
    """The campaign with its corrected files, and with noise in the corrected scale."""
    noise = {
        channel: float(value / (1.0 + camera["scale"] if channel in ("x", "y") else 1.0))
        for channel, value in campaign.noise.items()
        if channel not in campaign.noise_estimated
    }
    return {
        "name": f"{campaign.name}, corrected"[:200],
        "rig": campaign.rig.model_dump(exclude_unset=True),
        "model": {"scheme": campaign.scheme},
        "noise": noise,
        "errors": campaign.errors.model_dump(exclude_unset=True),
        "friction": _friction(campaign),
        "run": [_run_table(run, names) for run in campaign.runs],
    }


def _friction(campaign: Campaign) -> dict[str, Any]:
    """What is known of friction; a table stays where it is."""
    known: dict[str, Any] = {key: list(pair) for key, pair in campaign.friction.items()}
    if campaign.friction_table is not None:
        known["table"] = str(campaign.friction_table.file.resolve())
    return known


def _run_table(run: MeasuredRun, names: Mapping[Path, str]) -> dict[str, Any]:
    keys = ("mass", "stiffness", "surface_speed", "ambient_degC", "hold_out")
    table = {key: getattr(run, key) for key in keys}
    if run.file is not None:
        return {"file": names[run.file.resolve()], **table}
    return table | {"summary": {key: list(pair) for key, pair in (run.summary or {}).items()}}
