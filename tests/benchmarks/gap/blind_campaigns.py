"""Hidden effects named or not: the whole workflow on campaigns whose answers it cannot see.

    python tests/benchmarks blind_campaigns results/blind --jobs 2
    python tests/benchmarks blind_campaigns results/few --kind effects --effects run_in --count 2

Draws campaigns (tests/blind: a simulator of its own), gives their files to `stickslip gap`, and
scores the answers: a JSON line for each campaign, a Markdown table and a figure. Started again
with the same folder it does what is missing. Seeds are drawn afresh in a new folder and printed;
--seed repeats them.
"""

from __future__ import annotations

import json
import math
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

import joblib
import numpy as np
from baseline import Figure, arguments, write
from blind.campaign import KINDS, Campaign, draw_campaign
from blind.effects import EFFECTS
from blind.next_experiment import separation
from blind.out_of_catalogue import OUT_OF_CATALOGUE
from blind.score import is_right
from blind.score_table import markdown
from blind.writing import write_campaign
from blind_figure import score_figure
from tqdm import tqdm

LIMIT = 600.0  # s after which an answer is no longer waited for
# campaigns of each cell, where --count does not say: 224 + 40 + 48 + 40 + 12 = 364
COUNTS = {"effects": 4, "none": 20, "unknown": 2, "two": 20, "single_speed": 3}
SIZES = {"effects": ((5.0, 10.0), (10.0, 30.0)), "two": ((5.0, 30.0),), "unknown": ((5.0, 30.0),)}


@dataclass(frozen=True)
class Cell:
    """One campaign to draw."""

    name: str
    seed: int
    kind: str
    ids: tuple[str, ...]
    sizes: tuple[float, float]
    clean: bool


def cells(kinds, count, first: int, ids, sizes) -> Iterator[Cell]:
    """All campaigns of a benchmark: hidden effect, size, quality of the recording, repetition."""
    lists = {
        "effects": [(name,) for name in EFFECTS],
        "unknown": [(name,) for name in OUT_OF_CATALOGUE],
        "single_speed": [("film_drag",), ("structural_damping",)],
        "two": [tuple(ids) if len(ids) == 2 else ()],
        "none": [()],
    }
    for kind in kinds:
        hidden = [each for each in lists[kind] if not ids or not each or set(each) & set(ids)]
        bands = sizes or SIZES.get(kind, ((5.0, 30.0),))
        for names in hidden:
            for band in bands:
                for clean in (True, False):
                    for i in range(count or COUNTS[kind]):
                        what = "-".join((kind, *names, f"{band[0]:g}", "clean" if clean else "raw"))
                        # a seed of its own for every cell, the same whatever else is run
                        key = np.random.SeedSequence([first, *what.encode(), i])
                        seed = int(key.generate_state(1)[0])
                        yield Cell(f"{what}-{i:02d}", seed, kind, names, band, clean)


def ask(campaign: Path, folder: Path) -> tuple[dict | None, str, float]:
    """The product's answer to a folder of files, its last words, and seconds: the one place.

    On one core each, without the page: several campaigns are asked side by side.
    """
    answer = folder / "answer.json"
    command = [sys.executable, "-m", "cosim", "gap", str(campaign), "-o", str(folder / "report")]
    begin = time.perf_counter()
    one_core = os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    try:
        done = subprocess.run(
            [*command, "--json", str(answer), "--jobs", "1", "--no-page"],
            capture_output=True,
            text=True,
            timeout=LIMIT,
            env=one_core,
        )
        words = f"exit {done.returncode}: {done.stderr.strip()[-400:]}"
    except subprocess.TimeoutExpired:
        words = f"no answer in {LIMIT:g} s"
    seconds = time.perf_counter() - begin
    found = json.loads(answer.read_text(encoding="utf-8")) if answer.is_file() else None
    return found, words, seconds


def proposed_separation(drawn: Campaign, found: dict | None) -> float:
    """What the proposed next experiment would show of the class, noise units; nan without one."""
    if not found or found["verdict"] != "class" or not found.get("next_experiment"):
        return math.nan
    return separation(drawn, found["next_experiment"])


