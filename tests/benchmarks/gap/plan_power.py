"""Power that `stickslip plan` predicts, and what `gap` names of simulated campaigns, side by side.

    python tests/benchmarks plan_power [CAMPAIGN] [--effects NAME ...] [--campaigns N] [--seed N]

Each effect is put into the planned campaign, which the kernel then makes, at the size that is
planned to be named in 80 of 100; springs, speeds, zeros and friction are off within their errors,
and `gap` names what it finds. Beside the share stand its 90 % interval (Clopper and Pearson) and
the power that is predicted for that size, by itself or in a class.
"""

import argparse
import time
from pathlib import Path
from tempfile import TemporaryDirectory

import tomli_w
from plan_campaigns import made, named
from scipy.stats import binomtest

from cosim.gap.plan import make_plan, read_plan

EFFECTS = (
    "film_drag", "velocity_weakening", "run_in", "spring_hardening", "static_strengthening",
)  # fmt: skip
#: Two masses and three speeds: a campaign that can tell all of these from nothing.
PLAN = {
    "name": "two masses", "rig": {"spring_natural_length": 0.17}, "noise": {"x": 2e-4},
    "friction": {"mu_s": 0.3, "mu_k": 0.22},
    "run": [
        {"mass": mass, "stiffness": 38.5, "surface_speed": speed, "duration": 12.0, "rate": 100.0}
        for mass in (0.5, 1.2) for speed in (0.03, 0.08, 0.2)
    ],
}  # fmt: skip


def planned_of(path):
    if path:
        return read_plan(path)
    with TemporaryDirectory() as folder:
        (Path(folder) / "campaign.toml").write_text(tomli_w.dumps(PLAN), encoding="utf-8")
        return read_plan(folder)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("campaign", nargs="?")
    parser.add_argument("--effects", nargs="*", default=EFFECTS)
    parser.add_argument("--campaigns", type=int, default=20)
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    planned = planned_of(given.campaign)
    first = {}
    for size in make_plan(planned).sizes:
        first.setdefault(size.law.argument, size)
    print(f"{'effect':22}{'size':>10}  {'predicted':>9}  achieved (90 %)")
    for effect in given.effects:
        size = first.get(effect)
        if size is None or size.value is None:
            print(f"{effect:22}{'not seen':>10}")
            continue
        begun, seeds = time.process_time(), range(given.seed, given.seed + given.campaigns)
        blocks = size.law.blocks(size.value)
        found = [named(made(planned, blocks, seed)) for seed in seeds]
        seconds = (time.process_time() - begun) / given.campaigns
        times = sum(any(effect in group for group in one) for one in found)
        test = binomtest(times, given.campaigns)
        low, high = test.proportion_ci(0.9)
        print(
            f"{effect:22}{size.value:10.4g}  {size.power:9.2f}  {test.statistic:8.2f} "
            f"({low:.2f} to {high:.2f})  {seconds:.1f} s each",
            flush=True,
        )


if __name__ == "__main__":
    main()
