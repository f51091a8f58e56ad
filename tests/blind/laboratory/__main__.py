"""Write a suite: `python -m tests.blind.laboratory SUITE FOLDER --seed N [--count M]`."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from .campaign import answer, make_campaign, write_campaign
from .suites import SUITES, orders_of


def write_suite(
    suite: str,
    folder: Path,
    seed: int,
    count: int | None = None,
    answers: Path | None = None,
    jobs: int = 1,
) -> dict[str, dict]:
    """Campaigns of a suite into folders of their own, and their answers; returns the answers.

    Campaigns have numbers for names: the order of the suite is drawn, so that a name tells nothing.
    """
    orders = orders_of(suite, seed, count)
    told = {}
    for number, order in enumerate(orders):
        name = f"c{number + 1:03d}"
        made = make_campaign(order, [seed, list(SUITES).index(suite), number])
        write_campaign(made, folder / name)
        told[name] = answer(made)
        (answers or folder / "answers.json").write_text(json.dumps(told, indent=1) + "\n")
    return told


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("suite", choices=SUITES)
    parser.add_argument("folder", type=Path, help="campaigns, a folder each")
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--count", type=int, help="campaigns; the suite's own number if left out")
    parser.add_argument("--answers", type=Path, help="FOLDER/answers.json if left out")
    told = parser.parse_args()
    told.folder.mkdir(parents=True, exist_ok=True)
    write_suite(told.suite, told.folder, told.seed, told.count, told.answers)


if __name__ == "__main__":
    main()
