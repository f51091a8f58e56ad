"""The page of a sweep: what was asked, the figure, every run in a table, what failed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from cosim.report.page import Picture, render

from .features import ALL
from .figure import still_sentence, titled

#: Runs that the page lists; the rest is in the file.
MOST_ROWS = 500
SLIDES, HOLDS = "slides", "never slips"
EXPLAINED = {
    SLIDES: "it slides all the time",
    HOLDS: "it never breaks away: it rests, or rides along with the surface",
}
FILES = {
    "sweep.nc": "all features of all runs, with units: netCDF 4, for xarray, Matlab",
    "sweep.csv": "the same as a table, a line for each run",
}


def page(
    dataset: xr.Dataset,
    picture: Picture,
    drawn: Sequence[str],
    still: Sequence[str],
    *,
    name: str,
    command: str,
    scenario: str,
) -> str:
    """HTML of a sweep; drawn, still: features in the figure, and those that do not vary."""
    dims = [str(dim) for dim in dataset["status"].dims]
    rows = records(dataset)
    return render(
        "sweep.html.j2",
        "cosim.studies.sweep",
        name=name,
        coordinates=[dataset[dim] for dim in dims],
        coupled=bool(dataset.attrs["coupled"]),
        complete=sum(row["status"] == "complete" for row in rows),
        regimes=regimes_sentence(rows),
        still=still_sentence(dataset, still),
        figure_of=picture,
        drawn={name: ALL[name] for name in drawn},
        rows=rows,
        most=MOST_ROWS,
        failed=[row for row in rows if row["reason"]],
        files=FILES,
        command=command,
        scenario=scenario,
        titled=titled,
        without_frequency=without_frequency,
    )


def records(dataset: xr.Dataset) -> list[dict[str, Any]]:
    """A dictionary for each run: dimensions, linked keys, features, status, reason."""
    table = dataset.to_dataframe().reset_index()
    meanings = str(dataset["status"].attrs["flag_meanings"]).split()
    found = []
    for entries in table.to_dict("records"):
        row = {str(key): _plain(value) for key, value in entries.items()}
        found.append(row | {"status": meanings[int(row["status"])]})
    return found


def _plain(value: Any) -> Any:
    return value.item() if isinstance(value, np.generic) else value


def without_frequency(row: Mapping[str, Any]) -> str:
    """What a block does that never breaks away at constant speed."""
    return SLIDES if row["slip_share"] == 1.0 else HOLDS


def regimes_sentence(rows: Sequence[Mapping[str, Any]]) -> str:
    """In how many runs the block does what, where it does not stick and slip in all of them."""
    complete = [row for row in rows if row["status"] == "complete"]
    does = [without_frequency(row) for row in complete if row["frequency"] == 0.0]
    if not does:
        return ""
    told = [
        f"in {does.count(what)} {explained}"
        for what, explained in EXPLAINED.items()
        if does.count(what)
    ]
    return (
        f"In {len(does)} of {len(complete)} runs the block does not stick and slip at constant "
        f"speed: {', '.join(told)}. Another start may lead to stick-slip there; "
        "stickslip stability tells."
    )
