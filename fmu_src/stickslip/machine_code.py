"""Libraries of C for this machine: compiled once, kept, and loaded by ctypes.

A library is kept in the user's cache folder under a name that carries a hash of all it is made of,
so that nobody ever meets stale code. An installed package may bring it along (`PREBUILT`).

Machine code is code: a folder that anybody else could have written to is not used. One that can
only be read is, and where there is none at all, the library serves this process alone.
"""

import ctypes
import hashlib
import logging
import os
import stat
import tempfile
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import platformdirs

from .generation.compiler import CALLED_BY_NAME, compile_into, compiled, require_compiler
from .generation.platforms import Platform, this_machine
from .scratch import scratch_folder

LOG = logging.getLogger(__name__)
#: Beside this file in an installed package.
PREBUILT = "prebuilt"


@dataclass(frozen=True)
class Code:
    """C that is called by the names of its functions.

    key : changes with whatever the sources are made of; sources : makes the files by their names
    """

    name: str
    key: str
    sources: Callable[[], Mapping[str, bytes]]

    def file(self, platform: Platform) -> str:
        """Name of the library."""
        digest = hashlib.sha256(self.key.encode()).hexdigest()[:16]
        return f"{self.name}-{platform.name}-{digest}{platform.suffix}"

    def prebuild(self, folder: Path, platforms: Sequence[Platform]) -> None:
        """Compile into ``folder``, for a package. Raises CompilerError."""
        sources = self.sources()
        compile_into(folder, sources, platforms, self.name, CALLED_BY_NAME, file=self.file)

    def load(self) -> ctypes.CDLL:
        """The library, compiled where it is not kept. Raises CompilerError or OSError."""
        here = this_machine()
        name = self.file(here)
        brought = Path(__file__).with_name(PREBUILT) / name
        if file := brought if brought.is_file() else kept(name):
            LOG.info("mechanical model: machine code in %s", file)
            return ctypes.CDLL(str(file))
        require_compiler(here)
        LOG.warning("compiling the mechanical model for this machine, once: a few seconds")
        made = compiled(self.sources(), [here], self.name, CALLED_BY_NAME, stays=True)[here]
        if there := keep(name, made):
            return ctypes.CDLL(str(there))
        # Windows removes no library that is loaded
        with scratch_folder("code") as scratch:
            file = Path(scratch) / name
            file.write_bytes(made)
            return ctypes.CDLL(str(file))


def kept(name: str) -> Path | None:
    """A library that was kept, as it was written; None where there is none."""
    files = [folder / name for folder in _folders() if _is_private(folder)]
    return next(filter(_is_whole, files), None)


def keep(name: str, content: bytes) -> Path | None:
    """The file, written where it will be found again; None for nowhere. Processes may race."""
    for folder in _folders():
        with suppress(OSError):
            folder.parent.mkdir(parents=True, exist_ok=True)
            with suppress(FileExistsError):
                folder.mkdir(mode=0o700)
            if _is_private(folder):
                for file, written in ((name, content), (_check(name), _digest(content))):
                    with scratch_folder("code", folder) as scratch:
                        partial = Path(scratch) / file
                        partial.write_bytes(written)
                        partial.replace(folder / file)
                return folder / name
    return None


def _check(name: str) -> str:
    """The file beside a library that says what it must be."""
    return f"{name}.sha256"


def _digest(content: bytes) -> bytes:
    return hashlib.sha256(content).hexdigest().encode()


def _is_whole(file: Path) -> bool:
    """Whether a library is there as it was written: a damaged one would end the process."""
    try:
        return file.with_name(_check(file.name)).read_bytes() == _digest(file.read_bytes())
    except OSError:
        return False


def _folders() -> list[Path]:
    """Where the machine code may be, the preferred first; used where `_is_private`."""
    own = f"stickslip-{os.getuid()}" if hasattr(os, "getuid") else "stickslip"
    folders = [platformdirs.user_cache_path("stickslip")]
    with suppress(FileNotFoundError):  # there may be no scratch folder at all
        folders.append(Path(tempfile.gettempdir()) / own)
    return folders


def _is_private(folder: Path) -> bool:
    """Whether a folder is there, this user's or root's, and theirs alone."""
    try:
        status, link = folder.stat(), folder.lstat()
    except OSError:
        return False
    if not stat.S_ISDIR(status.st_mode):
        return False
    if not hasattr(os, "getuid"):  # Windows: both folders are in the user's profile
        return True
    if not {status.st_uid, link.st_uid} <= {0, os.getuid()}:
        return False
    if status.st_mode & (stat.S_IWGRP | stat.S_IWOTH):
        _warn_of_others(folder)
        return False
    return True


@cache
def _warn_of_others(folder: Path) -> None:
    LOG.warning(
        "%s can be written to by others, so machine code in it is not used; allowed after: "
        "chmod go-w %s",
        *(folder, folder),
    )
