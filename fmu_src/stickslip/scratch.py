"""Scratch folders: removed by the process that made them, or by the next one where it was killed.

A folder is held by a lock on itself, which the system lets go of however a process ends.
"""

import os
import shutil
import tempfile
import weakref
from contextlib import suppress
from functools import cache
from pathlib import Path

try:
    import fcntl
except ImportError:  # Windows, where what is left stays
    fcntl = None  # type: ignore[assignment]

#: Of the names, so that nobody else's folder is taken for one.
PREFIX = "stickslip."
#: A folder that is made can be cleared away before it is held; where none can, none is cleared.
ATTEMPTS = 5


def scratch_folder(what: str, place: str | Path | None = None) -> tempfile.TemporaryDirectory[str]:
    """A fresh folder; OSError where there is no place for one.

    what : part of its name; place : the folder that it is made in, else that of temporary files
    """
    place = str(place or tempfile.gettempdir())
    _clear(place)
    for _ in range(ATTEMPTS):
        folder = tempfile.TemporaryDirectory(
            prefix=f"{PREFIX}{what}-", dir=place, ignore_cleanup_errors=True
        )
        held = _held(folder.name)
        if held is not None:
            weakref.finalize(folder, os.close, held)
            break
    return folder


@cache
def _clear(place: str) -> None:
    """Remove this user's folders that no living process holds."""
    if fcntl is None:
        return
    for folder in Path(place).glob(f"{PREFIX}*-*"):
        with suppress(OSError):
            if folder.lstat().st_uid != os.getuid():
                continue
            held = _held(folder)
            if held is not None:
                shutil.rmtree(folder, ignore_errors=True)
                os.close(held)


def _held(folder: str | Path) -> int | None:
    """The handle that holds a folder; None where another process does, or it is gone."""
    if fcntl is None:
        return None
    with suppress(OSError):
        handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
            if os.path.samestat(os.fstat(handle), os.stat(folder)):
                return handle
        except OSError:
            pass
        os.close(handle)
    return None
