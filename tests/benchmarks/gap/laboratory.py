"""Campaigns of the laboratory, with known answers, put to `find_gap` and scored.

    python tests/benchmarks laboratory contact_and_shapes nothing --seed 7 --out results/lab
    python tests/benchmarks laboratory faults --seed 7 --first 10 --out results/lab --resume
    python tests/benchmarks laboratory --campaigns FOLDER --answers answers.json --out results/x

Each campaign is made and answered in one process, on one core, and written as a line of
campaigns.jsonl as it ends; --resume does what is missing. Then scores.md (tables), wrong.md (every
answer that is not right) and calibration.png are written. --count is the size of a suite, whose
orders depend on it; --first takes only so many of them.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import traceback
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass
from pathlib import Path

ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS")
os.environ.update(dict.fromkeys(ONE_THREAD, "1"))  # read by the processes as they start

HERE = Path(__file__).resolve().parent

from baseline import Figure, write  # noqa: E402
from blind.laboratory.__main__ import answer, write_campaign  # noqa: E402
from blind.laboratory.campaign import make_campaign  # noqa: E402
from blind.laboratory.suites import SUITES, orders_of  # noqa: E402
from laboratory_score.answers import Row, read_lines, rows_of  # noqa: E402
from laboratory_score.calibration import write_calibration  # noqa: E402
from laboratory_score.outcome import is_right  # noqa: E402
from laboratory_score.shares import share  # noqa: E402
from laboratory_score.tables import by_suite, markdown  # noqa: E402
from laboratory_score.wrong import listing  # noqa: E402
from tqdm import tqdm  # noqa: E402

LIMIT = 600  # s of the processor after which an answer is no longer waited for
LINES = "campaigns.jsonl"


class TooLong(Exception):
    """An answer took longer than LIMIT."""


@dataclass(frozen=True)
class Task:
    """One campaign: to be made by a suite's seed, or lying in a folder with its answer."""

    suite: str
    name: str
    seed: int = 0
    count: int | None = None
    number: int = 0
    folder: str = ""
    answer: str = ""  # JSON


def made(task: Task, folder: Path) -> dict:
    """The campaign's files in a folder, the same as `blind.laboratory` writes; its answer."""
    order = orders_of(task.suite, task.seed, task.count)[task.number]
    campaign = make_campaign(order, [task.seed, list(SUITES).index(task.suite), task.number])
    write_campaign(campaign, folder)
    return answer(campaign)


def ask(folder: Path) -> tuple[dict | None, str]:
    """gap.json of a campaign as the command would write it, or why there is none."""
    from cosim.gap import CampaignError, read_campaign
    from cosim.gap.find import find_gap
    from cosim.gap.show.numbers import as_json

    try:
        gap = find_gap(read_campaign(folder), jobs=1)
        return json.loads(as_json(gap, "model.toml")), ""
    except TooLong:
        return None, f"no answer in {LIMIT} s of the processor"
    except CampaignError as error:
        return None, f"refused: {error}"
    except Exception:  # a benchmark goes on; the words are in the listing
        return None, traceback.format_exc()[-1500:]


def within(limit: float, what: Callable[[], tuple[dict | None, str]]) -> tuple[dict | None, str]:
    """What is returned within so many seconds of the processor."""

    def stop(*_: object) -> None:
        raise TooLong

    before = signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, limit)
    try:
        return what()
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


def judge(task: Task, keep: Path | None = None) -> dict:
    """Make a campaign, ask, and put both answers into one line."""
    # neither the name nor the path of what is read says anything of the suite or the answer
    place = Path(tempfile.mkdtemp())
    folder = Path(task.folder) if task.folder else place / task.name.split("-")[-1]
    try:
        truth = json.loads(task.answer) if task.folder else made(task, folder)
        wall, cpu = time.perf_counter(), time.process_time()
        found, error = within(LIMIT, lambda: ask(folder))
        wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
        if keep is not None and not task.folder:
            shutil.copytree(folder, keep / task.suite / task.name, dirs_exist_ok=True)
    finally:
        shutil.rmtree(place)
    return {
        "suite": task.suite,
        "name": task.name,
        "answer": truth,
        "found": found,
        "error": error,
        "seconds": round(wall, 2),
        "cpu": round(cpu, 2),
        "code": code(),
    }


