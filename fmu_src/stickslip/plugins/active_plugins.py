"""Which files this process has effects from: said once, before the first is asked for.

They stand in the environment, so that every process that this one starts has the same.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

from .errors import PluginError

#: Names of the files, joined as those of PATH are.
VARIABLE = "STICKSLIP_EFFECTS"
#: Entry points of installed distributions: each names a module with an EFFECT.
GROUP = "stickslip.effects"
#: Name of a file on the machine that sent it -> where it is here.
_ELSEWHERE: dict[str, Path] = {}
#: What is there once the effects have been read.
_READ = "stickslip.plugins.load"


def files() -> tuple[Path, ...]:
    """The files of this process, absolute, in the order of their effects."""
    named = os.environ.get(VARIABLE, "").split(os.pathsep)
    return tuple(dict.fromkeys(Path(name).resolve() for name in named if name))


def is_read() -> bool:
    """Whether this process has its effects, and can have no others."""
    return _READ in sys.modules


def known_as(name: str, file: Path) -> None:
    """Take the name that a file has on another machine for the one that was made of it here."""
    _ELSEWHERE[name] = file


def use(*names: str | Path) -> None:
    """Have the effects of these files, too, in this process and in those that it starts.

    Before anything else of `stickslip`, whose arrays are laid out for the effects that there are.
    Raises PluginError where that is past and a file is not among those that are there.
    As in `from stickslip.effects import use; use("brush.py")`.
    """
    resolved = (_ELSEWHERE.get(str(name), Path(name).resolve()) for name in names)
    wanted = dict.fromkeys((*files(), *resolved))
    if len(wanted) == len(files()):
        return
    late = next(file for file in wanted if file not in files())
    if is_read():
        raise PluginError(
            f"{late}: comes after the kernel was made; allowed is `from stickslip.effects import "
            f'use; use("{late.name}")` before anything else of stickslip is imported, or '
            f"{VARIABLE}={late} in the environment"
        )
    if os.pathsep in str(late):
        raise PluginError(f"{late}: has a {os.pathsep!r} in its name; allowed is one without")
    os.environ[VARIABLE] = os.pathsep.join(map(str, wanted))
