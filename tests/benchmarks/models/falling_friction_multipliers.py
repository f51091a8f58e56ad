"""Multipliers of motions whose friction falls with speed, against disturbed runs.

    python tests/benchmarks falling_friction_multipliers [RIGS] [SEED] [--json FILE]

Draws rigs at random, disturbs each by 1e-6, 1e-5 and 1e-4 rad, and counts those of which all three
runs do what the multipliers say, those that are not judged (the motion grazes), and those that are
wrong, which are printed. Rigs within 2 % of the border are drawn anew.
"""

import numpy as np
from baseline import Figure, arguments, write
from falling_friction import agrees, compared, drawn_rig


def main():
    told = arguments(__doc__, rigs=40, seed=0).parse_args()
    draw = np.random.default_rng(told.seed)
    right = grazing = wrong = unstable = 0
    while right + grazing + wrong < told.rigs:
        parameters = drawn_rig(draw)
        answer = compared(parameters)
        if answer is None:
            continue
        found, grown = answer
        unstable += found.verdict == "unstable"
        if grown is None:
            grazing += 1
        elif agrees(found, grown):
            right += 1
        else:
            wrong += 1
            print(found.verdict, found.growth, found.others, grown, repr(parameters))
    print(
        f"{told.rigs} rigs, {unstable} of them unstable: {right} right, {wrong} wrong, "
        f"{grazing} not judged, as they graze"
    )
    write(
        told.json,
        "falling_friction_multipliers",
        {"wrong": Figure(float(wrong)), "not judged": Figure(float(grazing))},
    )


if __name__ == "__main__":
    main()
