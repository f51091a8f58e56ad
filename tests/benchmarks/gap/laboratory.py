"""Campaigns of the laboratory, with known answers, put to `find_gap` and scored.

    python tests/benchmarks laboratory contact_and_shapes nothing --seed 7 --out results/lab
    python tests/benchmarks laboratory faults --seed 7 --first 10 --out results/lab --resume
    python tests/benchmarks laboratory --campaigns FOLDER --answers answers.json --out results/x

Each campaign is made and answered in one process, on one core, and written as a line of
campaigns.jsonl as it ends; --resume does what is missing. Then scores.md (tables) and wrong.md
(every answer that is not right) are written. --count is the size of a suite, whose orders depend on
it; --first takes only so many of them.
"""

import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import traceback
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path
from typing import NamedTuple

ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS")
os.environ.update(dict.fromkeys(ONE_THREAD, "1"))  # read by the processes as they start

from baseline import Figure, arguments, write  # noqa: E402
from blind.laboratory.__main__ import answer, write_campaign  # noqa: E402
from blind.laboratory.campaign import make_campaign  # noqa: E402
from blind.laboratory.suites import SUITES, orders_of  # noqa: E402
from laboratory_score import judged, listing, markdown  # noqa: E402
from tqdm import tqdm  # noqa: E402

LIMIT = 600  # s of the processor after which an answer is no longer waited for


class TooLong(Exception):
    """An answer took longer than LIMIT."""


class Task(NamedTuple):
    """One campaign: to be made by a suite's seed, or lying in a folder with its answer."""

    suite: str
    name: str
    made_by: tuple[int, int | None, int] = (0, None, 0)  # seed, size of the suite, number
    folder: Path | None = None
    answer: dict | None = None


def of_suites(suites: list[str], seed: int, count: int | None, first: int | None) -> Iterator[Task]:
    """Campaigns of suites, named by seed, size of the suite and number."""
    for suite in suites:
        total = len(orders_of(suite, seed, count))
        for number in range(min(total, first or total)):
            yield Task(suite, f"{seed}-{total}-c{number + 1:03d}", (seed, count, number))


def of_folder(folder: Path, answers: Path) -> Iterator[Task]:
    """Campaigns that lie in a folder; every key of the answers is the name of one."""
    for name, truth in json.loads(answers.read_text(encoding="utf-8")).items():
        yield Task(folder.name, name, folder=folder / name, answer=truth)


def made(task: Task, folder: Path) -> dict:
    """The campaign's files in a folder, the same as `blind.laboratory` writes; its answer."""
    seed, count, number = task.made_by
    order = orders_of(task.suite, seed, count)[number]
    campaign = make_campaign(order, [seed, list(SUITES).index(task.suite), number])
    write_campaign(campaign, folder)
    return answer(campaign)


def ask(folder: Path) -> tuple[dict | None, str]:
    """gap.json of a campaign as the command would write it, or why there is none."""
    from cosim.gap import CampaignError, read_campaign
    from cosim.gap.find import find_gap
    from cosim.gap.show.numbers import as_json

    def stop(*_: object) -> None:
        raise TooLong

    signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, LIMIT)
    try:
        gap = find_gap(read_campaign(folder), jobs=1)
        return json.loads(as_json(gap, "model.toml")), ""
    except TooLong:
        return None, f"no answer in {LIMIT} s of the processor"
    except CampaignError as error:
        return None, f"refused: {error}"
    except Exception:  # a benchmark goes on; the words are in the listing
        return None, traceback.format_exc()[-1500:]
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)


def answered(task: Task, keep: Path | None = None) -> dict:
    """Make a campaign, ask, and put both answers into one line."""
    with tempfile.TemporaryDirectory() as place:
        # neither the name nor the path of what is read says anything of the suite or the answer
        folder = task.folder or Path(place) / task.name.split("-")[-1]
        truth = task.answer or made(task, folder)
        wall, cpu = time.perf_counter(), time.process_time()
        found, error = ask(folder)
        wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
        if keep is not None and not task.folder:
            shutil.copytree(folder, keep / task.suite / task.name, dirs_exist_ok=True)
    line = {"suite": task.suite, "name": task.name, "answer": truth, "found": found}
    return line | {"error": error, "seconds": round(wall, 2), "cpu": round(cpu, 2), "code": code()}


