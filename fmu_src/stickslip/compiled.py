"""The kernel compiled by numba: the same source, function for function.

The kernel's files are joined into one module, whose name carries a hash of its text, and that
module is written to the user's cache folder and imported from there: numba keeps its machine code
beside a real file, and a changed kernel is a new module, so no run ever meets stale code.
"""

from __future__ import annotations

import hashlib
import importlib.util
import logging
import multiprocessing
import os
import sys
import tempfile
from functools import cache
from importlib.machinery import SourceFileLoader
from pathlib import Path
from types import FunctionType, ModuleType
from typing import Any

import llvmlite.binding
import numba
import platformdirs
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
    places = [folder / "__pycache__" for folder in _folders()]
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
    file = _write_module(name, source)
    kept = "there from an earlier run" if is_cached() else "made as it is needed"
    LOG.info("mechanical model: machine code %s, beside %s", kept, file)
    loader = SourceFileLoader(name, str(file))
    spec = importlib.util.spec_from_loader(name, loader)
    assert spec is not None  # there is a loader
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # numba's cache finds the functions again by this name
    loader.exec_module(module)
    for key, value in list(vars(module).items()):
        if isinstance(value, FunctionType) and value.__module__ == name:
            setattr(module, key, numba.njit(value, **OPTIONS))
    return module


def _name(source: str) -> str:
    # numba's cache does not know with which options it was filled, and fills itself anew for
    # another version or another kind of processor
    cpu = llvmlite.binding.get_host_cpu_name()
    key = f"{source}{OPTIONS}{numba.__version__}{cpu}"
    return "stickslip_kernel_" + hashlib.sha256(key.encode()).hexdigest()[:16]


def _folders() -> tuple[Path, ...]:
    """Where numba may keep its cache, the preferred first."""
    return platformdirs.user_cache_path("stickslip"), Path(tempfile.gettempdir())


def _write_module(name: str, source: str) -> Path:
    """Write the module where numba may keep its cache beside it; processes may race for it."""
    for folder in _folders():
        path = folder / f"{name}.py"
        if path.exists() and path.read_text(encoding="utf-8") == source:
            return path
        try:
            folder.mkdir(parents=True, exist_ok=True)
            partial = folder / f"{name}.{os.getpid()}.partial"
            partial.write_text(source, encoding="utf-8")
            partial.replace(path)
        except OSError:
            continue
        return path
    raise OSError("no folder for the compiled kernel is writable: set XDG_CACHE_HOME or TMPDIR")
