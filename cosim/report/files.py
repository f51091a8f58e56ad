"""Results as files, of every command: NetCDF, CSV and JSON, and what made them."""

from __future__ import annotations

import json
import math
import os
import platform
from collections.abc import Mapping, Sequence
from dataclasses import fields, is_dataclass
from datetime import UTC, datetime
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypedDict

from cosim.files import write_atomically, write_text

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

#: What a spreadsheet takes a cell for a formula by.
FORMULA = ("=", "+", "-", "@", "\t", "\r")
PACKAGES = (
    "stickslip", "numpy", "scipy", "scikit-fem", "fmpy", "pythonfmu",
    "xarray", "h5netcdf", "matplotlib", "pydantic",
)  # fmt: skip


class Shown(TypedDict):
    """What is drawn of a run: its figures as PNG files, its page."""

    figures: bool
    page: bool


PAGE_ALONE: Shown = {"figures": False, "page": True}


def results_line(folder: Path) -> str:
    """Where to look, for whoever waited: the page, if there is one."""
    page = folder / "report.html"
    return f"  results      {f'{page} and beside it' if page.is_file() else folder}"


#: Most that a netCDF file has beside its numbers, and for each variable, bytes.
_OVERHEAD, _A_VARIABLE = 2**18, 2**13


def provenance() -> dict[str, str]:
    """What every dataset says of its making: versions (JSON) and the time, UTC."""
    return {
        "versions": json.dumps(versions()),
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
    }


@cache
def versions() -> dict[str, str]:
    """Package -> version, Python and the platform first."""
    found = {"python": platform.python_version(), "platform": platform.platform()}
    return found | {name: _version(name) for name in PACKAGES}


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "not installed"


def write_netcdf(dataset: xr.Dataset | Mapping[str, xr.Dataset], path: Path) -> Path:
    """netCDF 4 (through h5netcdf): a dataset, or several by the name of their group ("": root)."""
    groups: Any = {"": dataset} if hasattr(dataset, "to_netcdf") else dataset

    def write(partial: Path) -> None:
        numbers = sum(one.nbytes for one in groups.values())
        require_room(partial, numbers, sum(len(one.variables) for one in groups.values()))
        mode: Literal["w", "a"] = "w"
        for group, one in groups.items():
            one.to_netcdf(partial, mode=mode, group=group or None, engine="h5netcdf")
            mode = "a"

    return write_atomically(path, write)


def require_room(path: Path, size: int, variables: int) -> None:
    """OSError while there is nothing to lose: HDF5 does not survive a disk that fills up.

    size : of all numbers, bytes
    """
    if not hasattr(os, "posix_fallocate"):
        return
    with path.open("wb") as file:
        os.posix_fallocate(file.fileno(), 0, _OVERHEAD + size + _A_VARIABLE * variables)


def write_table(table: pd.DataFrame, path: Path, index: bool = True) -> Path:
    """A table as CSV, of which a spreadsheet takes no name and no text for a formula."""
    texts = table.select_dtypes(exclude="number").map(no_formula)
    safe = table.assign(**texts).rename(columns=no_formula)
    return write_atomically(path, lambda partial: safe.to_csv(partial, index=index))


def no_formula(cell: Any) -> Any:
    """A text behind an apostrophe where it begins as a formula does and is no number."""
    if not (isinstance(cell, str) and cell.startswith(FORMULA)):
        return cell
    try:
        float(cell)
    except ValueError:
        return f"'{cell}"
    return cell


def plain_data(tree: Any) -> Any:
    """A result as JSON can have it: of dataclasses the fields, of arrays lists, and None for NaN
    and infinities."""
    if is_dataclass(tree):
        return {each.name: plain_data(getattr(tree, each.name)) for each in fields(tree)}
    if hasattr(tree, "tolist"):
        tree = tree.tolist()
    if isinstance(tree, Mapping):
        return {key: plain_data(one) for key, one in tree.items()}
    if isinstance(tree, (list, tuple)):
        return [plain_data(one) for one in tree]
    return None if isinstance(tree, float) and not math.isfinite(tree) else tree


def json_text(content: Mapping[str, Any] | Sequence[Any]) -> str:
    """JSON for a file; NaN is refused, a missing number is null."""
    return json.dumps(content, indent=2, allow_nan=False, ensure_ascii=False) + "\n"


def write_json(content: Mapping[str, Any] | Sequence[Any], path: Path) -> Path:
    """A JSON file, as `json_text` has it."""
    return write_text(json_text(content), path)
