"""What a scenario file leaves out: a stated set of values, those of a rig as it can be built.

The set is `defaults.toml` beside this file. The FMU starts from it, too; `Scenario()`
and `Parameters()` in Python begin from the plain model, in which every effect is off.
"""

import math
from collections.abc import Mapping
from functools import cache
from typing import Any

from stickslip.packaged import packaged_tables

#: The sets that a file may name: the stated one, and none.
RIG, PLAIN = "rig", "plain"
FILE = "defaults.toml"
#: Key -> the key that its default is proportional to, and that one's own default, m: springs are
#: stretched by so much of their length.
IN_PROPORTION = {"rig.spring_natural_length": ("rig.spring_length", 0.20)}


@cache
def stated() -> Mapping[str, Any]:
    """`table.key` -> value of the set."""
    tables = packaged_tables(__package__, FILE)
    return {
        f"{table}.{key}": value
        for table, entries in tables.items()
        for key, value in entries.items()
    }


def filled(tables: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    """The tables of a file with what they left out, and that alone as `table.key` -> value.

    Tables that are none are left as they are, for the check of all keys to refuse.

    >>> filled({"rig": {"spring_length": 0.4}})[0]["rig"]
    {'spring_length': 0.4, 'spring_natural_length': 0.34}
    >>> filled({"defaults": "plain", "rig": {"mass": 1.0}})[1]
    {}
    """
    full = {key: dict(value) if isinstance(value, dict) else value for key, value in tables.items()}
    taken: dict[str, Any] = {}
    if full.get("defaults", RIG) != RIG:
        return full, taken
    full["defaults"] = PLAIN  # once filled, it leaves nothing out
    for key, value in stated().items():
        table, _, entry = key.partition(".")
        entries = full.setdefault(table, {})
        if isinstance(entries, dict) and entry not in entries:
            taken[key] = entries[entry] = _proportional(key, value, tables)
    return full, taken


def _proportional(key: str, value: Any, tables: Mapping[str, Any]) -> Any:
    """A default, or what it comes to beside the size that the file gives of another key."""
    if key not in IN_PROPORTION:
        return value
    other, usual = IN_PROPORTION[key]
    table, _, entry = other.partition(".")
    entries = tables.get(table)
    given = entries.get(entry, usual) if isinstance(entries, dict) else usual
    if isinstance(given, bool) or not isinstance(given, (int, float)):
        return value
    if not 0.0 < given < math.inf:
        return value
    return float(f"{value * (given / usual):.12g}")  # 0.255, and not 0.25500000000000006
