"""The table of what was verified, from what the tests measured.

`python tests/docs/measure.py` writes the file that is read here: of every test the assertion that
comes nearest to what is allowed, as it came out.
"""

import ast
import json
import os
from pathlib import Path

from .markdown import code, heading, table

CHECKOUT = Path(os.environ["STICKSLIP_CHECKOUT"])
TESTS = CHECKOUT / "tests" / "verification"
FIGURES = Path(__file__).parents[1] / "reference" / "verification.json"
ROOMS = {
    "kernel": "The mechanical kernel",
    "contact": "Stick, creep, bristles",
    "effects": "Effects",
    "reference": "Closed forms, published figures, the source study's scheme",
    "belt": "Heat in the belt",
    "ice": "Heat in the ice, melting",
    "coupled": "Coupling",
}


def text() -> str:
    """Room by room and file by file: what is checked against what, and the measured figures."""
    measured = json.loads(FIGURES.read_text(encoding="utf-8"))
    made = measured["made"]
    begin = (
        f"{sum(map(len, measured['files'].values()))} tests, of which {len(measured['failed'])} "
        f"failed{': ' if measured['failed'] else ''}{'; '.join(measured['failed'])} "
        f"({made['date']}, version {made['version']}, Python {made['python']}, "
        f"{made['machine']}).\n\n"
    )
    return begin + "".join(_room(room, title, measured["files"]) for room, title in ROOMS.items())


def _room(room: str, title: str, measured: dict) -> str:
    parts = [heading(2, title)]
    for file in sorted((TESTS / room).glob("test_*.py")):
        said = (ast.get_docstring(ast.parse(file.read_text(encoding="utf-8"))) or "").split("\n\n")
        name = f"{room}/{file.name}"
        parts.append(f"**{' '.join(said[0].split())}** {code(f'tests/verification/{name}')}\n\n")
        rows = [
            (test.removeprefix("test_").replace("_", " "), code(compared), was, allowed)
            for test, (compared, was, allowed) in measured.get(name, {}).items()
        ]
        if rows:
            parts.append(table(("test", "compared", "measured", "allowed"), rows))
        else:
            parts.append("Not measured yet in the file that this page is made from.\n\n")
    return "".join(parts)
