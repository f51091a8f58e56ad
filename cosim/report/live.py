"""What a picture is interactive with: numbers for the page's scripts, few enough for a small page.

A picture's ``live`` is a mapping of plain JSON with the name of its script as ``kind``
(`templates/KIND.js`). Numbers travel as base64 of little-endian arrays, see `packed`.
"""

from __future__ import annotations

import base64
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Live = Mapping[str, Any]

#: Rows of a figure on a page: about three a pixel of a wide screen. Of more, each of so many
#: stretches of time keeps its lowest and its highest point of every curve.
MOST_ROWS = 5000
#: Known events of a figure: from more on they are rows like others.
MOST_EVENTS = 4000


@dataclass(frozen=True)
class Curve:
    """A curve over time: values (n,) in the unit of its panel; steps: held back to the row before.

    dash: drawn broken. fill: the area below is filled. dots: not joined by a line.
    """

    label: str
    values: Array
    colour: str
    dash: bool = False
    steps: bool = False
    fill: bool = False
    dots: bool = False
    width: float = 1.3


@dataclass(frozen=True)
class Panel:
    """Curves with one scale; label: of the scale, with its unit in brackets.

    levels: heights of broken lines, and what they are. stacked: each filled curve shows what is
    between it and the next, and hovering says that. from_zero: the scale begins at 0. span: the
    least that it spans. top: where it ends. shaded: the figure's phases show. logarithmic: of the
    scale. thermometer: air temperature (degC) and factor to K, for a second scale of degrees.
    """

    label: str
    curves: Sequence[Curve]
    levels: Sequence[tuple[float, str]] = ()
    stacked: bool = False
    from_zero: bool = False
    span: float = 0.0
    top: float | None = None
    shaded: bool = True
    logarithmic: bool = False
    thermometer: tuple[float, float] | None = None


def over_time(
    time: Array,
    panels: Sequence[Panel],
    *,
    keep: NDArray[np.bool_] | None = None,
    phases: Array | None = None,
    phase: str = "",
    marks: Sequence[tuple[float, str]] = (),
    part: tuple[float, float, str] | None = None,
    note: str = "",
    columns: int = 1,
) -> Live:
    """Panels over the time (n,) s, rising: with hover and zoom, all on one axis.

    keep: rows (n,) that stay whatever is left out, as events. phases: begin and end (k, 2) s of
    what is shaded, called ``phase``. marks: times with a word. part: begin, end (s) and name of a
    part that is worth a look. note: a line below. columns: panels
    beside each other where there is room.
    """
    rows = thinned(time, [curve.values for panel in panels for curve in panel.curves], keep)
    return {
        "kind": "over_time",
        "time": packed(time[rows], "f8"),
        "panels": [_panel(panel, rows) for panel in panels],
        "phases": packed(np.empty(0) if phases is None else phases, "f8"),
        "phase": phase,
        "marks": [list(mark) for mark in marks],
        "part": part and list(part),
        "note": note,
        "columns": columns,
        "rows": [int(rows.size), int(time.size)],
    }


def several(figures: Mapping[str, Live]) -> Live:
    """Figures over times of their own, as of several runs, below each other by their headings."""
    made = [{**one, "heading": heading} for heading, one in figures.items()]
    return {"kind": "over_time", "figures": made}


def _panel(panel: Panel, rows: NDArray[np.int64]) -> dict[str, Any]:
    told = {
        key: getattr(panel, key)
        for key in ("label", "stacked", "from_zero", "span", "top", "shaded", "logarithmic")
    }
    curves = [
        {
            "label": curve.label,
            "colour": curve.colour,
            "dash": curve.dash,
            "steps": curve.steps,
            "fill": curve.fill,
            "dots": curve.dots,
            "width": curve.width,
            "values": packed(np.asarray(curve.values, float)[rows]),
        }
        for curve in panel.curves
    ]
    return told | {"levels": [list(level) for level in panel.levels], "curves": curves}


def thinned(
    time: Array, curves: Sequence[Array], keep: NDArray[np.bool_] | None = None
) -> NDArray[np.int64]:
    """Rows that show the curves (n,) over the rising time (n,): all of them up to `MOST_ROWS`.

    Of more: first and last, the lowest and the highest of each curve in every stretch of time, and
    those to ``keep`` (n,), up to `MOST_EVENTS`.
    """
    count = time.size
    if count <= MOST_ROWS or not curves:
        return np.arange(count)
    chosen = np.zeros(count, bool)
    chosen[[0, -1]] = True
    if keep is not None and keep.sum() <= MOST_EVENTS:
        chosen |= keep
    stretches = max(MOST_ROWS // (2 * len(curves)), 1)
    edges = np.searchsorted(time, np.linspace(time[0], time[-1], stretches + 1)[:-1])
    edges = np.unique(edges)
    for values in curves:
        for sign in (1.0, -1.0):
            chosen[_highest(np.where(np.isfinite(values), sign * values, -np.inf), edges)] = True
        # where a curve is cut off, the cut stays
        gaps = ~np.isfinite(values)
        chosen[:-1] |= gaps[:-1] != gaps[1:]
    return np.flatnonzero(chosen)


def _highest(values: Array, edges: NDArray[np.int64]) -> NDArray[np.int64]:
    """The first row with the largest value of each stretch, by the rows that stretches begin at."""
    stretch = np.repeat(np.arange(edges.size), np.diff(np.append(edges, values.size)))
    top = values == np.maximum.reduceat(values, edges)[stretch]
    found = np.flatnonzero(top)
    return found[np.unique(stretch[found], return_index=True)[1]]


def packed(values: ArrayLike, kind: str = "f4") -> dict[str, str]:
    """Numbers as base64: f4 (seven digits), f8 (all of them) or u1 (0 to 255), row by row."""
    data = np.ascontiguousarray(values, dtype=f"<{kind}")
    return {"type": kind, "data": base64.b64encode(data.tobytes()).decode("ascii")}
