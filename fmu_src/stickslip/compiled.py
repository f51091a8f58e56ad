"""The kernel compiled by numba: the same source, function for function.

The kernel's files are joined into one module, whose name carries a hash of its text, and that
module is written to the user's cache folder and imported from there: numba keeps its machine code
beside a real file, and a changed kernel is a new module, so no run ever meets stale code.

Machine code is code: a folder that anybody else could have written to is not used. One that can
only be read is, and where there is none at all, the kernel is compiled in memory.
"""

from __future__ import annotations

import hashlib
import importlib.util
import logging
import multiprocessing
import os
import stat
import sys
import tempfile
from contextlib import suppress
from functools import cache
from importlib.machinery import SourceFileLoader
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any

import llvmlite.binding
import numba
import platformdirs
from numba.core.caching import (
    CompileResultCacheImpl,
    FunctionCache,
    InTreeCacheLocator,
    UserProvidedCacheLocator,
)
from numba.core.cpu import CPUTargetOptions

from .generation.source import kernel_source

# The kernel makes no arrays, so nobody need count who holds one: without the counting a call costs
# a third. The option has no public name; where a version of numba drops it, only speed is lost.
OPTIONS: dict[str, Any] = {"cache": True, "error_model": "numpy", "nogil": True}
if hasattr(CPUTargetOptions, "_nrt"):
    OPTIONS["_nrt"] = False


LOG = logging.getLogger(__name__)
#: The function that calls all others of a run, and so is compiled last.
LAST = "advance"


def is_cached() -> bool:
    """Has machine code of this kernel been made on this machine before?"""
    kept = f"{_name(kernel_source())}.{LAST}-*.py{sys.version_info[0]}{sys.version_info[1]}*.nbi"
    places = [folder / "__pycache__" for folder in _folders() if _is_private(folder)]
    if chosen := getattr(
        numba.config, "CACHE_DIR", ""
    ):  # by NUMBA_CACHE_DIR; a folder in it for each module's
        places = list(Path(chosen).glob("*"))
    return any(next(place.glob(kept), None) for place in places)


@cache
def say_if_compiling() -> None:
    """A word to the log, once, where the first use of the kernel will take long.

    For whoever has the work done by other processes, which say nothing; `compiled_kernel` says it
    by itself.
    """
    if multiprocessing.current_process().name == "MainProcess" and not is_cached():
        LOG.warning(
            "compiling the mechanical model for this machine, once: a minute or so, more on a "
            "busy one"
        )


@cache
def compiled_kernel() -> ModuleType:
    """The kernel as a module of numba functions; machine code is cached between processes."""
    say_if_compiling()
    source = kernel_source()
    name = _name(source)
    file = _module_file(name, source)
    kept = "there from an earlier run" if is_cached() else "made as it is needed"
    where = "in memory" if file is None else f"beside {file}"
    LOG.info("mechanical model: machine code %s, %s", kept, where)
    module = _in_memory(name, source) if file is None else _from_file(name, file)
    for key, value in list(vars(module).items()):
        if isinstance(value, FunctionType) and value.__module__ == name:
            setattr(module, key, _compiled(value, keep=file is not None))
    return module


def _from_file(name: str, file: Path) -> ModuleType:
    loader = SourceFileLoader(name, str(file))
    spec = importlib.util.spec_from_loader(name, loader)
    assert spec is not None  # there is a loader
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # numba's cache finds the functions again by this name
    loader.exec_module(module)
    return module


def _in_memory(name: str, source: str) -> ModuleType:
    module = sys.modules[name] = ModuleType(name)
    exec(compile(source, f"<{name}>", "exec"), vars(module))
    return module


class _Beside(InTreeCacheLocator):
    """Machine code beside the module, also where it can only be read."""

    def ensure_cache_path(self) -> None:
        with suppress(OSError):
            super().ensure_cache_path()


class _Kept(CompileResultCacheImpl):
    _locator_classes: list[type[object]] = [UserProvidedCacheLocator, _Beside]  # noqa: RUF012


class _Cache(FunctionCache):
    """numba's own, but for what cannot be written: it is compiled again in the next process."""

    _impl_class = _Kept

    def save_overload(self, signature: Any, compiled: Any) -> None:
        with suppress(OSError):
            super().save_overload(signature, compiled)


def _compiled(function: FunctionType, keep: bool) -> Any:
    dispatcher: Any = numba.njit(function, **OPTIONS | {"cache": False})
    if keep:
        dispatcher._cache = _Cache(function)
    return dispatcher


def _name(source: str) -> str:
    # numba's cache does not know with which options it was filled, and fills itself anew for
    # another version or another kind of processor
    cpu = llvmlite.binding.get_host_cpu_name()
    key = f"{source}{OPTIONS}{numba.__version__}{cpu}"
    return "stickslip_kernel_" + hashlib.sha256(key.encode()).hexdigest()[:16]


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


def _module_file(name: str, source: str) -> Path | None:
    """The module, found or written where numba may keep its cache beside it; None for nowhere.

    Processes may race for it.
    """
    folders = _folders()
    for path in (folder / f"{name}.py" for folder in folders if _is_private(folder)):
        if path.exists() and path.read_text(encoding="utf-8") == source:
            return path
    for folder in folders:
        path = folder / f"{name}.py"
        partial = folder / f"{name}.{os.getpid()}.partial"
        with suppress(OSError):
            folder.parent.mkdir(parents=True, exist_ok=True)
            with suppress(FileExistsError):
                folder.mkdir(mode=0o700)
            if _is_private(folder):
                partial.write_text(source, encoding="utf-8")
                partial.replace(path)
                return path
    return None
