"""A sweep's dataset, which can become what `stickslip sweep` leaves: table, figure, page."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pandas as pd
import xarray as xr

from cosim.report.files import without_nan, write_netcdf, write_table
from cosim.report.page import render, write_page
from cosim.result import Result

from . import words
from .features import ALL
from .words import records, shown_features, unit_of

if TYPE_CHECKING:
    from cosim.report.page import Picture

RESULT, FIGURE, TABLE, PAGE = "sweep.nc", "sweep.png", "sweep.csv", "report.html"


class Sweep(xr.Dataset, Result):  # type: ignore[no-untyped-call]
    """One dimension for each varied key, one variable for each feature, `status` and `reason`.

    >>> from stickslip import Parameters
    >>> from cosim import sweep
    >>> done = sweep(Parameters(), {"rig.mass": [0.67, 2.03]}, duration=2.0, jobs=1)
    >>> len(done.summary()["runs"]), done.save("results/masses").name
    (2, 'masses')
    """

    __slots__ = ()

    def summary(self) -> dict[str, Any]:
        """Every run, as `--json` has them; NaN is None."""
        return summary({"": self})

    def _page(self) -> str:
        return _drawn(self)[0]

    def _write(self, folder: Path) -> None:
        write({"": self}, folder)


def summary(datasets: Mapping[str, xr.Dataset]) -> dict[str, Any]:
    """Every run of each group, "" being the first."""
    runs = {group or "runs": records(dataset) for group, dataset in datasets.items()}
    return dict(without_nan(runs))


def write(
    datasets: Mapping[str, xr.Dataset], folder: Path, asked: Sequence[str] = (), command: str = ""
) -> None:
    """All groups in one file; of the first table, figure and page.

    asked: features that are drawn (those that vary).
    """
    write_netcdf(datasets, folder / RESULT)
    write_table(pd.DataFrame(records(datasets[""])), folder / TABLE, index=False)
    text, picture = _drawn(datasets[""], asked, command)
    write_page(text, [picture], folder)


def _drawn(
    dataset: xr.Dataset, asked: Sequence[str] = (), command: str = ""
) -> tuple[str, Picture]:
    """Page and figure."""
    from .figure import draw_sweep  # matplotlib, which no worker needs

    drawn, still = shown_features(dataset, asked)
    picture = draw_sweep(dataset, drawn)
    scenario = str(dataset.attrs.get("scenario", ""))
    dims = {str(dim): unit_of(dataset[dim]) for dim in dataset["status"].dims}
    told = {"name": tomllib.loads(scenario).get("name", "Mechanics"), "scenario": scenario}
    told |= {"dataset": dataset, "dims": dims, "coordinates": [dataset[dim] for dim in dims]}
    told |= {"picture": picture, "drawn": {name: ALL[name] for name in drawn}, "still": still}
    # the template calls what that module knows
    html = render("sweep.html.j2", __package__ or "", **vars(words) | told, command=command)
    return html, picture
