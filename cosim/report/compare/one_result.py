"""One result, as a folder of `run`, `simulate` or `couple` holds it, or as a run gives it."""

import json
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from cosim.manifest import COMPLETE, manifest_of
from cosim.result import RunResult

DATA, NUMBERS = "result.nc", "summary.json"
#: What a system's numbers have of how it was run, and of each of its units.
SETTINGS = ("scheme", "order", "step_control", "macro_step")
OF_A_UNIT = ("file", "isolated", "substeps")


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
        """Every key of the scenario -> value, `table.key`; of a system, what it is made of."""
        if not self.scenario:
            return _of_system(self.numbers)
        found: dict[str, Any] = {}
        for name, value in tomllib.loads(self.scenario).items():
            is_table = isinstance(value, dict)
            found |= {f"{name}.{key}": value[key] for key in value} if is_table else {name: value}
        return found

    @property
    def output_step(self) -> float:
        """Time between rows, the median of all, s; 0 of a single row."""
        time = np.asarray(self.dataset["time"].values, float)
        return float(np.median(np.diff(time))) if time.size > 1 else 0.0


def read_result(folder: str | Path) -> OneResult:
    """The result in a folder; NotAResult, in one line, where there is none that can be read.

    >>> from cosim import read_result, simulate_scenario
    >>> read_result(simulate_scenario("study").save("results/study")).label
    'study'
    """
    folder = Path(folder)
    for name in (DATA, NUMBERS):
        if not (folder / name).is_file():
            raise NotAResult(
                f"{folder}: holds no {name}, allowed is a folder of results of stickslip run,"
                " simulate or couple, or a scenario"
            )
    try:
        numbers = json.loads((folder / NUMBERS).read_text(encoding="utf-8"))
        dataset = xr.load_dataset(folder / DATA, engine="h5netcdf")
        name = str(numbers["name"])
        status, reason = numbers["status"], numbers.get("reason", "")
    except (OSError, ValueError, KeyError, TypeError) as error:
        said = " ".join(str(error).split())
        raise NotAResult(f"{folder}: its {DATA} or {NUMBERS} cannot be read ({said})") from None
    if "time" not in dataset.dims or dataset.sizes["time"] == 0:
        raise NotAResult(f"{folder}: its {DATA} has no row, allowed is a run that has one")
    made = manifest_of(folder)
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


def as_result(one: OneResult | RunResult | str | Path, place: str = "this session") -> OneResult:
    """A result as it is, of a run that is kept nowhere, or `read_result` of a folder.

    place : what a run is from. Raises NotAResult as that does.
    """
    if isinstance(one, (str, Path)):
        return read_result(one)
    if isinstance(one, OneResult):
        return one
    dataset, numbers = one.to_xarray(), one.summary()
    failed = numbers["status"] != COMPLETE
    remarks = (f"{place}: its run is not complete ({numbers['reason']})",) * failed
    scenario = str(dataset.attrs.get("scenario", ""))
    return OneResult(str(numbers["name"]), place, dataset, numbers, scenario, remarks)


def _of_system(numbers: Mapping[str, Any]) -> dict[str, Any]:
    """How a system was coupled, its units and what they were set to, what feeds what."""
    coupling = numbers.get("coupling", {})
    found = {f"coupling.{key}": coupling[key] for key in SETTINGS if coupling.get(key) is not None}
    for name, unit in numbers.get("participants", {}).items():
        found |= {f"units.{name}.{key}": unit[key] for key in OF_A_UNIT if key in unit}
        found |= {f"units.{name}.{key}": value for key, value in unit.get("set", {}).items()}
    for each in numbers.get("connections", ()):
        found[f"connections.{each['to']}"] = each["from"]
    return found
