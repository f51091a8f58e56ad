"""The search for regimes, against a search by force from 30 starts of 600 s each.

    python tests/benchmarks regimes_by_force [RIGS] [SEED] [--json FILE]

Draws rigs at random and counts regimes that the search misses, and those that it names and the 30
starts never come to: a few are real, where a regime is reached from few starts; each is printed.
"""

import time

import numpy as np
from baseline import Figure, arguments, write
from brute_regimes import by_force, drawn_rig, missed, searched
from stickslip.steady_motion import regimes


def main():
    told = arguments(__doc__, rigs=200, seed=0).parse_args()
    lost = invented = several = 0
    seconds = []
    for i in range(told.rigs):
        draw = np.random.default_rng([told.seed, i])
        parameters = drawn_rig(draw)
        begun = time.process_time()
        found = regimes(parameters)
        seconds.append(time.process_time() - begun)
        ours, (theirs, runs) = searched(found), by_force(parameters, draw)
        lost_here, only_here = missed(theirs, ours), missed(ours, runs)
        several += len(theirs) > 1
        for what, ones in (("missed", lost_here), ("only ours", only_here)):
            for one in ones:
                print(f"rig {i}, {what}: {one}")
        lost, invented = lost + len(lost_here), invented + len(only_here)
    print(
        f"{told.rigs} rigs, {several} with several regimes: {lost} missed, {invented} only ours; "
        f"the search takes {np.median(seconds):.2f} s, at most {max(seconds):.1f} s"
    )
    write(
        told.json,
        "regimes_by_force",
        {"missed": Figure(float(lost)), "only ours": Figure(float(invented))},
    )


if __name__ == "__main__":
    main()
