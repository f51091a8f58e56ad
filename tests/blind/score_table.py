"""The scores in words: Markdown with one line a figure."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from . import score
from .score import Share, large, of_kind, share


def line(what: str, value: object, wanted: str) -> str:
    """One line of the table."""
    return f"| {what} | {value} | {wanted} |"


def quantiles(values: Sequence[float]) -> str:
    """Median and 90 % quantile of the finite ones."""
    finite = np.array([value for value in values if np.isfinite(value)])
    if not finite.size:
        return "none"
    return f"median {np.median(finite):.2f}, 90 % below {np.quantile(finite, 0.9):.2f}"


def verdict_lines(rows: Sequence[dict]) -> list[str]:
    """What the product is judged by."""
    single, none = large(of_kind(rows, "effects")), of_kind(rows, "none")
    out_of_catalogue, two = large(of_kind(rows, "unknown")), large(of_kind(rows, "two"))
    lone = of_kind(rows, "single_speed")
    return [
        line("one effect ≥ 5 units: it or its class", share(single, score.is_right), "≥ 95 %"),
        line("… named alone (top-1)", share(single, score.is_exact), ""),
        line("… as a class that holds it", share(single, score.is_in_class), ""),
        line(
            "effect-free: false positives",
            share(none, lambda row: score.verdict_of(row) != "none"),
            "≤ 5 %",
        ),
        line("… a name given", share(none, lambda row: bool(score.named(row))), ""),
        line(
            "out of the catalogue ≥ 5 units: `unknown`",
            share(out_of_catalogue, lambda row: score.verdict_of(row) == "unknown"),
            "≥ 90 %",
        ),
        line(
            "… a wrong name given", share(out_of_catalogue, lambda row: bool(score.named(row))), ""
        ),
        line(
            "two effects, each ≥ 5 units: both",
            share(two, lambda row: set(row["truth"]["hidden"]) <= score.named(row)),
            "≥ 80 %",
        ),
        line("… both and nothing else", share(two, score.is_exact), ""),
        line("single speed: a class that holds it", share(lone, score.is_in_class), "all"),
        line(
            "… the next experiment separates the class",
            share(
                [row for row in lone if "separation" in row],
                lambda row: row["separation"] >= score.LARGE,
            ),
            "all",
        ),
    ]


def gap_lines(rows: Sequence[dict]) -> list[str]:
    """Gaps on held-out runs, and time."""
    right = [row for row in large(of_kind(rows, "effects")) if score.is_right(row)]
    wide = [row for row in right if score.gap(row, "before") >= score.LARGE]
    seconds = [row["seconds"] for row in rows]
    failed = Share(sum(row["found"] is None for row in rows), len(rows))
    return [
        line(
            "held-out gap before, right ones",
            quantiles([score.gap(r, "before") for r in right]),
            "",
        ),
        line(
            "held-out gap after, right ones", quantiles([score.gap(r, "after") for r in right]), ""
        ),
        line("… ≤ 1.5 after, from ≥ 5 before", share(wide, score.closes_gap), "all"),
        line("seconds a campaign", f"{quantiles(seconds)}, longest {max(seconds):.1f}", "≤ 30"),
        line("no answer (error or time-out)", failed, "0"),
    ]


def abstention_lines(rows: Sequence[dict]) -> list[str]:
    """How far `unknown` can be believed."""
    said = [row for row in rows if score.verdict_of(row) == "unknown"]
    out_of_catalogue = large(of_kind(rows, "unknown"))

    def is_strange(row: dict) -> bool:
        return row["truth"]["kind"] == "unknown"

    return [
        line("`unknown` said rightly (precision)", share(said, is_strange), ""),
        line(
            "`unknown` where due (recall)",
            share(out_of_catalogue, lambda row: score.verdict_of(row) == "unknown"),
            "",
        ),
    ]


def size_lines(rows: Sequence[dict]) -> list[str]:
    """The same against the size of what is hidden."""
    lines = [
        "",
        "| size, noise units | right name or class | `unknown` out of catalogue | both of two |",
    ]
    lines += ["|---|---|---|---|"]
    found = [
        dict(score.by_size(of_kind(rows, "effects"), score.is_right)),
        dict(
            score.by_size(of_kind(rows, "unknown"), lambda row: score.verdict_of(row) == "unknown")
        ),
        dict(
            score.by_size(
                of_kind(rows, "two"),
                lambda row: set(row["truth"]["hidden"]) <= score.named(row),
            )
        ),
    ]
    names = [name for name, _ in score.by_size(rows, lambda row: True)]
    return lines + [
        f"| {name} | " + " | ".join(str(each.get(name, "–")) for each in found) + " |"
        for name in names
    ]


def effect_lines(rows: Sequence[dict]) -> list[str]:
    """Each hidden thing by itself, with its most frequent wrong answer."""
    lines = ["", "| hidden, ≥ 5 units | right | most frequent wrong answer |", "|---|---|---|"]
    for kind in ("effects", "unknown"):
        group = large(of_kind(rows, kind))
        for name in sorted({score.hidden_row(row) for row in group}):
            mine = [row for row in group if score.hidden_row(row) == name]

            def right(row: dict, kind: str = kind) -> bool:
                return score.is_right(row) if kind == "effects" else score.verdict_of(row) == kind

            wrong = [score.answer_column(row) for row in mine if not right(row)]
            most = max(sorted(set(wrong)), key=wrong.count) if wrong else "–"
            lines.append(line(name, share(mine, right), most))
    return lines


def markdown(rows: Sequence[dict], seed: int) -> str:
    """The whole table; rows are all campaigns with an answer."""
    head = [f"{len(rows)} hidden campaigns, seed {seed}.", "", "| what | measured | wanted |"]
    head.append("|---|---|---|")
    body = verdict_lines(rows) + abstention_lines(rows) + gap_lines(rows)
    return "\n".join(head + body + size_lines(rows) + effect_lines(rows)) + "\n"
