"""The examples, run: what they print and draw, for the site; what they compute, for the tests."""

import contextlib
import io
import runpy
from pathlib import Path
from typing import Any

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
NAMES = sorted(file.stem for file in EXAMPLES.glob("*.py"))
#: Half a minute and more: run by `pytest -m slow`, shown without a figure.
SLOW = ("find_gap",)


def ran(name: str, gallery: Path) -> dict[str, Any]:
    """Run an example where one is; what its variables hold at the end.

    NAME.txt in the gallery is what it printed, NAME.png its variable ``figure`` if it has one.
    """
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        variables = runpy.run_path(str(EXAMPLES / f"{name}.py"))
    gallery.mkdir(parents=True, exist_ok=True)
    (gallery / f"{name}.txt").write_text(said.getvalue(), encoding="utf-8")
    if "figure" in variables:
        variables["figure"].savefig(gallery / f"{name}.png", dpi=110)
    return variables
