"""A run's dataset to the files of its output folder."""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping
from pathlib import Path

import xarray as xr

from cosim.files import write_bytes, write_text

from .animation import Views, animation
from .figures import plates_of
from .files import write_csv, write_json, write_netcdf
from .heat_numbers import ambient_degC
from .page import page
from .style import DPI
from .summary import summary

Progress = Callable[[str], None]

ANIMATION = "temperature.gif"


def write_results(
    dataset: xr.Dataset,
    folder: str | Path,
    *,
    command: str = "",
    files: Mapping[str, str] | None = None,
    views: Views = (),
    progress: Progress | None = None,
) -> list[Path]:
    """Write data, summary, figures and page into a folder that exists; the data first.

    command: how the run was asked for, shown on the page. files: further files of the run,
    relative to the folder -> what they are, to be listed there. views: times (s) and what is seen
    of belt and ice, for an animation; none without them. progress: called with the name
    of each file once it is written. Raises OutputError where the disk refuses.
    """
    folder = Path(folder)
    written: list[Path] = []

    def done(path: Path) -> None:
        written.append(path)
        if progress is not None:
            progress(path.name)

    for path in write_data(dataset, folder):
        done(path)
    numbers = summary(dataset)
    done(write_json(numbers, folder / "summary.json"))
    pictures = {}
    for plate in plates_of(dataset):
        pictures[plate] = png(dataset, plate.draw)
        done(write_bytes(pictures[plate], folder / f"{plate.name}.png"))
    files = dict(files or {})
    if views:
        moving = animation(views, ambient_degC(dataset), dataset.attrs["title"])
        done(write_bytes(moving, folder / ANIMATION))
        files[ANIMATION] = "temperature of belt and ice over time, an animation"
    text = page(dataset, numbers, pictures, command=command, files=files)
    done(write_text(text, folder / "report.html"))
    return written


def write_data(dataset: xr.Dataset, folder: str | Path) -> list[Path]:
    """`result.nc` and `result.csv`."""
    folder = Path(folder)
    return [
        write_netcdf(dataset, folder / "result.nc"),
        write_csv(dataset, folder / "result.csv"),
    ]


def png(dataset: xr.Dataset, draw: Callable) -> bytes:
    """A figure as the bytes of a PNG file."""
    buffer = io.BytesIO()
    draw(dataset).savefig(buffer, format="png", dpi=DPI)
    return buffer.getvalue()
