"""Scenarios, campaigns and systems that nobody would write, for as long as one likes.

    python tests/benchmarks fuzz SECONDS [KIND ...] [--seed N]

KIND: simulate, run, gap, plan, sweep, couple (systems as TOML), ssp (default: all, in turn). `gap`
and `plan` go through to their answer, of a track or two of 3 s; --limit says when a case is given
up, which is then no fault. Each case runs in a child that is
killed after a time limit; what breaks is printed with the files that break it, which are kept under
fuzz-found. Exit status 0: nothing broke.
"""

import argparse
import multiprocessing
import random
import shutil
import sys
import tempfile
import time
import warnings
from pathlib import Path

import fuzzed
import fuzzed_systems
from hypothesis import HealthCheck, Phase, given, seed, settings

KINDS = ("simulate", "run", "gap", "plan", "sweep", "couple", "ssp")
#: s; none of the cases is large, and patience is short in all of them.
LIMIT = {"simulate": 90.0, "run": 90.0, "gap": 240.0, "plan": 240.0, "sweep": 90.0}
LIMIT |= {"couple": 60.0, "ssp": 60.0}
#: Part of the runs of which the figures are drawn too.
FIGURES = 0.15
#: Cases of a kind before it is the next one's turn.
BATCH = {"simulate": 40, "run": 20, "gap": 10, "plan": 5, "sweep": 20}
BATCH |= {"couple": 60, "ssp": 60}
FOUND = Path("fuzz-found")


def command(kind, case, folder):
    """Arguments of a case whose files are written to a folder; None for what no file can hold."""
    out = folder / "out"
    if kind in ("gap", "plan"):
        path = fuzzed.write_campaign(folder, *case)
        return path and [kind, path, "-o", out, "--no-page", "--jobs", "1"]
    if kind == "couple":
        path = fuzzed_systems.write_system(folder, case)
        return path and [kind, path, "-o", out]
    if kind == "ssp":
        text, changes = case
        path = fuzzed_systems.write_package(folder, text)
        return ["couple", path, *fuzzed_systems.settings_of(changes), "-o", out]
    text = fuzzed.toml(case)
    if text is None:
        return None
    path = folder / "case.toml"
    path.write_text(text, encoding="utf-8", errors="replace")
    if kind == "sweep":
        return [kind, path, "--vary", "rig.mass=0.5,1", "--jobs", "1", "-o", out]
    return [kind, path, "-o", out]


def strategy(kind):
    """What a kind of command is given."""
    if kind in ("gap", "plan"):
        return fuzzed.campaigns(planned=kind == "plan")
    if kind in ("couple", "ssp"):
        return fuzzed_systems.systems() if kind == "couple" else fuzzed_systems.packages()
    return fuzzed.scenarios()


def cases(kind, number, count):
    """So many cases of a kind."""
    drawn = []

    @seed(number)
    @settings(
        max_examples=count, database=None, deadline=None, phases=[Phase.generate],
        suppress_health_check=list(HealthCheck),
    )  # fmt: skip
    @given(strategy(kind))
    def draw(case):
        drawn.append(case)

    draw()
    return drawn


def child(line):
    """Answer cases until there are no more."""
    warnings.simplefilter("ignore")
    fuzzed.called("simulate", "none.toml")  # what is imported, and compiled, counts for no case
    fuzzed_systems.made()
    line.send("ready")
    while True:
        kind, case, folder = line.recv()
        argv = command(kind, case, Path(folder))
        if argv is None:
            line.send((None, ""))
            continue
        said = fuzzed.called(*argv, figures=random.random() < FIGURES)
        line.send((said[0], (fuzzed.fault_of(*said, Path(folder) / "out"), said[2])))


class Child:
    """A process that answers cases, and another one after it was killed."""

    def __init__(self):
        self.process = None

    def start(self):
        """Have one that listens."""
        if self.process is None or not self.process.is_alive():
            self.line, theirs = multiprocessing.Pipe()
            self.process = multiprocessing.get_context("spawn").Process(
                target=child, args=(theirs,), daemon=False
            )
            self.process.start()
            theirs.close()
            self.line.recv()

    def answer(self, kind, case, folder, limit=None):
        """(status, (fault, what was printed)); limit: s, after which a case is given up."""
        self.start()
        self.line.send((kind, case, str(folder)))
        if not self.line.poll(limit or LIMIT[kind]):
            self.stop()
            if limit:
                return "given up", None
            return None, (f"no end in {LIMIT[kind]:g} s", "")
        try:
            return self.line.recv()
        except EOFError:
            self.stop()
            return None, ("the process died", "")

    def stop(self):
        """End it."""
        self.process.kill()
        self.process.join()


def main():
    """Fuzz; the exit status."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("seconds", type=float)
    parser.add_argument("kinds", nargs="*", default=KINDS)
    parser.add_argument("--seed", type=int, default=None)
    parser.add_argument("--limit", type=float, default=None, help="s of a case")
    arguments = parser.parse_args()
    first = random.randrange(10**6) if arguments.seed is None else arguments.seed
    end, answers, broken = time.monotonic() + arguments.seconds, {}, 0
    one, place = Child(), Path(tempfile.mkdtemp())
    number = first
    while time.monotonic() < end:
        for kind in arguments.kinds:
            for at, case in enumerate(cases(kind, number, BATCH[kind])):
                if time.monotonic() > end:
                    break
                folder = fuzzed.fresh(place / kind)
                folder.mkdir(parents=True)
                status, answer = one.answer(kind, case, folder, arguments.limit)
                fault, said = answer or (None, "")
                answers[kind, status] = answers.get((kind, status), 0) + 1
                if fault:
                    broken += 1
                    kept = FOUND / f"{kind}-{number}-{at}"
                    shutil.copytree(folder, kept, dirs_exist_ok=True)
                    print(f"{kept}: {fault}\n    {said.strip()[:300]}", flush=True)
        number += 1
    if one.process is not None:
        one.stop()
    shutil.rmtree(place, ignore_errors=True)
    told = ", ".join(f"{k} {s}: {n}" for (k, s), n in sorted(answers.items(), key=str))
    print(f"seeds from {first}; {told}; {broken} broke")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
