"""Two baselines of a benchmark: what got worse by more than a margin.

    python tests/benchmarks mechanics --json old.json
    git switch -; python tests/benchmarks mechanics --json new.json
    python tests/benchmarks compare old.json new.json --margin 0.2

Exit status 1 where something got worse or is no longer there. Seconds of two machines, or of one
that has other work, say little: ratios to a peer that was timed in the same run say more.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from baseline import Figure, read

#: Medians of a few repetitions on a machine without other work differ by less.
MARGIN = 0.2


def change(old: Figure, new: Figure) -> float:
    """Part by which a figure is worse; negative: better."""
    worse, better = (new, old) if old.better == "less" else (old, new)
    if worse.value == better.value:
        return 0.0
    if better.value <= 0.0 or worse.value <= 0.0:
        return float("inf") if worse.value > better.value else -1.0
    return worse.value / better.value - 1.0


def compared(
    old: dict[str, Figure], new: dict[str, Figure], margin: float
) -> tuple[list[str], list[str]]:
    """A line for every figure that both have, and those that got worse or are gone."""
    lines, worse = [], []
    for name, before in old.items():
        if name not in new:
            worse.append(f"{name}: no longer there")
            continue
        after, by = new[name], change(before, new[name])
        lines.append(f"{name:<44}{before.value:12.4g}{after.value:12.4g} {after.unit:<8}{by:+8.0%}")
        if by > margin:
            worse.append(f"{name}: {before.value:.4g} -> {after.value:.4g} {after.unit}")
    return lines, worse


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("old", type=Path)
    parser.add_argument("new", type=Path)
    parser.add_argument("--margin", type=float, default=MARGIN, help="part (default: %(default)s)")
    told = parser.parse_args(arguments)
    (about_old, old), (about_new, new) = read(told.old), read(told.new)
    if about_old["benchmark"] != about_new["benchmark"]:
        parser.error(f"{about_old['benchmark']} and {about_new['benchmark']} are not comparable")
    if about_old["machine"] != about_new["machine"]:
        print(f"on different machines: {about_old['machine']} and {about_new['machine']}")
    lines, worse = compared(old, new, told.margin)
    print(f"{'':<44}{'old':>12}{'new':>12} {'':<8}{'worse by':>8}", *lines, sep="\n")
    if worse:
        print(f"worse by more than {told.margin:.0%}:", *worse, sep="\n  ")
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main())
