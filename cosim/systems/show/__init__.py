"""A system's run to the files of its output folder: data, summary, figures and one page."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from cosim.coupling.record import LOG
from cosim.files import write_bytes, write_text
from cosim.report.columns import write_columns, write_columns_as_csv
from cosim.report.files import PAGE_ALONE, Shown, write_json
from cosim.systems.run import SystemRun
from cosim.systems.show.page import OWN_FILES, page
from cosim.systems.show.summary import summary, system_columns

__all__ = ["FILES", "write_system"]

FILES = ("result.nc", "result.csv", "summary.json", "report.html", LOG)


def write_system(
    run: SystemRun,
    folder: Path,
    *,
    command: str = "",
    files: Mapping[str, str] | None = None,
    progress: Callable[[str], None] = lambda name: None,
    shown: Shown = PAGE_ALONE,
) -> dict[str, Any]:
    """Write everything into a folder that exists, the data first; the numbers of the summary.

    command: how the run was asked for, shown on the page. files: further files of
    the run -> what they are, to be listed there. progress: called with the name of each
    file once it is written. shown: whether there are figures as PNG files, and a page. Raises
    OutputError where the disk refuses.
    """
    columns = system_columns(run)
    numbers = summary(run, columns)
    for path in (
        write_columns(columns, folder / "result.nc"),
        write_columns_as_csv(columns, "time", folder / "result.csv"),
        write_json(numbers, folder / "summary.json"),
    ):
        progress(path.name)
    from cosim.systems.show.figures import pictures  # matplotlib: after the data are on disk

    figures = pictures(run, columns)
    listed = OWN_FILES | dict(files or {})
    for name, picture in figures.items() if shown["figures"] else ():
        progress(write_bytes(picture.png, folder / f"{name}.png").name)
        listed[f"{name}.png"] = "figure, as above"
    if shown["page"]:
        text = page(numbers, figures, command=command, files=listed)
        progress(write_text(text, folder / "report.html").name)
    return numbers