def code() -> str:
    """The commit that answered."""
    words = ["git", "-C", str(Path(__file__).parent), "describe", "--always", "--dirty"]
    return subprocess.run(words, capture_output=True, text=True).stdout.strip()


def read_lines(file: Path) -> Iterator[dict]:
    """Lines written so far; one that an interruption cut off is left out."""
    for text in file.read_text(encoding="utf-8").splitlines() if file.is_file() else ():
        try:
            yield json.loads(text)
        except json.JSONDecodeError:
            continue


def run(tasks: list[Task], out: Path, jobs: int, resume: bool, keep: Path | None) -> list[dict]:
    """All lines of the tasks; each is written as it ends."""
    file = out / "campaigns.jsonl"
    if file.exists() and not resume:
        raise SystemExit(f"{file}: is there already; --resume does what is missing of it")
    out.mkdir(parents=True, exist_ok=True)
    lines = list(read_lines(file))
    done = {(line["suite"], line["name"]) for line in lines if line["found"] is not None}
    missing = [task for task in tasks if (task.suite, task.name) not in done]
    with open(file, "a", encoding="utf-8") as text, ProcessPoolExecutor(jobs) as pool:
        text.write("\n" if lines else "")  # behind a line that was cut off
        work = as_completed([pool.submit(answered, task, keep) for task in missing])
        for each in tqdm(work, total=len(missing), disable=not sys.stderr.isatty()):
            line = each.result()
            lines.append(line)
            text.write(json.dumps(line) + "\n")
            text.flush()
            found = line["found"] or {"verdict": "failed", "effects": []}
            said = f"{found['verdict']} {' '.join(found['effects'])}"
            print(f"{line['suite']} {line['name']}: {said} ({line['seconds']:.0f} s)", flush=True)
    return lines


def main() -> None:
    parser = arguments(__doc__)
    parser.add_argument("suite", nargs="*", metavar="SUITE", help=", ".join(SUITES))
    parser.add_argument("--seed", type=int, help="of the suites")
    parser.add_argument("--count", type=int, help="campaigns of a suite (default: its own)")
    parser.add_argument("--first", type=int, help="only so many campaigns of each suite")
    parser.add_argument("--campaigns", type=Path, help="a folder with a folder for each campaign")
    parser.add_argument("--answers", type=Path, help="answers.json of that folder")
    parser.add_argument("--jobs", type=int, default=2, help="campaigns side by side (default: 2)")
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--resume", action="store_true", help="go on with what is in --out")
    parser.add_argument("--keep", type=Path, help="keep the campaigns' files there")
    told = parser.parse_args()
    if unknown := set(told.suite) - set(SUITES):
        parser.error(f"no suite {', '.join(sorted(unknown))}; there are {', '.join(SUITES)}")
    if told.suite and told.seed is None:
        parser.error("--seed is needed")
    if (told.campaigns is None) != (told.answers is None):
        parser.error("--campaigns and --answers go together")
    tasks = list(of_suites(told.suite, told.seed, told.count, told.first))
    if told.campaigns is not None:
        tasks += of_folder(told.campaigns, told.answers)
    rows = judged(run(tasks, told.out, told.jobs, told.resume, told.keep))
    text = markdown(rows, f"Campaigns with answers, {code()}")
    (told.out / "scores.md").write_text(text, encoding="utf-8")
    (told.out / "wrong.md").write_text(listing(rows), encoding="utf-8")
    print(text)
    right = rows.groupby("suite", sort=False)["right"].mean()
    figures = {
        f"right, {suite}": Figure(float(part), better="more") for suite, part in right.items()
    }
    write(told.json, "laboratory", figures)


if __name__ == "__main__":
    main()
