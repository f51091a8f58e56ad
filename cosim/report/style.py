"""What all drawings share: type, panels, units on axes, PNG."""

import io
import textwrap
from collections.abc import Callable, Sequence
from functools import partial, wraps
from importlib.resources import files
from typing import Any

import matplotlib
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import PolyCollection, QuadMesh
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import LogLocator, NullFormatter, ScalarFormatter, StrMethodFormatter
from numpy.typing import NDArray
from PIL import Image

from cosim.report.columns import Array

from .live import Curve, Live, Map, Panel, TimeFigure
from .page import DPI, Picture
from .palette import GREY, INK, SLIP

#: The house style, whatever a user's own is.
RC: Any = matplotlib.rc_params_from_file(
    str(files(__package__) / "house.mplstyle"), use_default_template=False
)


def styled(draw: Callable[..., Figure]) -> Callable[..., Figure]:
    """Draw with the house style, whatever the user's own matplotlib settings."""

    @wraps(draw)
    def drawn(*args: Any, **options: Any) -> Figure:
        with matplotlib.rc_context(RC):
            return draw(*args, **options)

    return drawn


def picture(
    name: str, caption: str, *, alt: str = "", live: Callable[[Figure], Live] | None = None
) -> Callable[[Callable[..., Figure]], Callable[..., Picture]]:
    """Turn a function that draws a figure into one that returns a `Picture`.

    alt: what a reader hears. live: makes it alive, as `live.live_of` does a figure over time.
    """

    def wrap(draw: Callable[..., Figure]) -> Callable[..., Picture]:
        @wraps(draw)
        def drawn(*args: Any, **options: Any) -> Picture:
            if live is None:
                return Picture(name, caption, lambda: png(styled(draw)(*args, **options)), alt)
            figure = styled(draw)(*args, **options)
            return Picture(name, caption, partial(png, figure), alt, live(figure))

        return drawn

    return wrap


def shown(drawn: Callable[..., Picture], *args: Any) -> Figure:
    """The figure of a function of `picture`, before it is a PNG."""
    return displayed(styled(drawn.__wrapped__)(*args))  # type: ignore[attr-defined]


def displayed(figure: Figure) -> Figure:
    """With what Jupyter asks an object for: a notebook shows it where it stands last in a cell.

    Figures that pyplot does not know have nothing of the kind.
    """
    figure._repr_png_ = partial(png, figure)  # type: ignore[attr-defined]
    return figure


#: Of a PNG: half the bytes of true colour and less, and no eye sees the difference.
COLOURS = 256
ALMOST_WHITE = 252


def png(figure: Figure) -> bytes:
    """A figure as the bytes of a PNG file."""
    with matplotlib.rc_context(RC):
        figure.set_dpi(DPI)
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
        image = Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB")
    method = Image.Quantize.MEDIANCUT if _has_map(figure) else Image.Quantize.FASTOCTREE
    few = image.quantize(COLOURS, method=method, dither=Image.Dither.NONE)
    # the paper stays white
    few.putpalette([255 if level >= ALMOST_WHITE else level for level in few.getpalette() or []])
    buffer = io.BytesIO()
    few.save(buffer, format="png", dpi=(DPI, DPI))
    return buffer.getvalue()


def _has_map(figure: Figure) -> bool:
    """Whether there are more shades of one colour than the fast choice of colours keeps."""
    return any(axes.images or axes.findobj(QuadMesh) for axes in figure.axes)


def panels(
    rows: int, columns: int, *, height: float = 2.6, width: float = 9.0, **options: Any
) -> tuple[Figure, NDArray[Any]]:
    """A figure and its axes (rows, columns), laid out without overlaps; inches, height of a row."""
    figure = Figure(figsize=(width, height * rows), layout="constrained")
    return figure, figure.subplots(rows, columns, squeeze=False, **options)


def plain_ticks(axes: Axes) -> None:
    """Digits in full: no offset and no power of ten beside the axis."""
    for axis in (axes.xaxis, axes.yaxis):
        _in_full(axis)


def _in_full(axis: Axis) -> None:
    formatter = ScalarFormatter(useOffset=False)
    formatter.set_scientific(False)
    axis.set_major_formatter(formatter)


def logarithmic_x(axes: Axes) -> None:
    """A scale of 1, 2, 5, 10, ... with digits in full; of many decades, 1, 10, ..."""
    axes.set_xscale("log")
    _one_two_five(axes.xaxis)


def logarithmic_y(axes: Axes) -> None:
    """The same upright: no "6 x 10^-1" where it reaches over less than a decade."""
    axes.set_yscale("log")
    _one_two_five(axes.yaxis)


#: Ratio of the ends of a logarithmic axis on which 2 and 5 would leave no room between numbers.
MANY_DECADES = 3e3


def _one_two_five(axis: Axis) -> None:
    low, high = axis.get_view_interval()
    names = (1.0,) if high > MANY_DECADES * low > 0.0 else (1.0, 2.0, 5.0)
    axis.set_major_locator(LogLocator(subs=names))
    axis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axis.set_minor_formatter(NullFormatter())


