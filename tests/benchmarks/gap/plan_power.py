"""Power that `stickslip plan` predicts, and what simulated campaigns achieve, side by side.

    python tests/benchmarks plan_power CAMPAIGN [EFFECT ...] [--campaigns N] [--seed N]

Each effect is put into the planned campaign at half its predicted size, at that size and at one and
a half times it, noise is added, the plain model and the law are fitted, and the law counts as named
where it takes away more than the threshold. Beside the share stand its 90 % interval (Clopper and
Pearson) and the power that is predicted for that size. Without effect: the share of campaigns in
which the law is named although it is not there, and the level of its single test.
"""

import argparse

from plan_campaigns import gain, measured
from scipy.stats import binomtest

from cosim.gap.plan.law import kinds, laws_of
from cosim.gap.plan.planned import read_plan, rehearse_plan
from cosim.gap.plan.power import LEVEL, WANTED, needed, power, threshold
from cosim.gap.plan.visibility import friction_length, refitted, smallest
from cosim.processes import processes

PARTS = (0.0, 0.5, 1.0, 1.5)


def one_gain(plan, rehearsal, law, part, seed):
    return gain(measured(plan, rehearsal, law, part, seed), rehearsal, plan.planar, law)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("campaign")
    parser.add_argument("effects", nargs="*")
    parser.add_argument("--campaigns", type=int, default=40)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=2)
    given = parser.parse_args()
    plan = read_plan(given.campaign)
    rehearsal = rehearse_plan(plan)
    laws, _ = laws_of(plan, rehearsal)
    count, runs = kinds(laws), len(rehearsal.runs)
    per_cent = friction_length(rehearsal)
    first = {}
    for law in laws:
        first.setdefault(law.effect, law)
    print(f"{'effect':22}{'size':>10}{'predicted':>11}{'achieved':>10}  90 % interval")
    with processes(given.jobs) as mapped:
        for effect, law in first.items():
            if given.effects and effect not in given.effects:
                continue
            rule = (LEVEL, count * law.periods, law.freedoms(runs))
            seen = smallest(rehearsal, law, needed(WANTED, *rule), per_cent)
            if not seen.is_seen:
                print(f"{effect:22}{'not seen':>10}")
                continue
            limit = threshold(*rule)
            for times in PARTS:
                part = times * seen.part
                noncentrality = refitted(rehearsal, law, part)[0] if times else 0.0
                seeds = range(given.seed, given.seed + given.campaigns)
                gains = list(
                    mapped(one_gain, [(plan, rehearsal, law, part, seed) for seed in seeds])
                )
                test = binomtest(sum(each > limit for each in gains), len(gains))
                low, high = test.proportion_ci(0.9)
                predicted = power(noncentrality, *rule)
                print(
                    f"{effect:22}{law.value(part):10.4g}{predicted:11.3f}"
                    f"{test.statistic:10.3f}  {low:.2f} to {high:.2f}",
                    flush=True,
                )


if __name__ == "__main__":
    main()