def code() -> str:
    """The commit that answered."""
    words = ["git", "-C", str(HERE), "describe", "--always", "--dirty"]
    return subprocess.run(words, capture_output=True, text=True).stdout.strip()


def of_suites(suites: list[str], seed: int, count: int | None, first: int | None) -> Iterator[Task]:
    """Campaigns of suites, named by seed, size of the suite and number."""
    for suite in suites:
        total = len(orders_of(suite, seed, count))
        for number in range(min(total, first or total)):
            name = f"{seed}-{total}-c{number + 1:03d}"
            yield Task(suite, name, seed, count, number)


def of_folder(folder: Path, answers: Path) -> Iterator[Task]:
    """Campaigns that lie in a folder; every key of the answers is the name of one."""
    for name, truth in json.loads(answers.read_text(encoding="utf-8")).items():
        yield Task(folder.name, name, folder=str(folder / name), answer=json.dumps(truth))


def run(tasks: list[Task], out: Path, jobs: int, resume: bool, keep: Path | None) -> list[Row]:
    """All rows of the tasks; each is written as it ends."""
    file = out / LINES
    if file.exists() and not resume:
        raise SystemExit(f"{file}: is there already; --resume does what is missing of it")
    out.mkdir(parents=True, exist_ok=True)
    lines = list(read_lines(file))
    done = {(line["suite"], line["name"]) for line in lines if line["found"] is not None}
    missing = [task for task in tasks if (task.suite, task.name) not in done]
    with open(file, "a", encoding="utf-8") as text, ProcessPoolExecutor(jobs) as pool:
        text.write("\n" if lines else "")  # behind a line that was cut off
        work = as_completed([pool.submit(judge, task, keep) for task in missing])
        for each in tqdm(work, total=len(missing), disable=not sys.stderr.isatty()):
            line = each.result()
            lines.append(line)
            text.write(json.dumps(line) + "\n")
            text.flush()
            found = line["found"] or {"verdict": "failed", "effects": []}
            said = f"{found['verdict']} {' '.join(found['effects'])}"
            print(f"{line['suite']} {line['name']}: {said} ({line['seconds']:.0f} s)", flush=True)
    return rows_of(lines)


def report(rows: list[Row], out: Path) -> str:
    """Tables, list of errors and figure; the tables' text."""
    text = markdown(rows, f"Campaigns with answers, {code()}")
    (out / "scores.md").write_text(text, encoding="utf-8")
    (out / "wrong.md").write_text(listing(rows), encoding="utf-8")
    write_calibration(rows, out / "calibration.png")
    return text


def figures(rows: list[Row]) -> dict[str, Figure]:
    """Share of right answers of each suite, for `compare.py`."""
    return {
        f"right, {suite}": Figure(share(some, is_right).value, better="more")
        for suite, some in by_suite(rows)
    }


def arguments() -> argparse.Namespace:
    """Of the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("suite", nargs="*", metavar="SUITE", help=", ".join(SUITES))
    parser.add_argument("--seed", type=int, help="of the suites")
    parser.add_argument(
        "--count", type=int, help="campaigns of a suite; its own number if left out"
    )
    parser.add_argument("--first", type=int, help="only so many campaigns of each suite")
    parser.add_argument("--campaigns", type=Path, help="a folder with a folder for each campaign")
    parser.add_argument("--answers", type=Path, help="answers.json of that folder")
    parser.add_argument("--jobs", type=int, default=2, help="campaigns side by side (default: 2)")
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--resume", action="store_true", help="go on with what is in --out")
    parser.add_argument("--keep", type=Path, help="keep the campaigns' files there")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the figures there")
    told = parser.parse_args()
    if unknown := set(told.suite) - set(SUITES):
        parser.error(f"no suite {', '.join(sorted(unknown))}; there are {', '.join(SUITES)}")
    if told.suite and told.seed is None:
        parser.error("--seed is needed")
    if (told.campaigns is None) != (told.answers is None):
        parser.error("--campaigns and --answers go together")
    return told


def main() -> None:
    told = arguments()
    tasks = list(of_suites(told.suite, told.seed, told.count, told.first))
    if told.campaigns is not None:
        tasks += of_folder(told.campaigns, told.answers)
    rows = run(tasks, told.out, told.jobs, told.resume, told.keep)
    print(report(rows, told.out))
    write(told.json, "laboratory", figures(rows))


if __name__ == "__main__":
    main()
