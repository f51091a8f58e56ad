"""Two baselines of a benchmark: what got worse by more than a margin.

    python tests/benchmarks mechanics --json old.json
    git switch -; python tests/benchmarks mechanics --json new.json
    python tests/benchmarks compare old.json new.json --margin 0.2

Exit status 1 where something got worse or is no longer there. Seconds of two machines, or of one
that has other work, say little: ratios to a peer that was timed in the same run say more.
"""

import argparse
import sys
from pathlib import Path

import numpy as np
import pandas as pd
from baseline import read

#: Medians of a few repetitions on a machine without other work differ by less.
MARGIN = 0.2


def compared(old: dict, new: dict) -> pd.DataFrame:
    """Every figure of the old one: old, new, unit, and the part by which it is worse.

    Worse without end is what is gone, or has left 0.
    """
    before, after = (pd.DataFrame.from_dict(each, orient="index") for each in (old, new))
    table = before.assign(new=after["value"].reindex(before.index)).rename(columns={"value": "old"})
    less = table["better"] == "less"
    worse, better = (table["new"].where(way, table["old"]) for way in (less, ~less))
    with np.errstate(divide="ignore", invalid="ignore"):
        part = np.where(worse == better, 0.0, worse / better - 1.0)
    table["worse by"] = np.where(table["new"].isna(), np.inf, part)
    return table[["old", "new", "unit", "worse by"]]


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("old", type=Path)
    parser.add_argument("new", type=Path)
    parser.add_argument("--margin", type=float, default=MARGIN, help="part (default: %(default)s)")
    told = parser.parse_args()
    (about_old, old), (about_new, new) = read(told.old), read(told.new)
    if about_old["benchmark"] != about_new["benchmark"]:
        parser.error(f"{about_old['benchmark']} and {about_new['benchmark']} are not comparable")
    if about_old["machine"] != about_new["machine"]:
        print(f"on different machines: {about_old['machine']} and {about_new['machine']}")
    table = compared(old, new)
    print(table.to_string(float_format="{:.4g}".format))
    worse = table[table["worse by"] > told.margin]
    if len(worse):
        print(f"worse by more than {told.margin:.0%}, or gone:", *worse.index, sep="\n  ")
    return int(len(worse) > 0)


if __name__ == "__main__":
    sys.exit(main())
