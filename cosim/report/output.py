"""What every command writes: NetCDF, CSV and JSON with what made them, and one self-contained page.

A page is a Jinja template that extends `page.html.j2` and fills its blocks title, style and
content; its pictures are inside. Beside its own values it has ``figure(picture)`` and the filter
``number``.
"""

from __future__ import annotations

import base64
import json
import math
import platform
from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import UTC, datetime
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any, Literal

import xarray as xr
from jinja2 import ChoiceLoader, Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from cosim.atomic import write_atomically, write_text

PACKAGES = (
    "stickslip",
    "numpy",
    "numba",
    "scipy",
    "scikit-fem",
    "fmpy",
    "pythonfmu",
    "xarray",
    "h5netcdf",
    "matplotlib",
    "pydantic",
)


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
    groups = {"": dataset} if isinstance(dataset, xr.Dataset) else dataset

    def write(partial: Path) -> None:
        mode: Literal["w", "a"] = "w"
        for group, one in groups.items():
            one.to_netcdf(partial, mode=mode, group=group or None, engine="h5netcdf")
            mode = "a"

    return write_atomically(path, write)


def write_csv(dataset: xr.Dataset, path: Path) -> Path:
    """Everything over ``time`` as a table; numbers with the digits that restore them exactly."""
    names = [name for name in dataset.data_vars if dataset[name].dims == ("time",)]
    table = dataset[names].to_dataframe()
    return write_atomically(path, lambda partial: table.to_csv(partial))


def write_json(content: Mapping[str, Any], path: Path) -> Path:
    """A JSON file; NaN is refused, a missing number is null."""
    text = json.dumps(content, indent=2, allow_nan=False, ensure_ascii=False)
    return write_text(text + "\n", path)


#: Pixels of an inch: on a page, and of the pictures.
CSS_DPI, DPI = 96, 150


@dataclass(frozen=True)
class Picture:
    """A PNG with its caption."""

    name: str
    caption: str
    png: bytes = field(repr=False)


def render(template: str, package: str, **values: Any) -> str:
    """HTML of a template that lies in a package, or in `cosim.report`, with the values it names.

    Raises jinja2.UndefinedError where one of them is missing.
    """
    return _environment(package).get_template(template).render(**values)


@cache
def _environment(package: str) -> Environment:
    environment = Environment(
        loader=ChoiceLoader([PackageLoader("cosim.report"), PackageLoader(package, ".")]),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["number"] = number
    environment.globals["figure"] = figure
    return environment


def figure(picture: Picture, alt: str = "") -> Markup:
    """A picture and its caption, as wide as its inches say."""
    return Markup(
        '<figure><img width="{}" src="data:image/png;base64,{}" alt="{}">\n'
        "<figcaption>{}</figcaption></figure>\n"
    ).format(
        _width(picture.png),
        base64.b64encode(picture.png).decode("ascii"),
        alt or picture.caption,
        picture.caption,
    )


def number(value: float | str | None, digits: int = 4) -> str:
    """So many significant digits, plain text as it is, a dash for none."""
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        return "–"
    if isinstance(value, str):
        return value
    return f"{value:.{digits}g}".replace("-", "−")


def _width(png: bytes) -> int:
    """Width of a picture on the page, CSS pixels: type as large as its inches say."""
    pixels = int.from_bytes(png[16:20], "big")  # of the header, after signature and chunk name
    return round(pixels * CSS_DPI / DPI)
