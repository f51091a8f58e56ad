"""A sweep's dataset, what is said of it, and what `stickslip sweep` leaves: table, figure, page.

`words.txt.j2` says what the block does where, and which features are the same in all runs.
"""

from __future__ import annotations

import tomllib
from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd
import xarray as xr

from cosim.names import unknown_name
from cosim.report.files import plain_data, write_netcdf, write_table
from cosim.report.page import render, sentences, texts, tiles_of, write_page
from cosim.result import Result

from .axis import SweepError
from .features import ALL

if TYPE_CHECKING:
    from cosim.report.page import Picture

RESULT, FIGURE, TABLE, PAGE = "sweep.nc", "sweep.png", "sweep.csv", "report.html"
#: What varies less than this, in parts of its size, is told in a line and not drawn.
STILL = 1e-3
MOVES, SLIDES, HOLDS = "sticks and slips", "slides", "never slips"

Record = Mapping[str, Any]


class Sweep(xr.Dataset, Result):  # type: ignore[no-untyped-call]
    """One dimension for each varied key, one variable for each feature, `status` and `reason`.

    >>> from stickslip import Parameters
    >>> from cosim import sweep
    >>> done = sweep(Parameters(), {"rig.mass": [0.67, 2.03]}, duration=2.0, jobs=1)
    >>> len(done.summary()["runs"]), done.save("results/masses").name
    (2, 'masses')
    """

    __slots__ = ()

    def __repr__(self) -> str:
        with xr.set_options(display_expand_attrs=False):  # type: ignore[no-untyped-call]
            return super().__repr__()

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
    return dict(plain_data(runs))


def records(dataset: xr.Dataset) -> list[dict[str, Any]]:
    """Every run."""
    table = dataset.to_dataframe().reset_index()
    meanings = str(dataset["status"].attrs["flag_meanings"]).split()
    table["status"] = [meanings[status] for status in table["status"]]
    return [{str(key): value for key, value in row.items()} for row in table.to_dict("records")]


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
    from .figure import draw_sweep, titled, unit_of  # matplotlib, which no worker needs

    drawn, still = shown_features(dataset, asked)
    picture = draw_sweep(dataset, drawn)
    scenario = str(dataset.attrs.get("scenario", ""))
    dims = {str(dim): unit_of(dataset[dim]) for dim in dataset["status"].dims}
    told = {"dataset": dataset, "scenario": scenario, "picture": picture, "titled": titled}
    told |= {"dims": dims, "coordinates": [dataset[dim] for dim in dims], "still": still}
    told |= {"drawn": {name: ALL[name] for name in drawn}, "command": command}
    name = tomllib.loads(scenario).get("name", "Mechanics")
    # the template calls what this module knows
    html = render("sweep.html.j2", __package__ or "", **globals() | told, name=name)
    return html, picture


def shown_features(dataset: xr.Dataset, asked: Sequence[str] = ()) -> tuple[list[str], list[str]]:
    """Features to be drawn, and those that are the same in all runs; asked: by name."""
    if asked:
        return list(dict.fromkeys(asked)), []
    there = [name for name, one in ALL.items() if one.usual and name in dataset]
    drawn = [name for name in there if _varies(name, _known(dataset[name]))]
    return drawn or there[:1], [name for name in there if name not in drawn]


def check_shown(asked: Sequence[str], features: Collection[str]) -> None:
    """SweepError for a name that is none of the features of a sweep."""
    known = [name for name in ALL if name in features]
    for name in asked:
        if name not in known:
            raise SweepError(f"--show: {unknown_name('feature of this sweep', name, known)}")


def _known(values: xr.DataArray) -> Any:
    return values.values[np.isfinite(values.values)]


def _varies(name: str, known: Any) -> bool:
    nothing = ALL[name].nothing
    return known.size > 1 and bool(np.ptp(known) > STILL * max(np.abs(known).max(), nothing))


def regime(row: Record) -> str:
    """What a block does at constant speed; it may break away once, which makes no frequency."""
    if row["frequency"] == 0.0:
        return SLIDES if row["slip_share"] == 1.0 else HOLDS
    return MOVES


def sentence(rows: Sequence[Record], dims: Mapping[str, str]) -> str:
    """What the block does where; dims: what is varied -> its unit."""
    complete = _complete(rows)
    does = Counter(map(regime, complete)).most_common()
    turns = [(what, list(some)) for what, some in groupby(complete, regime)]
    return str(_text().sentence(rows, complete, does, turns, dims))


def tiles(rows: Sequence[Record], dims: Mapping[str, str]) -> list[tuple[str, str]]:
    """Up to four figures: how many stick and slip, how often, and the largest of what is usual."""
    complete = _complete(rows)
    moving = [row["frequency"] for row in complete if regime(row) == MOVES]
    return tiles_of(_text().tiles(complete, moving, dims))


def still_sentence(dataset: xr.Dataset, names: Sequence[str]) -> str:
    """What is the same in all runs, in sentences; "" where nothing is."""
    told = [(name, ALL[name], _known(dataset[name]), dataset[name].size) for name in names]
    return " ".join(sentences(_text().still(told)))


def _complete(rows: Sequence[Record]) -> list[Record]:
    return [row for row in rows if row["status"] == "complete"]


def _text() -> Any:
    """The macros of `words.txt.j2`."""
    return texts("words.txt.j2", __package__ or "", {})
