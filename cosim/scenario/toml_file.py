"""A TOML file as tables, and what is wrong with one that cannot be read, in one line.

`--set key=value` is what is said on the command line in place of what a file has.
"""

import copy
import re
import tomllib
from collections.abc import Collection, Iterable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from stickslip.text_file import MOST_TOML, read_text, tables_in

from cosim.scenario.validation import ScenarioError


def parsed(text: str, source: str | Path) -> dict[str, Any]:
    """The tables of a text; ScenarioError with line and column where it is no TOML."""
    try:
        return tables_in(text)
    except tomllib.TOMLDecodeError as error:
        fault = _with_line(str(error), text) + _comma(str(error), text)
        raise ScenarioError(f"{source}: not TOML: {fault}") from None
    except ValueError as error:
        # tomllib lets through what Python itself refuses: a number of 5000 digits, a date of
        # month 13
        raise ScenarioError(f"{source}: not TOML that can be used: {error}") from None


def text_of(source: str | Path) -> str:
    """The text of a file that exists; ScenarioError when it is none, or not in UTF-8."""
    path = Path(source)
    if path.is_dir():
        raise ScenarioError(f"{source}: is a folder, allowed is a TOML file")
    try:
        return read_text(path, MOST_TOML)
    except UnicodeDecodeError as error:
        raise ScenarioError(
            f"{source}: byte {error.start + 1} is not UTF-8, allowed is a TOML file in UTF-8"
        ) from None
    except OSError as error:
        raise ScenarioError(f"{source}: cannot be read: {error.strerror}") from None


def _comma(message: str, text: str) -> str:
    """A hint where the line has a number with a decimal comma; "" else."""
    found = re.search(r"at line (\d+)", message)
    line = text.splitlines()[int(found[1]) - 1] if found else ""
    number = re.search(r"=\s*([-+]?\d+),(\d+)\s*(#|$)", line)
    return f"; is {number[1]}.{number[2]} meant?" if number else ""


def _with_line(message: str, text: str) -> str:
    """tomllib's message; it names no line when the fault is only seen at the end."""
    last = f"at line {len(text.splitlines())}, end of document"
    message = message.replace("at end of document", last)
    return message[:1].lower() + message[1:]


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
