"""Effects from files of their own, for a command: found in what its arguments name, and loaded.

A process has one set of effects, laid out when the model is first imported. So the files are looked
for before that, in the text of every scenario and campaign that is named; a process that has the
model already, with other effects, hands the command to a new one.

A folder of results may be anybody's: of a run that was cut off, only code is run that the command
line itself names, and that is as it was when the run began.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

#: The file that a folder among the arguments stands for, and commands that take such a folder.
INSIDE, OF_CAMPAIGNS = "campaign.toml", ("gap", "plan")
#: Commands whose arguments can be effects' files themselves.
TAKE_FILES = ("build", "effects")
#: Options whose value is no scenario and no campaign.
WRITTEN = ("-o", "--output", "--json", "--fmu", "--resume")
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
    """Effects' files that arguments name: themselves, or in the scenarios and campaigns there.

    PluginError for those of a run to go on with that it cannot be resumed.
    """
    if "run" in argv[:2] and (resumed := _RESUMING.parse_known_args(argv)[0]).resume:
        return _of_resumed(Path(resumed.resume), resumed.effects)
    found = []
    takes_files = any(word in TAKE_FILES for word in argv[:2])
    takes_folders = any(word in OF_CAMPAIGNS for word in argv[:2])
    for before, word in zip(("", *argv), argv, strict=False):
        path = Path(word)
        if before in WRITTEN:
            continue
        if takes_files and word.endswith(SUFFIX) and not word.startswith("-"):
            found.append(path)
        # not Path.is_file: it raises where a word is too long for a name, as many values can be
        elif path.suffix == ".toml" and os.path.isfile(word):
            found += _in_toml(path)
        elif takes_folders and os.path.isdir(word):
            found += _in_toml(path / INSIDE)
    return list(dict.fromkeys(found))


#: What `run` is told to go on with.
_RESUMING = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
_RESUMING.add_argument("--resume", nargs="?")
_RESUMING.add_argument("--effects", nargs="*", default=[])


def digests(files: Sequence[Path]) -> dict[str, str]:
    """Absolute name of each file -> SHA-256 of what is in it; "" of what cannot be read."""
    return {str(file): _digest(file) for file in files}


def _digest(file: Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest() if file.is_file() else ""


def _of_resumed(results: Path, named: Sequence[str]) -> list[Path]:
    """The effects' files of a run that was cut off, all of them named, none of them changed."""
    from stickslip.plugins import PluginError, files

    known = _known(results / "unfinished" / "run.json")
    now = digests([*files(), *(Path(name).resolve() for name in named)])
    for file, digest in now.items():
        if not digest or known.get(file) != digest:
            what = "has changed since that began" if file in known else "is not one of its effects"
            raise PluginError(
                f"{results}: goes on with a run as it was begun, and {file} {what}; allowed "
                f"are {', '.join(known) or 'no effects of your own'}, or to begin anew"
            )
    lacking = [file for file in known if file not in now]
    if lacking:
        raise PluginError(
            f"{results}: its run has custom effects, whose code is run only where you name "
            f"it; allowed is, if you trust them, --effects {' '.join(known)}"
        )
    asked = [str(file) for file in _in_toml(results / "unfinished" / "scenario.toml")]
    if unknown := [file for file in asked if file not in known]:
        raise PluginError(
            f"{results}: names {unknown[0]}, but not the SHA-256 that it had when the run began, so"
            " its code is not run; allowed is to begin anew"
        )
    return [Path(file) for file in known]


def _known(manifest: Path) -> dict[str, str]:
    """Effects' file -> its SHA-256, as a run began; none of what is no such list."""
    try:
        effects = json.loads(manifest.read_text(encoding="utf-8"))["effects"]
        return {str(file): str(digest) for file, digest in effects.items()}
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return {}


def _in_toml(path: Path) -> list[Path]:
    """None of what cannot be read: the command will say what is wrong with it."""
    from stickslip.text_file import MOST_TOML, read_text, tables_in

    try:
        if not path.is_file():  # a pipe can be read once
            return []
        text = read_text(path, MOST_TOML)
        tables = tables_in(text) if "effects" in text else {}
    except (OSError, ValueError):
        return []
    model = tables.get("model")
    places = [tables, model] if isinstance(model, dict) else [tables]
    named = [each.get("effects") for each in places]
    lists = [each for each in named if isinstance(each, list)]
    return [path.parent / name for each in lists for name in each if isinstance(name, str) and name]
