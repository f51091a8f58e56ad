"""The scores of the hidden campaigns as one figure."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import matplotlib
import numpy as np
from blind import score
from blind.score import large, of_kind
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cosim.report.page import DPI
from cosim.report.style import BLUE, GREEN, GREY, INK, ORANGE, RC, RED

#: Campaigns from which a share has an interval that says anything.
FEW = 4
KIND_COLOURS = {"effects": BLUE, "unknown": RED, "two": GREEN, "none": GREY}


def draw_confusion(axes: Axes, rows: Sequence[dict]) -> None:
    """Hidden against answered, counts in the cells, shade by the share of the row."""
    single = of_kind(rows, "none") + large(of_kind(rows, "effects") + of_kind(rows, "unknown"))
    labels, columns, counts = score.confusion(single)
    answered = counts.any(axis=0)  # what nobody answered takes no place
    columns = [name for name, some in zip(columns, answered, strict=True) if some]
    counts = counts[:, answered]
    totals = np.maximum(counts.sum(axis=1, keepdims=True), 1)
    axes.imshow(counts / totals, cmap="Blues", vmin=0, vmax=1, aspect="auto")
    for i, j in zip(*np.nonzero(counts), strict=True):
        dark = counts[i, j] > 0.55 * totals[i, 0]
        axes.text(
            j, i, counts[i, j], ha="center", va="center", color="white" if dark else INK, size=7.5
        )
    words = [name.replace("_", " ") for name in columns]
    axes.set_xticks(range(len(columns)), words, rotation=50, ha="right", rotation_mode="anchor")
    axes.set_yticks(range(len(labels)), [name.replace("_", " ") for name in labels])
    axes.grid(False)
    axes.set_xlim(-0.5, max(len(columns), 1) - 0.5)
    axes.set_xlabel("answered")
    axes.set_ylabel("hidden")
    axes.set_title(
        "campaigns by what was hidden (≥ 5 noise units, or nothing) and what was answered"
    )


def draw_shares(axes: Axes, rows: Sequence[dict]) -> None:
    """Right answers against the size of what is hidden, each with how many of how many.

    From `FEW` campaigns on with a 95 % interval: that of one or two is nearly all there is.
    """
    series = (
        ("effects", "right name or class", BLUE, score.is_right),
        ("effects", "right name alone", ORANGE, score.is_exact),
        ("unknown", "law unknown: unknown", RED, lambda row: score.verdict_of(row) == "unknown"),
        (
            "two",
            "two effects: both",
            GREEN,
            lambda row: set(row["truth"]["hidden"]) <= score.named(row),
        ),
    )
    names = [name for name, _ in score.by_size([r for r in rows if r["truth"]["hidden"]], bool)]
    for k, (kind, label, colour, holds) in enumerate(series):
        shares = dict(score.by_size(of_kind(rows, kind), holds))
        at = [i + 0.2 * (k - 1.5) for i, name in enumerate(names) if name in shares]
        kept = [shares[name] for name in names if name in shares]
        bounds = np.array([[s.value - s.interval[0], s.interval[1] - s.value] for s in kept])
        if kept:
            heights = [100 * s.value for s in kept]
            axes.plot(at, heights, "o", color=colour, label=label)
            many = [i for i, s in enumerate(kept) if s.total >= FEW]
            if many:
                axes.errorbar(
                    [at[i] for i in many], [heights[i] for i in many],
                    100 * np.maximum(bounds[many].T, 0),
                    fmt="none", capsize=2, color=colour, elinewidth=1.0,
                )  # fmt: skip
            for place, height, s in zip(at, heights, kept, strict=True):
                axes.annotate(
                    f"{s.hits}/{s.total}", (place, height), (3.5, 4.0), fontsize=6.5, rotation=60,
                    textcoords="offset points", color=colour,
                )  # fmt: skip
    axes.axhline(95, color=GREY, lw=0.8, ls="--")
    axes.set_xticks(range(len(names)), names)
    axes.set_ylim(-3, 116)
    axes.set_xlim(-0.5, len(names) - 0.3)
    axes.set_xlabel("size of what is hidden / noise")
    axes.set_ylabel("campaigns answered right / %")
    axes.set_title("answers against size (bars: 95 % intervals)")
    if axes.get_legend_handles_labels()[0]:
        _legend_below(axes)


def draw_gaps(axes: Axes, rows: Sequence[dict]) -> None:
    """Held-out gap before and after the effect is added, for right answers."""
    for kind, marker in (("effects", "o"), ("two", "s")):
        right = [row for row in of_kind(rows, kind) if score.is_right(row)]
        before = [score.gap(row, "before") for row in right]
        after = [score.gap(row, "after") for row in right]
        if right:
            name = "one effect" if kind == "effects" else "two effects"
            axes.plot(before, after, marker, color=KIND_COLOURS[kind], label=name, alpha=0.7)
    finite = [v for row in rows for v in (score.gap(row, "before"), score.gap(row, "after"))]
    top = 1.3 * max([v for v in finite if np.isfinite(v)], default=10.0)
    axes.plot([0.5, top], [0.5, top], color=GREY, lw=0.8, label="no better")
    axes.axhline(score.SMALL_GAP, color=RED, lw=0.8, ls="--", label="1.5 noise units")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("held-out gap before / noise")
    axes.set_ylabel("held-out gap after / noise")
    axes.set_title("gap of the right answers")
    _legend_below(axes)


def _legend_below(axes: Axes) -> None:
    """Under the panel, where it covers no point."""
    axes.legend(
        loc="upper center", bbox_to_anchor=(0.5, -0.17), ncols=2, frameon=False, fontsize=8.0
    )


def score_figure(rows: Sequence[dict], file: Path) -> None:
    """Write the three panels as a PNG."""
    with matplotlib.rc_context(RC):
        figure = Figure(figsize=(13.5, 8.2), layout="constrained")
        grid = figure.add_gridspec(2, 2, width_ratios=(1.55, 1))
        draw_confusion(figure.add_subplot(grid[:, 0]), rows)
        draw_shares(figure.add_subplot(grid[0, 1]), rows)
        draw_gaps(figure.add_subplot(grid[1, 1]), rows)
        figure.savefig(file, dpi=DPI)
