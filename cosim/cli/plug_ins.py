"""Effects from files of their own, for a command: found in what its arguments name, and loaded.

A process has one set of effects, laid out when the model is first imported. So the files are looked
for before that, in the text of every scenario and campaign that is named; a process that has the
model already, with other effects, hands the command to a new one.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

#: Files that a folder among the arguments can stand for: a campaign's, and that of a run cut off.
INSIDE = ("campaign.toml", "unfinished/scenario.toml")
#: Commands whose arguments can be effects' files themselves.
TAKE_FILES = ("build", "effects")
SUFFIX = ".py"


def handed_on(argv: Sequence[str], ending: bool) -> int | None:
    """Have the effects that the arguments ask for; the exit status where another process did all.

    ending : whether this process ends with the command. Raises PluginError for a file that is none.
    """
    named = files_named(argv)
    if not named:
        if os.environ.get("STICKSLIP_EFFECTS"):
            load()
        return None
    from stickslip.plugins import VARIABLE, files, use

    lacking = [file for file in named if file.resolve() not in files()]
    if lacking and ("stickslip.effects.outside" in sys.modules or not ending):
        known = os.pathsep.join(map(str, (*files(), *(file.resolve() for file in lacking))))
        command = [sys.executable, "-m", "cosim", *argv]
        return subprocess.run(command, env=os.environ | {VARIABLE: known}, check=False).returncode
    use(*named)
    load()
    return None


def is_of_an_effect(error: Exception) -> bool:
    """Whether it says what is wrong with an effect from outside, whenever that was read."""
    errors = sys.modules.get("stickslip.plugins.errors")
    return errors is not None and isinstance(error, errors.PluginError)


def load() -> None:
    """Read all effects now, and look at what they need of the units; PluginError."""
    from stickslip.effects import EFFECTS, PluginError, catalogue
    from stickslip.effects import FILES as CATALOGUE
    from stickslip.plugins.load import file_of
    from stickslip.quantity import details

    from cosim.fmu.units import UNITS

    for effect in EFFECTS[len(catalogue(CATALOGUE)) :]:
        stated = {f"{key}": details(field) for key, field in effect.table.model_fields.items()}
        units = {key: said["unit"] for key, said in stated.items()}
        units |= {state.name: state.unit for state in effect.states}
        for key, unit in units.items():
            if unit not in UNITS:
                raise PluginError(
                    f"{file_of(effect) or effect.id}: {key} is in {unit!r}, which no unit has; "
                    f"allowed is one of {', '.join(UNITS)}"
                )
    try:
        from stickslip.generation.c_program import Program
        from stickslip.generation.source import kernel_source

        Program(kernel_source())  # refuses two functions of one name, as the layout does numbers
    except ValueError as error:
        names = ", ".join(str(file_of(each)) for each in EFFECTS if file_of(each))
        raise PluginError(f"{names}: {error}") from None


def files_named(argv: Sequence[str]) -> list[Path]:
    """Effects' files that arguments name: themselves, or in the scenarios and campaigns there."""
    found = []
    takes_files = any(word in TAKE_FILES for word in argv[:2])
    for word in argv:
        path = Path(word)
        if takes_files and word.endswith(SUFFIX) and not word.startswith("-"):
            found.append(path)
        # not Path.is_file: it raises where a word is too long for a name, as many values can be
        elif path.suffix == ".toml" and os.path.isfile(word):
            found += _in_toml(path)
        elif os.path.isdir(word):
            found += [file for name in INSIDE for file in _in_toml(path / name)]
    return list(dict.fromkeys(found))


def _in_toml(path: Path) -> list[Path]:
    """None of what cannot be read: the command will say what is wrong with it."""
    try:
        text = path.read_text(encoding="utf-8-sig")
        tables: dict[str, Any] = tomllib.loads(text) if "effects" in text else {}
    except (OSError, ValueError, RecursionError):
        return []
    model = tables.get("model")
    places = [tables, model] if isinstance(model, dict) else [tables]
    named = [each.get("effects") for each in places]
    lists = [each for each in named if isinstance(each, list)]
    return [path.parent / name for each in lists for name in each if isinstance(name, str) and name]
