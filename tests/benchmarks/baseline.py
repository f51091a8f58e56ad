"""What a benchmark found, as a JSON file that `compare.py` compares with another."""

import argparse
import json
import os
import platform
from pathlib import Path
from typing import Literal, NamedTuple


class Figure(NamedTuple):
    """A number of a benchmark; better: which way is an improvement."""

    value: float
    unit: str = "1"
    better: Literal["less", "more"] = "less"


def arguments(description: str | None, **numbers: int) -> argparse.ArgumentParser:
    """A parser that knows `--json FILE`, and whole numbers with these defaults."""
    parser = argparse.ArgumentParser(
        description=description, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the figures there")
    for name, default in numbers.items():
        parser.add_argument(name, type=int, nargs="?", default=default)
    return parser


def machine() -> dict[str, str | int | None]:
    """What the seconds depend on beside the code."""
    return {
        "processor": platform.processor() or platform.machine(),
        "cores": os.cpu_count(),
        "python": platform.python_version(),
    }


def write(file: Path | None, benchmark: str, figures: dict[str, Figure]) -> None:
    """The figures of a benchmark; nothing where no file was asked for."""
    if file is None:
        return
    content = {
        "benchmark": benchmark,
        "machine": machine(),
        "figures": {name: figure._asdict() for name, figure in figures.items()},
    }
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


def read(file: Path) -> tuple[dict, dict[str, Figure]]:
    """What stands beside the figures of a file, and the figures."""
    content = json.loads(file.read_text(encoding="utf-8"))
    figures = content.pop("figures")
    return content, {name: Figure(**figure) for name, figure in figures.items()}
