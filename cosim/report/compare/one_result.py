"""One result as a folder of `run`, `simulate` or `couple` holds it."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import xarray as xr

from cosim.manifest import COMPLETE, MANIFEST

DATA, NUMBERS = "result.nc", "summary.json"


class NotAResult(ValueError):
    """A folder without what is to be compared; one line: folder, what is missing or wrong."""


@dataclass(frozen=True)
class OneResult:
    """A run that is there to be compared.

    Attributes
    ----------
    label : what it is called beside the other
    place : folder or scenario that it is from
    dataset : time series over ``time``
    numbers : as in `summary.json`
    scenario : TOML, "" where there was none (any system of units)
    remarks : what is to be said of it, such as that it is not complete
    """

    label: str
    place: str
    dataset: xr.Dataset = field(repr=False)
    numbers: Mapping[str, Any] = field(repr=False)
    scenario: str = field(default="", repr=False)
    remarks: tuple[str, ...] = ()

    @property
    def tables(self) -> dict[str, Any]:
        """Every key of the scenario -> value, `table.key`; none without a scenario."""
        found: dict[str, Any] = {}
        for name, entries in tomllib.loads(self.scenario).items():
            if isinstance(entries, dict):
                found |= {f"{name}.{key}": value for key, value in entries.items()}
            else:
                found[name] = entries
        return found


def read_result(folder: Path) -> OneResult:
    """The result in a folder; NotAResult, in one line, where there is none that can be read."""
    for name in (DATA, NUMBERS):
        if not (folder / name).is_file():
            raise NotAResult(
                f"{folder}: holds no {name}, allowed is a folder of results of stickslip run,"
                " simulate or couple, or a scenario"
            )
    try:
        numbers = json.loads((folder / NUMBERS).read_text(encoding="utf-8"))
        with xr.open_dataset(folder / DATA, engine="h5netcdf") as opened:
            dataset = opened.load()
        name = str(numbers["name"])
        status, reason = numbers["status"], numbers.get("reason", "")
    except (OSError, ValueError, KeyError, TypeError) as error:
        said = " ".join(str(error).split())
        raise NotAResult(f"{folder}: its {DATA} or {NUMBERS} cannot be read ({said})") from None
    if "time" not in dataset.dims or dataset.sizes["time"] == 0:
        raise NotAResult(f"{folder}: its {DATA} has no row, allowed is a run that has one")
    made = _made_by(folder)
    remarks = []
    if status != "complete":
        remarks.append(
            f"{folder}: the run is not complete ({reason or status}): it is compared up to where"
            f" it came, {float(dataset['time'][-1]):g} s"
        )
    elif made.get("status", COMPLETE) != COMPLETE:
        remarks.append(f"{folder}: its results are not complete, writing them was cut off")
    scenario = str(made.get("scenario") or dataset.attrs.get("scenario", ""))
    return OneResult(name, str(folder), dataset, numbers, scenario, tuple(remarks))


def _made_by(folder: Path) -> dict[str, Any]:
    try:
        content = json.loads((folder / MANIFEST).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return content if isinstance(content, dict) else {}
