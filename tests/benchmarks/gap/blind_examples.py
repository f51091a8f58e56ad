"""Verdict, gap and wall time of `stickslip gap` on every campaign of a folder with answers.

    python tests/benchmarks blind_examples ../shared/data/blind_examples

The folder holds campaigns and an `answers.json`: name -> {"verdict", "effects"}.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import pandas as pd
from baseline import Figure, arguments, write


def asked(campaign: Path, jobs: int) -> tuple[dict, float]:
    """What `stickslip gap` answers, and the seconds that it took."""
    with tempfile.TemporaryDirectory() as folder:
        began = time.perf_counter()
        subprocess.run(
            [sys.executable, "-m", "cosim", "gap", campaign, "-o", folder, "--jobs", str(jobs)],
            check=True,
            capture_output=True,
        )
        took = time.perf_counter() - began
        return json.loads((Path(folder) / "gap.json").read_text(encoding="utf-8")), took


def main() -> None:
    parser = arguments(__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--jobs", type=int, default=2)
    told = parser.parse_args()
    answers = json.loads((told.folder / "answers.json").read_text(encoding="utf-8"))
    rows = []
    for name, right in sorted(answers.items()):
        said, took = asked(told.folder / name, told.jobs)
        hit = said["verdict"] == right["verdict"] and said["effects"] == right.get("effects", [])
        rows.append({
            "campaign": name, "verdict": said["verdict"], "effects": ", ".join(said["effects"]),
            "right": hit, "before": said["gap"]["before"]["held_out"],
            "after": said["gap"]["after"]["held_out"], "wall s": round(took, 1),
        })  # fmt: skip
        print(pd.DataFrame(rows[-1:]).to_string(index=False, header=len(rows) == 1), flush=True)
    figures = {f"{row['campaign']}: wall time": Figure(row["wall s"], "s") for row in rows}
    figures["right"] = Figure(sum(row["right"] for row in rows), better="more")
    write(told.json, "blind_examples", figures)
    if not all(row["right"] for row in rows):
        sys.exit(1)


if __name__ == "__main__":
    main()
