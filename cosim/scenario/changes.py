"""`--set key=value`: what is said on the command line in place of what a file has."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping
from typing import Any

from cosim.scenario.validation import ScenarioError


def changes_of(settings: Iterable[str], example: str = "run.duration=10") -> dict[str, Any]:
    """`key=value` texts as `table.key` -> value; a value is as TOML has it, or a text unquoted.

    Of a key that comes twice the last counts. Raises ScenarioError, in which ``example`` is what
    would be allowed.

    >>> changes_of(["rig.mass=1.2", "rig.surface=slab", "rig.degrees_of_freedom=['x']"])
    {'rig.mass': 1.2, 'rig.surface': 'slab', 'rig.degrees_of_freedom': ['x']}
    """
    found: dict[str, Any] = {}
    for setting in settings:
        key, equals, text = setting.partition("=")
        if not equals or not key.strip():
            raise ScenarioError(f"--set {setting}: allowed is KEY=VALUE, as {example}")
        found[key.strip()] = _value(text)
    return found


def _value(text: str) -> Any:
    try:
        tables = tomllib.loads(f"value = {text}")
    except (ValueError, RecursionError):  # TOMLDecodeError is a ValueError
        return text.strip()
    return tables["value"] if set(tables) == {"value"} else text.strip()


def changed_tables(tables: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """The tables of a file with `table.key` -> value put in; what is no table is replaced by one.

    A third name is a key of a table in a table, as `coupling.absolute_tolerances.block.x`.
    """
    changed = {key: dict(value) if isinstance(value, dict) else value
               for key, value in tables.items()}  # fmt: skip
    for key, value in changes.items():
        table, dot, entry = key.partition(".")
        if not dot:
            changed[table] = value
            continue
        entry, further, name = entry.partition(".")
        here = changed[table] = _table(changed.get(table))
        if further:
            here[entry] = {**_table(here.get(entry)), name: value}
        else:
            here[entry] = value
    return changed


def _table(entries: Any) -> dict[str, Any]:
    return entries if isinstance(entries, dict) else {}


def is_of_change(fault: str, changes: Mapping[str, Any]) -> bool:
    """Whether a fault's line, which begins with its key, is of a value that was changed."""
    key = fault.partition(":")[0]
    return any(key == changed or changed.startswith(f"{key}.") for changed in changes)