def at_least(axes: Axes, span: float) -> None:
    """Widen the y axis to a span, so that rounding noise is not magnified to a signal."""
    low, high = axes.get_ylim()
    if high - low < span:
        middle = 0.5 * (low + high)
        axes.set_ylim(middle - 0.5 * span, middle + 0.5 * span)


def clipped(name: str, most: int) -> str:
    """A name of at most so many letters, of a longer one the beginning."""
    return name if len(name) <= most else f"{name[: most - 3]}..."


def line(axes: Axes, x: Array, y: Array, **options: Any) -> None:
    """A line; dots as well where there are too few points to see one."""
    axes.plot(x, y, marker="o" if np.size(x) < 3 else "", **options)


#: Letters of a panel's label that stand upright beside it; more stand above it, and of still more
#: the unit's name in a line of its own.
BESIDE, LONGEST_TITLE = 24, 42
#: Letters of a line below a figure; in an inch of a legend's row, a stroke counting as so many.
LONGEST_LINE, IN_AN_INCH, STROKE = 130, 14.5, 7
#: Most entries of a legend beside each other.
MOST_IN_A_ROW = 6


@styled
def draw_over_time(shown: TimeFigure) -> Figure:
    """Its panels; where a part is worth a look, that part enlarged beside each."""
    count, columns = len(shown.panels), 2 if shown.part else shown.columns
    rows = count if shown.part else -(-count // columns)
    figure = Figure(figsize=(11.0, 0.9 + shown.height * rows), layout="constrained")
    sharey = "row" if shown.part and not shown.own_scale else False
    look: Any = {"squeeze": False, "sharex": "col", "sharey": sharey}
    ratios = [1.6, 1.0] if shown.part else None
    axes = figure.subplots(max(rows, 1), columns, width_ratios=ratios, **look)
    for panel, row in zip(shown.panels, axes if shown.part else axes.reshape(-1, 1), strict=False):
        for ax in row:
            plain_ticks(ax)
            if panel.shaded:
                _shade(ax, shown.phases)
            draw_panel(ax, shown.time, panel)
        _set_limits(row, shown, panel)
        _label(row[0], panel.label, shown.columns > 1)
        if panel.thermometer:
            _thermometer(row[-1], *panel.thermometer)
    filled = axes.size if shown.part else count
    for place, ax in enumerate(axes.flat):
        ax.set_visible(place < filled)
        if place + columns >= filled:
            ax.set_xlabel("time [s]")
            ax.tick_params(labelbottom=True)
    _say_around(figure, axes, shown)
    return figure


def _say_around(figure: Figure, axes: NDArray[Any], shown: TimeFigure) -> None:
    """Title, words of marks and of the part, legend, note."""
    figure.align_ylabels(axes[:, 0])
    if shown.title:
        figure.suptitle(shown.title, x=0.008, ha="left", color=INK)
    if shown.part:
        axes[0, 1].set_title(shown.part[2])
    for time, words in shown.marks:
        above = ("data", "axes fraction")
        _beside(axes[0, 0], words, (time, 1.0), above, (0, 2), ha="center", va="bottom")
    handles = _curve_handles(shown.panels)
    if shown.phase:
        handles.append(Patch(facecolor=SLIP, edgecolor="none", label=shown.phase))
    if handles:
        place: Any = "outside upper right" if len(handles) < 3 else "outside lower center"
        legend(figure, handles, place)
    if shown.note:
        figure.supxlabel(textwrap.fill(shown.note, LONGEST_LINE), x=0.008, ha="left", fontsize=9)


def legend(figure: Figure, handles: Sequence[Artist], place: Any) -> None:
    """As many entries beside each other as the figure is wide for."""
    letters = [STROKE + len(str(handle.get_label())) for handle in handles]
    beside, most = min(len(handles), MOST_IN_A_ROW), IN_AN_INCH * figure.get_figwidth()
    while beside > 1 and sum(map(max, np.array_split(letters, beside))) > most:
        beside -= 1
    figure.legend(handles=handles, loc=place, ncols=beside)


def _beside(axes: Axes, words: str, at: Any, place: Any, points: Any, **look: Any) -> None:
    """Words so many points from a place."""
    aside = {"xytext": points, "textcoords": "offset points", "fontsize": 9}
    axes.annotate(words, at, xycoords=place, **aside, **look)


def _set_limits(row: Sequence[Axes], shown: TimeFigure, panel: Panel) -> None:
    """All time, with its marks, and the part, whose scale is its own where that is asked for."""
    ends = (shown.time[0], shown.time[-1]) if shown.time.size else (0.0, 0.0)
    margin = 0.0 if ends[1] > ends[0] else 0.5
    row[0].set_xlim(ends[0] - margin, ends[1] + margin)
    for time, _ in shown.marks:
        row[0].axvline(time, color=INK, linewidth=0.9, linestyle=":")
    if shown.part:
        row[1].set_xlim(*shown.part[:2])
        if shown.own_scale:
            _fit_to_part(row[1], shown.time, panel)


def _label(axes: Axes, label: str, above: bool) -> None:
    if above or len(label) > BESIDE:
        is_long = len(label) > LONGEST_TITLE
        axes.set_title(label.replace(".", ".\n", 1) if is_long else label, fontsize=9)
    else:
        axes.set_ylabel(label)


def _shade(axes: Axes, phases: Array) -> None:
    """Phases (k, 2) s as one collection behind the lines, over the full height."""
    begin, end = phases.T
    corners = np.stack([begin, end, end, begin], axis=1)
    heights = np.broadcast_to([0.0, 0.0, 1.0, 1.0], corners.shape)
    look: Any = {"facecolor": SLIP, "edgecolor": "none", "zorder": 0.1}
    # phases narrower than a pixel tint it by their share instead of all or nothing
    look |= {"snap": False, "transform": axes.get_xaxis_transform()}
    bars = PolyCollection(list(np.stack([corners, heights], axis=2)), **look)
    axes.add_collection(bars, autolim=False)


def _thermometer(axes: Axes, ambient: float, factor: float) -> None:
    """A second scale in degC beside an axis that shows the rise, factor times K."""
    right = axes.secondary_yaxis(
        "right",
        functions=(
            lambda rise: ambient + np.asarray(rise) / factor,
            lambda degC: (np.asarray(degC) - ambient) * factor,
        ),
    )
    _in_full(right.yaxis)
    right.set_ylabel("temperature [°C]")
    right.spines["right"].set_visible(True)


def picture_over_time(name: str, caption: str, alt: str, shown: TimeFigure) -> Picture:
    """A figure over time for a page, and as a drawing."""
    return Picture(name, caption, lambda: png(draw_over_time(shown)), alt, shown.live())


def draw_panel(axes: Axes, time: Array, panel: Panel) -> None:
    """The curves and levels of a panel over time (n,), s, to its scale."""
    if panel.map:
        _draw_map(axes, time, panel.map)
    below = np.zeros(time.size)
    for curve in panel.curves:
        if curve.fill:
            top = below + np.nan_to_num(curve.values) if panel.stacked else curve.values
            axes.fill_between(time, below, top, color=curve.colour, linewidth=0.0)
            below = top if panel.stacked else below
            continue
        values = panel.map.without_jumps(curve.values) if panel.map else curve.values
        look = {"color": curve.colour, "linewidth": curve.width}
        look |= {"linestyle": "--" if curve.dash else "-"}
        look |= {"drawstyle": "steps-pre" if curve.steps else "default"}
        line(axes, time, values, **look)
    at_least(axes, panel.span)
    _draw_levels(axes, panel.levels)
    if panel.logarithmic:
        axes.set_yscale("log")
    if panel.from_zero:
        axes.set_ylim(bottom=0.0)
    if panel.top is not None:
        axes.set_ylim(top=panel.top)


def _draw_map(axes: Axes, time: Array, shown: Map) -> None:
    places = np.linspace(0.0, shown.length, shown.values.shape[1] + 1)
    middles, (low, high) = 0.5 * (places[1:] + places[:-1]), shown.ends
    look: Any = {"shading": "nearest", "cmap": shown.colours, "vmin": low, "vmax": high}
    mesh = axes.pcolormesh(time, middles, shown.values.T, rasterized=True, **look)
    axes.figure.colorbar(mesh, ax=axes, label=f"{shown.label} [{shown.unit}]")
    axes.grid(visible=False)


def _draw_levels(axes: Axes, levels: Sequence[tuple[float, str]]) -> None:
    """Broken lines, named behind the right edge."""
    for height, text in levels:
        axes.axhline(height, color=GREY, linewidth=0.9, linestyle="--", zorder=1)
        behind = ("axes fraction", "data")
        _beside(axes, text, (1.0, height), behind, (3, 0), va="center", color=INK)


def _fit_to_part(axes: Axes, time: Array, panel: Panel) -> None:
    """The scale of an enlarged part from what is seen in it."""
    low, high = axes.get_xlim()
    seen = (time >= low) & (time <= high)
    values = np.concatenate([curve.values[seen] for curve in panel.curves])
    values = values[np.isfinite(values)]
    if values.size:
        bottom, top = float(values.min()), float(values.max())
        margin = max(0.05 * (top - bottom), 0.5 * panel.span, 1e-9 * abs(top)) or 0.5
        axes.set_ylim(0.0 if panel.from_zero else bottom - margin, top + margin)


def _curve_handles(shown: Sequence[Panel]) -> list[Artist]:
    """For a legend: curves by name, each once, of the panels that have several."""
    several = [curve for panel in shown if len(panel.curves) > 1 for curve in panel.curves]
    named = {curve.label: curve for curve in reversed(several)}
    return [_handle(curve) for curve in reversed(named.values())]


def _handle(curve: Curve) -> Artist:
    if curve.fill:
        return Patch(facecolor=curve.colour, label=curve.label)
    look: Any = {"color": curve.colour, "label": curve.label, "linewidth": curve.width}
    return Line2D([], [], dashes=(3, 2) if curve.dash else (1, 0), **look)
