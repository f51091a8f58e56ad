"""The border of stability over pretension, against runs on either side of it.

    python tests/benchmarks stability_border [RIGS] [SEED] [--json FILE]

Draws rigs at random, looks for the least pretension at which each keeps to its line, and simulates
the rig, turned by 1e-7 rad at its start, with 5 % and 0.1 mm less and more. Rigs that need none, or
are unstable again so near above the border, or swerve in their speed ramp already, are drawn anew.
Prints those on the wrong side, and how many are on the right one.
"""

import sys
from pathlib import Path

import numpy as np
from baseline import Figure, arguments, write
from stickslip.steady_motion import pretension_borders, stability, with_pretension

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "verification" / "reference"))
from test_stability import DURATION, drawn_rig, grows

RELATIVE, ABSOLUTE = 0.05, 1e-4


def sides(parameters):
    """(least, margin) m, and whether runs below and above it grow; None where none is to be had."""
    borders = pretension_borders(parameters, DURATION)
    if not borders.least:
        return None
    margin = RELATIVE * borders.least + ABSOLUTE
    if borders.least <= margin or any(
        low < borders.least + 2.0 * margin for low, _ in borders.further
    ):
        return None
    below, above = (with_pretension(parameters, borders.least + side * margin) for side in (-1, 1))
    # a run that has swerved in its speed ramp says nothing of the line at constant speed
    if stability(above, DURATION).amplification > 1e3:
        return None
    return borders.least, margin, grows(below), grows(above)


def main():
    parser = arguments(__doc__)
    parser.add_argument("rigs", type=int, nargs="?", default=50)
    parser.add_argument("seed", type=int, nargs="?", default=1)
    told = parser.parse_args()
    draw, asked, right, drawn = np.random.default_rng(told.seed), 0, 0, 0
    while asked < told.rigs:
        parameters = drawn_rig(draw, drawn)
        drawn += 1
        found = sides(parameters)
        if found is None:
            continue
        asked += 1
        least, margin, below, above = found
        if below and not above:
            right += 1
        else:
            print(
                f"{1e3 * least:.2f} mm +- {1e3 * margin:.2f}: grows below {below}, "
                f"above {above}; {parameters!r}"
            )
    print(
        f"{right} of {asked} rigs on the right side, margin {100 * RELATIVE:g} % and "
        f"{1e3 * ABSOLUTE:g} mm; {drawn} drawn"
    )
    write(
        told.json, "stability_border", {"on the right side": Figure(right / asked, better="more")}
    )


if __name__ == "__main__":
    main()
