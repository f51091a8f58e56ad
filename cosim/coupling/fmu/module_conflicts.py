"""What a process can have only once, and two units in it would share without knowing.

Python keeps one module of a name: the second unit that brings a module of that name would run the
code of the first. A process of its own for one of them (`isolate = true`) is the way out.
"""

import hashlib
import re
import sys
import sysconfig
from pathlib import Path

from fmpy.model_description import ModelDescription

from cosim.coupling.fmu.errors import FmuError

#: Name of a file in the resources by which pythonfmu's library finds the unit's module.
NAMES_MODULE = "slavemodule.txt"
#: Brought along by units and meant to be shared.
SHARED = ("pythonfmu", "pythonfmu3")
#: A module named by the hash of its contents, as those of our own units are.
NAMED_BY_CONTENTS = re.compile(r".+_[0-9a-f]{12,}")
WAY_OUT = "give one of them a process of its own: isolate = true"

#: Module -> unit that brought it, and what it is, for the life of this process.
_modules: dict[str, tuple[Path, str]] = {}
#: What units that may be there once only are there as, and their files.
_alone: dict[str, Path] = {}


def claim_modules(path: Path, folder: Path) -> None:
    """Note the Python modules that an unpacked unit brings; FmuError where others are there."""
    resources = folder / "resources"
    if not (resources / NAMES_MODULE).is_file():
        return
    main = (resources / NAMES_MODULE).read_text(encoding="utf-8", errors="replace").strip()
    brought = _brought(resources)
    for name, digest in brought.items():
        first, other = _modules.get(name, (path, digest))
        if other != digest:
            raise FmuError(
                f"{path}: brings a Python module named {name!r}, as {first} does, with other "
                f"contents; a process has one module of a name, so {WAY_OUT}"
            )
        if name not in _modules and _is_hidden(name, digest, name == main):
            raise FmuError(
                f"{path}: brings a Python module named {name!r}, and there is another one of that "
                "name in this process; give the unit a process of its own: isolate = true"
            )
    for name, digest in brought.items():
        _modules.setdefault(name, (path, digest))


def _brought(resources: Path) -> dict[str, str]:
    """Module or package at the top of a folder -> digest of its contents."""
    found = {}
    for each in sorted(resources.iterdir()):
        if each.is_dir() or each.suffix == ".py":
            name, digest = each.stem if each.is_file() else each.name, _digest(each)
            if digest is not None and name not in SHARED:
                found[name] = digest
    return found


def _digest(place: Path) -> str | None:
    """Of a module's file, or of all those of a package; None where there are none."""
    files = [place] if place.is_file() else sorted(place.rglob("*.py"))
    contents = hashlib.sha256()
    for file in files:
        contents.update(file.relative_to(place.parent).as_posix().encode() + b"\0")
        contents.update(hashlib.sha256(file.read_bytes()).digest())
    return contents.hexdigest() if files else None


def _is_hidden(name: str, digest: str, is_main: bool) -> bool:
    """Whether this process has another module of that name, which would run in its place.

    A helper that is installed here is taken as it is: a unit brings it for hosts without it. Where
    another host has run the unit in this process, what it unpacked may be gone: then a module is
    known by its name alone.
    """
    there = sys.modules.get(name)
    if there is None:
        return False
    file = Path(getattr(there, "__file__", None) or "")
    place = file.parent if file.name == "__init__.py" else file
    if place.exists() and place.name:
        if _digest(place) == digest:
            return False
    elif NAMED_BY_CONTENTS.fullmatch(name):
        return False
    installed = (sysconfig.get_path(key) for key in ("stdlib", "purelib", "platlib"))
    return is_main or not any(file.is_relative_to(folder) for folder in installed)


def claim_place(path: Path, description: ModelDescription) -> None:
    """Note a unit that a process can have only once; FmuError where it has it already."""
    if not description.coSimulation.canBeInstantiatedOnlyOncePerProcess:
        return
    if description.guid in _alone:
        raise FmuError(f"{path}: can be there only once in a process, so {WAY_OUT}")
    _alone[description.guid] = path


def leave_place(path: Path, description: ModelDescription) -> None:
    """The unit is gone."""
    if _alone.get(description.guid) == path:
        del _alone[description.guid]
