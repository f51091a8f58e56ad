"""Every answer that is not right, with what was hidden and what was tried: for whoever mends it."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict

from .answers import Row
from .exponents import exponents_are_near
from .outcome import is_right, outcome

FIRST = 3  # of the ranking
SAID = ("verdict", "effects", "classes", "gap", "share", "exponents", "ladder", "remarks")


def is_listed(row: Row) -> bool:
    """Wrong, or right with a wrong power."""
    return not is_right(row) or bool(row.truth.exponents) and not exponents_are_near(row)


def listing(rows: Sequence[Row]) -> str:
    """A chapter for every one of them: what is true, and what was said."""
    listed = [row for row in rows if is_listed(row)]
    parts = [f"# {len(listed)} of {len(rows)} campaigns not answered right\n"]
    for row in listed:
        said = {key: row.found.get(key) for key in SAID} if row.found else {"error": row.error}
        ranking = (row.found or {}).get("ranking", [])
        said |= {"first": ranking[:FIRST], "places": [each["effect"] for each in ranking]}
        both = {"true": asdict(row.truth), "said": said}
        text = json.dumps(both, indent=1, ensure_ascii=False, default=sorted)
        head = f"{row.suite} {row.name}: {outcome(row)}, {row.seconds:.0f} s"
        parts.append(f"## {head}\n```json\n{text}\n```\n")
    return "\n".join(parts)
