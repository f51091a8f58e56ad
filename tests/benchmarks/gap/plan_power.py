"""Power that `stickslip plan` predicts, and what `gap` names of simulated campaigns, side by side.

    python tests/benchmarks plan_power [CAMPAIGN] [--effects NAME ...] [--campaigns N] [--seed N]

Each effect is put into the planned campaign, which the kernel then makes, at the size that is
planned to be named in 80 of 100; springs, speeds, zeros and friction are off within their errors,
and `gap` names what it finds. Beside the share stand its 90 % interval (Clopper and Pearson) and
the power that is predicted for that size, by itself or in a class, and by itself alone.
"""

import argparse
import time
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import tomli_w
from plan_campaigns import blocks_of, made, named
from scipy.stats import binomtest

from cosim.gap.plan.laws import laws_of
from cosim.gap.plan.plan import WANTED
from cosim.gap.plan.planned import as_measured, asked_of, read_plan
from cosim.gap.plan.sizes import Design, is_alone, is_named, sizes_of

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
    asked = asked_of(as_measured(planned))
    first = {}
    for law in laws_of(*asked):
        first.setdefault(law.argument, law)
    laws = [first[effect] for effect in given.effects if effect in first]
    scatter = planned.campaign.errors.friction
    sizes = sizes_of(Design(*asked, laws, scatter), WANTED, lambda: None)
    again = Design(*asked, laws, scatter, draws=400, seed=1)
    print(f"{'effect':22}{'size':>10}  {'predicted':>9}  achieved (90 %)       alone, and achieved")
    for number, size in enumerate(sizes):
        law = size.law
        if size.value is None:
            print(f"{law.argument:22}{'not seen':>10}")
            continue
        offers = again.offers([number], [abs(size.value - law.neutral)])[0]
        begun, seeds = time.process_time(), range(given.seed, given.seed + given.campaigns)
        found = [named(made(planned, blocks_of(law, size.value), seed)) for seed in seeds]
        seconds = (time.process_time() - begun) / given.campaigns
        seen = binomtest(sum(any(law.argument in group for group in one) for one in found),
                         given.campaigns)  # fmt: skip
        low, high = seen.proportion_ci(0.9)
        alone = np.mean([{law.argument} in one for one in found])
        print(
            f"{law.argument:22}{size.value:10.4g}  {np.mean(is_named(law, offers)):9.2f}  "
            f"{seen.statistic:8.2f} ({low:.2f} to {high:.2f})"
            f"  {np.mean(is_alone(law, offers)):5.2f} {alone:5.2f}  {seconds:.1f} s each",
            flush=True,
        )


if __name__ == "__main__":
    main()
