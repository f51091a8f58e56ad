"""The kernel as machine code: its text as C, compiled once for this machine, called by ctypes.

A library is kept in the user's cache folder under a name that carries a hash of all it is made of,
so that no run ever meets stale code. An installed package may bring it along (`PREBUILT`).

Machine code is code: a folder that anybody else could have written to is not used. One that can
only be read is, and where there is none at all, the library is made in a scratch folder for this
process. Where there is no compiler, the text runs interpreted.
"""

from __future__ import annotations

import ctypes
import hashlib
import logging
import os
import re
import stat
import tempfile
import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import cache
from importlib import resources
from pathlib import Path
from types import ModuleType
from typing import Any

import platformdirs

from .generation.c import c_header, c_source
from .generation.c_expressions import function_name
from .generation.compiler import CALLED_BY_NAME, CompilerError, compiled
from .generation.platforms import Platform, this_machine
from .generation.source import kernel_source

LOG = logging.getLogger(__name__)
#: Beside this file in an installed package: the library of the packaged effects.
PREBUILT = "prebuilt"

_SCALARS: dict[str, Any] = {
    "float": ctypes.c_double,
    "int": ctypes.c_int64,
    "bool": ctypes.c_bool,
    "None": None,
}
_ARRAY = ctypes.c_char * 0
_LOADING = threading.Lock()


class Library:
    """The functions of a kernel's text, by their names; arrays are numpy's, of floats, contiguous.

    A call releases the interpreter's lock: threads compute at the same time.
    """

    def __init__(self, text: str, file: Path) -> None:
        self._text, self._library = text, ctypes.CDLL(str(file))

    def __getattr__(self, name: str) -> Callable[..., Any]:
        """Bind a function when it is first asked for."""
        head = re.search(rf"^def {name}\((.*?)\)(?: -> (\w+))?:", self._text, re.M | re.S)
        if head is None:
            raise AttributeError(f"no function {name} in the kernel")
        arguments = re.findall(r"(\w+): ([^,\s]+)", head[1])
        function = getattr(self._library, function_name(name))
        function.restype = _SCALARS[head[2] or "None"]
        function.argtypes = [_SCALARS.get(kind, ctypes.c_void_p) for _, kind in arguments]
        call = _without_loops(function, [kind not in _SCALARS for _, kind in arguments])
        setattr(self, name, call)
        return call


def _without_loops(function: Any, is_array: list[bool]) -> Callable[..., Any]:
    """A caller written out argument by argument, which takes half the time of one that loops."""
    names = [f"a{i}" for i in range(len(is_array))]
    given = [f"at({n})" if array else n for n, array in zip(names, is_array, strict=True)]
    code = f"lambda {', '.join(names)}: f({', '.join(given)})"
    call: Callable[..., Any] = eval(code, {"f": function, "at": _ARRAY.from_buffer})
    return call


@cache
def compiled_kernel() -> Any:
    """The kernel's functions: a `Library`, or a module that is interpreted."""
    with _LOADING:
        return library(kernel_source())


def library(text: str) -> Library | ModuleType:
    """A kernel's text as functions, compiled where it is not yet kept; else interpreted."""
    here = this_machine()
    name = _name(text, here)
    for folder in (Path(__file__).with_name(PREBUILT), *filter(_is_private, _folders())):
        if (file := folder / name).is_file():
            LOG.info("mechanical model: machine code in %s", file)
            return Library(text, file)
    LOG.warning("compiling the mechanical model for this machine, once: a few seconds")
    try:
        made = compiled(sources(text), [here], "kernel", CALLED_BY_NAME, stays=True)
        return _loaded(text, name, made[here])
    except (CompilerError, OSError) as error:
        LOG.warning("%s; until then the model runs interpreted, some 200 times slower", error)
        return _interpreted(text)


def sources(text: str) -> dict[str, bytes]:
    """A kernel's text as files of C."""
    made = {"kernel.h": c_header(text), "kernel.c": c_source(text)}
    return {name: content.encode() for name, content in made.items()}


def prebuild(folder: Path, platforms: Sequence[Platform]) -> None:
    """Compile the kernel into ``folder``, for a package. Raises CompilerError."""
    text = kernel_source()
    folder.mkdir(parents=True)
    for platform, made in compiled(sources(text), platforms, "kernel", CALLED_BY_NAME).items():
        (folder / _name(text, platform)).write_bytes(made)


def _name(text: str, platform: Platform) -> str:
    """File of a library: what it is made from, by what, and for which machine."""
    makers = resources.files("stickslip.generation").iterdir()
    made_by = sorted(each.read_text("utf-8") for each in makers if each.name[0] == "c")
    key = "\n".join([text, *made_by])
    digest = hashlib.sha256(key.encode()).hexdigest()[:16]
    return f"kernel-{platform.name}-{digest}{platform.suffix}"


def _loaded(text: str, name: str, content: bytes) -> Library:
    """A library that was just made, kept for the next process where that can be."""
    if file := _kept(name, content):
        return Library(text, file)
    # Windows removes no library that is loaded
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as scratch:
        file = Path(scratch) / name
        file.write_bytes(content)
        return Library(text, file)


def _kept(name: str, content: bytes) -> Path | None:
    """The file, written where it will be found again; None for nowhere. Processes may race."""
    for folder in _folders():
        partial = folder / f"{name}.{os.getpid()}.partial"
        with suppress(OSError):
            folder.parent.mkdir(parents=True, exist_ok=True)
            with suppress(FileExistsError):
                folder.mkdir(mode=0o700)
            if _is_private(folder):
                partial.write_bytes(content)
                return partial.replace(folder / name)
    return None


def _interpreted(text: str) -> ModuleType:
    module = ModuleType("stickslip_kernel")
    exec(compile(text, "<kernel>", "exec"), vars(module))
    return module


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