def judge(cell: Cell, folder: Path, keep: bool) -> dict:
    """Draw a campaign, ask the product, and put both answers side by side."""
    drawn = draw_campaign(cell.seed, cell.kind, cell.ids, cell.sizes, float(cell.clean))
    # neither the name nor the path of what the product reads says anything
    place, answers = (
        folder / "campaigns" / f"c{cell.seed}",
        folder / "answers" / f"{cell.name}.json",
    )
    truth = write_campaign(drawn, place / "data", answers, f"campaign {cell.seed}")
    found, words, seconds = ask(place / "data" / "campaign.toml", place)
    row = asdict(cell) | {"truth": truth, "found": found, "words": words, "seconds": seconds}
    if cell.kind == "single_speed":
        apart = proposed_separation(drawn, found)
        row |= {} if math.isnan(apart) else {"separation": apart}
    if not keep:
        shutil.rmtree(place)
    return row


def seed_of(folder: Path, told: int | None) -> int:
    """The seed of a benchmark: told, kept from an earlier start, or drawn afresh."""
    file = folder / "seed.txt"
    if file.is_file():
        kept = int(file.read_text(encoding="utf-8"))
        if told not in (None, kept):
            raise SystemExit(f"{folder}: was begun with seed {kept}, not {told}")
        return kept
    seed = int(np.random.SeedSequence().generate_state(1)[0]) if told is None else told
    folder.mkdir(parents=True, exist_ok=True)
    file.write_text(f"{seed}\n", encoding="utf-8")
    return seed


def read_rows(file: Path) -> list[dict]:
    """Answers so far; a line that was cut off by an interruption is done again."""
    rows = []
    if file.is_file():
        for text in file.read_text(encoding="utf-8").splitlines():
            try:
                rows.append(json.loads(text))
            except json.JSONDecodeError:
                continue
    return rows


def run_missing(
    wanted: list[Cell], folder: Path, jobs: int, keep: bool, again: bool = False
) -> list[dict]:
    """All rows of the cells wanted, those from an earlier start included.

    again: campaigns without an answer are asked once more.
    """
    file = folder / "campaigns.jsonl"
    rows = {row["name"]: row for row in read_rows(file) if row["found"] or not again}
    missing = [cell for cell in wanted if cell.name not in rows]
    work = joblib.Parallel(n_jobs=jobs, return_as="generator_unordered")(
        joblib.delayed(judge)(cell, folder, keep) for cell in missing
    )
    with open(file, "a", encoding="utf-8") as lines:
        lines.write("\n" if rows else "")  # behind a line that was cut off
        for row in tqdm(work, total=len(missing), disable=not sys.stderr.isatty()):
            rows[row["name"]] = row
            lines.write(json.dumps(row) + "\n")
            lines.flush()
    return [rows[cell.name] for cell in wanted]


def figures_of(rows: list[dict]) -> dict[str, Figure]:
    """Share of right answers of each kind, and what an answer takes."""
    figures = {}
    for kind in KINDS:
        of_kind = [is_right(row) for row in rows if row["kind"] == kind]
        if of_kind:
            figures[f"right, {kind}"] = Figure(sum(of_kind) / len(of_kind), better="more")
    seconds = float(np.median([row["seconds"] for row in rows]))
    return figures | {"wall time of an answer, median": Figure(seconds, "s")}


def main() -> None:
    parser = arguments(__doc__)
    parser.add_argument("folder", type=Path, help="answers, table and figure; continued if begun")
    parser.add_argument("--kind", nargs="+", choices=KINDS, default=KINDS)
    parser.add_argument("--count", type=int, help="campaigns of each cell")
    parser.add_argument("--effects", nargs="+", choices=[*EFFECTS, *OUT_OF_CATALOGUE], default=())
    parser.add_argument("--size", nargs=2, type=float, action="append", help="band, noise units")
    parser.add_argument("--seed", type=int, help="drawn afresh in a new folder")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--keep", action="store_true", help="keep the campaigns and the reports")
    parser.add_argument("--again", action="store_true", help="ask those without an answer again")
    told = parser.parse_args()
    seed = seed_of(told.folder, told.seed)
    print(f"seed {seed}")
    bands = [tuple(band) for band in told.size or ()]
    wanted = list(cells(told.kind, told.count, seed, told.effects, bands))
    rows = run_missing(wanted, told.folder, told.jobs, told.keep, told.again)
    table = markdown(rows, seed)
    (told.folder / "scores.md").write_text(table, encoding="utf-8")
    score_figure(rows, told.folder / "scores.png")
    write(told.json, "blind_campaigns", figures_of(rows))
    print(table)


if __name__ == "__main__":
    main()
