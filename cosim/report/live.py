"""What a picture is interactive with: numbers for the page's scripts, few enough for a small page.

A picture's ``live`` is a mapping of plain JSON with the name of its script as ``kind``
(`templates/KIND.js`). Numbers travel as base64 of little-endian arrays, see `packed`.
"""

import base64
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cosim.report.columns import Array

Live = Mapping[str, Any]

#: Rows of a figure on a page: about three a pixel of a wide screen. Of more, each of so many
#: stretches of time keeps its lowest and its highest point of every curve.
MOST_ROWS = 5000
#: Stretches there are at least, however many curves: about one for each two pixels.
LEAST_STRETCHES = 600
#: The highest level of a map.
LEVELS = 255
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


class Map(NamedTuple):
    """A field (times, places) below the curves of a panel, with the name and the unit of its scale.

    Its times are the figure's; its places go evenly from 0 to ``length``, in the panel's unit.
    least: where the scale ends at least.
    """

    values: Array
    length: float
    label: str
    unit: str
    colours: str
    least: float

    def live(self) -> Live:
        """With as many colours as a map has levels."""
        low, high = self.ends
        levels = np.rint(LEVELS * (self.values - low) / (high - low))
        told = {key: getattr(self, key) for key in ("length", "label", "unit")}
        told |= {"shape": self.values.shape, "low": low, "high": high}
        return told | {"levels": packed(levels, "u1"), "colours": colour_table(self.colours)}

    @property
    def ends(self) -> tuple[float, float]:
        """Of the scale: from 0 on, or from what is below it."""
        return min(0.0, float(self.values.min())), max(float(self.values.max()), self.least)

    def without_jumps(self, places: Array) -> Array:
        """A way (times,) round the loop with NaN where it comes to its end, for a line."""
        jumps = np.abs(np.diff(places, prepend=places[:1])) > 0.5 * self.length
        return np.where(jumps, np.nan, places)


@dataclass(frozen=True)
class Panel:
    """Curves with one scale; label: of the scale, with its unit in brackets.

    levels: heights of broken lines, and what they are. stacked: each filled curve shows what is
    between it and the next, and hovering says that. from_zero: the scale begins at 0. span: the
    least that it spans. top: where it ends. shaded: the figure's phases show. logarithmic: of the
    scale. thermometer: air temperature (degC) and factor to K, for a second scale of degrees. map:
    a field below a curve of places.
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
    map: Map | None = None


@dataclass(frozen=True)
class TimeFigure:
    """Panels over the time (n,) s, rising: drawn by a page's scripts, see `live`, or by matplotlib,
    see `style.draw_over_time`.

    keep: rows (n,) that stay whatever is left out of a page, as events. phases: begin and end
    (k, 2) s of what is shaded, called ``phase``. marks: times with a word. part: begin, end (s) and
    name of a part that is worth a look; opens_at_part: it is what is seen at first; own_scale: its
    drawing has another scale than that of the whole. note: a line below. columns: panels beside
    each other where there is room. title, height: of the drawing, and of its panels (inches).
    """

    time: Array
    panels: Sequence[Panel]
    keep: NDArray[np.bool_] | None = None
    phases: Array = field(default_factory=lambda: np.empty((0, 2)))
    phase: str = ""
    marks: Sequence[tuple[float, str]] = ()
    part: tuple[float, float, str] | None = None
    opens_at_part: bool = False
    own_scale: bool = False
    note: str = ""
    columns: int = 1
    title: str = ""
    height: float = 1.9

    def live(self) -> Live:
        """With hover and zoom, all panels on one axis."""
        curves = [curve.values for panel in self.panels for curve in panel.curves]
        rows = thinned(self.time, curves, self.keep)
        plain = ("phase", "marks", "part", "opens_at_part", "note", "columns")
        return {
            "kind": "over_time",
            "time": packed(self.time[rows], "f8"),
            "panels": [_panel(panel, rows) for panel in self.panels],
            "phases": packed(self.phases, "f8"),
            **{name: getattr(self, name) for name in plain},
            "rows": [int(rows.size), int(self.time.size)],
        }


def several(figures: Mapping[str, Live]) -> Live:
    """Figures over times of their own, as of several runs, below each other by their headings."""
    made = [{**one, "heading": heading} for heading, one in figures.items()]
    return {"kind": "over_time", "figures": made}


def _panel(panel: Panel, rows: NDArray[np.int64]) -> dict[str, Any]:
    told = vars(panel) | {"thermometer": None, "map": panel.map and panel.map.live()}
    curves = [
        vars(curve) | {"values": packed(np.asarray(curve.values, float)[rows])}
        for curve in panel.curves
    ]
    return told | {"curves": curves}


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
    stretches = max(MOST_ROWS // (2 * len(curves)), LEAST_STRETCHES)
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


class Series(NamedTuple):
    """Values (n,) over the time (n,), s, of a curve; the curve's own values are not looked at."""

    time: Array
    curve: Curve


def panels_on_one_axis(
    panels: Sequence[tuple[Panel, Sequence[Series]]], span: tuple[float, float] = (-np.inf, np.inf)
) -> tuple[Array, list[Panel]]:
    """The times of all series of all panels within a span, s, and the panels with their curves.

    A curve has NaN outside its own times, one of dots between them, too.
    """
    times = np.unique(np.concatenate([one.time for _, series in panels for one in series]))
    seen = (times >= span[0]) & (times <= span[1])
    found = [
        replace(panel, curves=[replace(one.curve, values=_at(times, one)[seen]) for one in series])
        for panel, series in panels
    ]
    return times[seen], found


def _at(times: Array, one: Series) -> Array:
    values = np.asarray(one.curve.values, float)
    if not one.curve.dots:
        return np.asarray(np.interp(times, one.time, values, left=np.nan, right=np.nan), float)
    found = np.full(times.size, np.nan)
    found[np.searchsorted(times, one.time)] = values
    return found


def colour_table(name: str) -> str:
    """The 256 colours of a map as one text, six hexadecimal digits each, for a page."""
    import matplotlib  # only for who has a map

    colours = matplotlib.colormaps[name](np.arange(LEVELS + 1), bytes=True)[:, :3]
    return colours.tobytes().hex()


def packed(values: ArrayLike, kind: str = "f4") -> dict[str, str]:
    """Numbers as base64: f4 (seven digits), f8 (all of them) or u1 (0 to 255), row by row."""
    data = np.ascontiguousarray(values, dtype=f"<{kind}")
    return {"type": kind, "data": base64.b64encode(data.tobytes()).decode("ascii")}
