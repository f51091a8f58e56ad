"""Custom effects of a run that was interrupted: which files had the run, and are they the same.

A folder of results may be anybody's: only code is run that the command line itself names, and that
is as it was when the run began.
"""

import hashlib
import json
from collections.abc import Sequence
from pathlib import Path

from stickslip.catalogue import default_catalogue
from stickslip.effects import PluginError
from stickslip.text_file import MOST_TOML, read_text, tables_in


def digests(files: Sequence[Path]) -> dict[str, str]:
    """Absolute name of each file -> SHA-256 of what is in it; "" of what cannot be read."""
    return {str(file): _digest(file) for file in files}


def _digest(file: Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest() if file.is_file() else ""


def check_resumed(results: Path, named: Sequence[str]) -> None:
    """PluginError unless all effects' files of a run that was cut off are named, and as they were.

    Before its scenario is read, which executes the files that it names.
    """
    known = _known(results / "unfinished" / "run.json")
    now = digests([*default_catalogue().files, *(Path(name).resolve() for name in named)])
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
    scenario = results / "unfinished" / "scenario.toml"
    tables = tables_in(read_text(scenario, MOST_TOML)) if scenario.is_file() else {}
    asked = tables.get("effects", [])
    if unknown := [file for file in asked if str(file) not in known]:
        raise PluginError(
            f"{results}: names {unknown[0]}, but not the SHA-256 that it had when the run began, so"
            " its code is not run; allowed is to begin anew"
        )


def _known(manifest: Path) -> dict[str, str]:
    """Effects' file -> its SHA-256, as a run began; none of what is no such list."""
    try:
        effects = json.loads(manifest.read_text(encoding="utf-8"))["effects"]
        return {str(file): str(digest) for file, digest in effects.items()}
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return {}
