"""What is said of a sweep: which features tell something, what the block does where."""

from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from itertools import groupby
from typing import Any

import numpy as np
import xarray as xr

from cosim.names import unknown_name
from cosim.report.page import texts, tiles_of, unit_text

from .axis import SweepError
from .features import ALL

#: What varies less than this, in parts of its size, is told in a line and not drawn.
STILL = 1e-3
MOVES, SLIDES, HOLDS = "sticks and slips", "slides", "never slips"

Record = Mapping[str, Any]


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


def still_sentence(dataset: xr.Dataset, names: Sequence[str]) -> str:
    """What is the same in all runs, in a sentence; "" where nothing is."""
    said, none = [], []
    for name in names:
        feature, known = ALL[name], _known(dataset[name])
        words, _, unit = feature.label.removesuffix("]").partition(" [")
        if not known.size:
            none.append(words)
        elif name == "frequency" and not known.any():
            said.append("no stick-slip")
        else:
            value = float(np.mean(known)) * feature.factor
            nothing = abs(value) <= feature.nothing * feature.factor
            of_unit = f" {unit}" if unit != "1" else ""
            where = " (where there is one)" if known.size < dataset[name].size else ""
            said.append(f"{words} {'0' if nothing else f'{value:.3g}'}{of_unit}{where}")
    sentences = [f"The same in all runs: {', '.join(said)}."] if said else []
    if none:
        sentences.append(f"In no run, for want of cycles at constant speed: {', '.join(none)}.")
    return " ".join(sentences)


def titled(coordinate: xr.DataArray) -> str:
    """A dimension with its unit."""
    unit = unit_of(coordinate).strip()
    return f"{coordinate.name} [{unit}]" if unit else str(coordinate.name)


def unit_of(coordinate: xr.DataArray) -> str:
    """As it stands behind a number; nothing for a plain number or a name."""
    unit = unit_text(coordinate.attrs["units"])
    return "" if unit == "1" else f" {unit}"


def records(dataset: xr.Dataset) -> list[dict[str, Any]]:
    """Every run."""
    table = dataset.to_dataframe().reset_index()
    meanings = str(dataset["status"].attrs["flag_meanings"]).split()
    table["status"] = [meanings[status] for status in table["status"]]
    return [{str(key): value for key, value in row.items()} for row in table.to_dict("records")]


def regime(row: Record) -> str:
    """What a block does at constant speed; it may break away once, which makes no frequency."""
    if row["frequency"] == 0.0:
        return SLIDES if row["slip_share"] == 1.0 else HOLDS
    return MOVES


def _complete(rows: Sequence[Record]) -> list[Record]:
    return [row for row in rows if row["status"] == "complete"]


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


def _text() -> Any:
    """The macros of `words.txt.j2`."""
    return texts("words.txt.j2", __package__ or "", {})
