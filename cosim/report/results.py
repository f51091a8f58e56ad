"""A run's dataset to the files of its output folder: data, summary, page, figures on request."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from datetime import datetime
from pathlib import Path
from typing import Any

from stickslip.steady_motion.starts import STARTS

from cosim.files import write_bytes, write_text
from cosim.report.columns import Columns, Data, write_columns, write_columns_as_csv
from cosim.scenario.keys import taken_line

from . import quantities, run_text
from .contents import Views, material_of, stored_tables
from .coupling import doubts, step_rows
from .files import write_json
from .heat_numbers import ambient_degC
from .material import page_of_material
from .page import render
from .run_summary import summary

Progress = Callable[[str], None]

ANIMATION = "temperature.gif"
OWN_FILES: dict[str, str] = quantities.TABLES["files"]
CASES = {"coupled": "mechanics coupled to belt and ice", "mechanics": "mechanics alone"}


def write_results(
    dataset: Data,
    folder: str | Path,
    *,
    command: str = "",
    files: Mapping[str, str] | None = None,
    views: Views = (),
    progress: Progress | None = None,
    figures: bool = False,
    page: bool = True,
) -> list[Path]:
    """Write data, summary and page into a folder that exists; the data first.

    command: how the run was asked for, shown on the page. files: further files of the run,
    relative to the folder -> what they are, to be listed there. views: times (s) and what is seen
    of belt and ice, for an animation; none without them. progress: called with the name
    of each file once it is written. figures: those of the page as PNG files, too. Raises
    OutputError where the disk refuses.
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
    files = dict(files or {})
    if figures:
        for path in write_figures(dataset, folder):
            done(path)
            files[path.name] = "figure, as above"
    if views:
        from .figures.animation import Moving, animation

        columns = (dataset[name].values for name in ("time", "x", "surface_travel"))
        film = animation(views, ambient_degC(dataset), dataset.attrs["title"], Moving(*columns))
        done(write_bytes(film, folder / ANIMATION))
        files[ANIMATION] = "temperature of belt and ice over time, an animation"
    if page:
        text = run_page(dataset, numbers, command=command, files=OWN_FILES | files)
        done(write_text(text, folder / "report.html"))
    return written


def write_figures(dataset: Data, folder: Path, names: Sequence[str] = ()) -> Iterator[Path]:
    """The figures of a run's page as ``NAME.png``, one after the other; all, if none is named.

    Raises ValueError for a name that is none, before anything is written.
    """
    from .figures import named_plates

    for plate in named_plates(dataset, names):
        yield write_bytes(plate.picture(dataset).png, folder / f"{plate.name}.png")


def write_data(dataset: Data, folder: str | Path) -> list[Path]:
    """`result.nc` and `result.csv`."""
    folder = Path(folder)
    columns = Columns.of(dataset)
    return [
        write_columns(columns, folder / "result.nc"),
        write_columns_as_csv(columns, "time", folder / "result.csv"),
    ]


def run_page(
    dataset: Data,
    numbers: Mapping[str, Any],
    *,
    command: str = "",
    files: Mapping[str, str] | None = None,
) -> str:
    """HTML of a run: numbers of `summary`, its figures, the files beside it."""
    from .figures import plates_of

    told: dict[str, Any] = {"numbers": numbers, "files": files or {}, "command": command}
    told |= {"starts": STARTS, "cases": CASES, "step_rows": step_rows, "doubts": doubts}
    told |= {"parameters": stored_tables(dataset), "defaults": taken_line(numbers["defaults"])}
    told |= {"created": datetime.fromisoformat(numbers["created"])}
    told |= {"figures": [plate.picture(dataset) for plate in plates_of(dataset)]}
    # the template calls what these modules know
    html = render("run.html.j2", __package__ or "", **vars(quantities) | vars(run_text) | told)
    return page_of_material(html, material_of(dataset))
