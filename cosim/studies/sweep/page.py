"""The page of a sweep: what the block does where, the figure, every run in a table, what failed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from itertools import groupby
from typing import Any

import numpy as np
import xarray as xr

from cosim.report.page import Picture, number, render

from .features import ALL
from .figure import still_sentence, titled, unit_of

#: Runs that the page lists; the rest is in the file.
MOST_ROWS = 500
#: Motions in turn along an axis that a sentence can tell.
MOST_TURNS = 3
MOVES, SLIDES, HOLDS = "sticks and slips", "slides", "never slips"
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
    dims = {str(dim): unit_of(dataset[dim]) for dim in dataset["status"].dims}
    rows = records(dataset)
    return render(
        "sweep.html.j2",
        "cosim.studies.sweep",
        name=name,
        coordinates=[dataset[dim] for dim in dims],
        coupled=bool(dataset.attrs["coupled"]),
        sentence=sentence(rows, dims),
        tiles=tiles(rows, dims),
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
        regime=regime,
    )


def records(dataset: xr.Dataset) -> list[dict[str, Any]]:
    """A dictionary for each run: dimensions, linked keys, features, status, reason."""
    table = dataset.to_dataframe().reset_index()
    meanings = str(dataset["status"].attrs["flag_meanings"]).split()
    table["status"] = [meanings[status] for status in table["status"]]
    return [{str(key): value for key, value in row.items()} for row in table.to_dict("records")]


def regime(row: Mapping[str, Any]) -> str:
    """What a block does at constant speed; it may break away once, which makes no frequency."""
    if row["frequency"] == 0.0:
        return SLIDES if row["slip_share"] == 1.0 else HOLDS
    return MOVES


def sentence(rows: Sequence[Mapping[str, Any]], dims: Mapping[str, str]) -> str:
    """What the block does where; dims: what is varied -> its unit."""
    complete = [row for row in rows if row["status"] == "complete"]
    does = Counter(map(regime, complete))
    failed = f"; {len(rows) - len(complete)} failed" if len(complete) < len(rows) else ""
    if not complete:
        return f"None of {len(rows)} runs is complete."
    if len(does) == 1:
        return f"The block {regime(complete[0])} in all {len(complete)} runs{failed}."
    turns = [(what, list(some)) for what, some in groupby(complete, regime)]
    if len(dims) == 1 and len(turns) <= MOST_TURNS:
        ((dim, unit),) = dims.items()
        told = [f"{what} at {dim} = {_span(some, dim, 4)}{unit}" for what, some in turns]
    else:
        told = [f"{what} in {count}" for what, count in does.most_common()]
        told[0] += f" of {len(complete)} runs"
    return f"The block {', '.join(told[:-1])} and {told[-1]}{failed}."


def _span(rows: Sequence[Mapping[str, Any]], key: str, digits: int) -> str:
    """From the first to the last of some numbers or names."""
    ends = dict.fromkeys(number(row[key], digits) for row in (rows[0], rows[-1]))
    return " to ".join(ends)


def tiles(rows: Sequence[Mapping[str, Any]], dims: Mapping[str, str]) -> list[tuple[str, str]]:
    """Up to four figures: how many stick and slip, how often, and the largest of what is usual."""
    complete = [row for row in rows if row["status"] == "complete"]
    moving = [row for row in complete if regime(row) == MOVES]
    told = [(f"of {len(complete)} complete runs stick and slip", str(len(moving)))]
    often = sorted(
        (row for row in moving if row["frequency"] > 0.0), key=lambda row: row["frequency"]
    )
    if often:
        told.append(("break-aways in a second", f"{_span(often, 'frequency', 3)} Hz"))
    for name, words in (("x_std", "largest standard deviation of x"),
                        ("interface_rise", "warmest contact, over the air")):  # fmt: skip
        found = [row for row in complete if row.get(name, np.nan) > 0.0]
        if found:
            row = max(found, key=lambda each: each[name])
            at = ", ".join(f"{dim} = {number(row[dim])}{unit}" for dim, unit in dims.items())
            unit = "mm" if name == "x_std" else "mK"
            told.append((f"{words}, at {at}", f"{number(1e3 * row[name], 3)} {unit}"))
    return told
