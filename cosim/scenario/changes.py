"""`--set key=value`: what is said on the command line in place of what a file has."""

import copy
import re
import tomllib
from collections.abc import Collection, Iterable, Mapping
from contextlib import suppress
from typing import Any

from cosim.scenario.validation import ScenarioError


def changes_of(settings: Iterable[str], example: str = "run.duration=10") -> dict[str, Any]:
    """`key=value` texts as `table.key` -> value, each as `value_of` reads it.

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
        found[key.strip()] = value_of(text)
    return found


def value_of(text: str) -> Any:
    """As TOML has it; else a number as Python has it, a list of such or of words, or a text.

    >>> value_of(".5"), value_of("[x, phi]"), value_of("disc")
    (0.5, ['x', 'phi'], 'disc')
    """
    text = text.strip()
    with suppress(ValueError, RecursionError):  # TOMLDecodeError is a ValueError
        tables = tomllib.loads(f"value = {text}")
        if set(tables) == {"value"}:
            return tables["value"]
    if words := re.fullmatch(r"\[([^][{}]*)\]", text):
        return [value_of(part) for part in words[1].split(",") if part.strip()]
    with suppress(ValueError):
        return float(text)
    return text


def changes_named(named: Mapping[str, Any], tables: Collection[str]) -> dict[str, Any]:
    """Keywords as `table.key` -> value: `surface_speed=0.2`, or `surface={"speed": 0.2}`.

    >>> changes_named({"run_in_change": 0.1, "rig": {"mass": 1.2}}, ["run", "run_in", "rig"])
    {'run_in.change': 0.1, 'rig.mass': 1.2}
    """
    found: dict[str, Any] = {}
    for name, value in named.items():
        if name in tables:
            entries = value.items() if isinstance(value, Mapping) else ()
            found |= {f"{name}.{key}": entry for key, entry in entries} or {name: value}
            continue
        # of `run` and `run_in` the longer
        starts = [table for table in tables if name.startswith(f"{table}_")]
        table = max(starts, key=len, default="")
        found[f"{table}.{name[len(table) + 1 :]}" if table else name] = value
    return found


def changed_tables(tables: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """The tables of a file with `table.key` -> value put in; what is no table there stays, as a
    fault of the file.

    A third name is a key of a table in a table, as `coupling.absolute_tolerances.block.x`.
    """
    changed = copy.deepcopy(dict(tables))
    for key, value in changes.items():
        *names, entry = key.split(".", 2)
        here: Any = changed
        for name in names:
            here = here.setdefault(name, {}) if isinstance(here, dict) else None
        if isinstance(here, dict):
            here[entry] = value
    return changed


def is_of_change(fault: str, changes: Mapping[str, Any]) -> bool:
    """Whether a fault's line, which begins with its key, is of a value that was changed."""
    key = fault.partition(":")[0]
    return any(key == changed or changed.startswith(f"{key}.") for changed in changes)
