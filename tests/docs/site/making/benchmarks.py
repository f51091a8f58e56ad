"""What the benchmarks measured last, from the baselines that they are compared with."""

import json
import os
from pathlib import Path

from matplotlib.figure import Figure

from .markdown import heading, table

BASELINES = Path(os.environ["STICKSLIP_CHECKOUT"]) / "tests" / "benchmarks" / "baselines"
COST = "coupling_cost"
#: As they are written on a page.
UNITS = {"1": "", "us": "µs"}
#: Of the figures of `coupling_cost`: what is on the two axes.
STEPS, ERROR = "steps made", "mechanics.x"


def text() -> str:
    """A table for each benchmark with its command; that of the schemes is a figure."""
    return "".join(_section(file) for file in sorted(BASELINES.glob("*.json")) if file.stem != COST)


def _section(file: Path) -> str:
    found = json.loads(file.read_text(encoding="utf-8"))
    machine = ", ".join(f"{key} {value}" for key, value in found["machine"].items())
    rows = (
        (name, f"{entry['value']:.4g} {UNITS.get(entry['unit'], entry['unit'])}")
        for name, entry in found["figures"].items()
    )
    return (
        heading(3, file.stem.replace("_", " "))
        + f"`python tests/benchmarks {file.stem}` ({machine})\n\n"
        + table(("figure", "measured"), rows)
    )


def draw_cost(path: Path) -> None:
    """Error of the block's place over the steps made, a line a scheme."""
    figures = json.loads((BASELINES / f"{COST}.json").read_text(encoding="utf-8"))["figures"]
    lines: dict[str, list[tuple[float, float]]] = {}
    for name, entry in figures.items():
        case, _, what = name.partition(": ")
        if what == STEPS and f"{case}: {ERROR}" in figures:
            point = entry["value"], figures[f"{case}: {ERROR}"]["value"]
            lines.setdefault(case.rpartition(", ")[0], []).append(point)
    figure = Figure(figsize=(9.0, 4.2), layout="constrained")
    axes = figure.subplots()
    for number, (scheme, points) in enumerate(lines.items()):
        marker = "osv^Dx+*<>"[number % 10]
        axes.loglog(*zip(*sorted(points), strict=True), marker=marker, ms=4, lw=1, label=scheme)
    axes.set(xlabel="steps of the heat model, repeated ones included", ylabel="error of x [m]")
    axes.grid(True, which="major", lw=0.5, color="#D9D9D9")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=8, frameon=False)
    figure.savefig(path, metadata={"Date": None}, facecolor="white")
