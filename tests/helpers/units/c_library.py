"""The text of a kernel as a library of C, with its functions as those of a Python module."""

from __future__ import annotations

import ast
import ctypes
import importlib.util
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
from stickslip.generation.c import c_header, c_source

FLAGS = "-std=c99 -O2 -ffp-contract=off -Wall -Wextra -Wpedantic -Wconversion -fPIC -shared"
_SCALARS = {"float": ctypes.c_double, "int": ctypes.c_int64, "bool": ctypes.c_bool}


def compiler() -> list[str]:
    """Command of the C compiler there is; empty where there is none."""
    for name in ("cc", "gcc", "clang"):
        if shutil.which(name):
            return [name]
    return [sys.executable, "-m", "ziglang", "cc"] if importlib.util.find_spec("ziglang") else []


class Library:
    """Functions by the names of the text; arrays are numpy's, of floats.

    Attributes
    ----------
    said : what the compiler said: its warnings
    """

    def __init__(self, text: str, folder: Path) -> None:
        (folder / "kernel.h").write_text(c_header(text), encoding="utf-8")
        (folder / "kernel.c").write_text(c_source(text), encoding="utf-8")
        made = folder / "kernel.so"
        done = subprocess.run(
            [*compiler(), *FLAGS.split(), "-o", made.name, "kernel.c", "-lm"],
            cwd=folder,
            capture_output=True,
            text=True,
        )
        assert done.returncode == 0, done.stderr
        self.said = done.stderr
        library = ctypes.CDLL(str(made))
        for node in ast.parse(text).body:
            if isinstance(node, ast.FunctionDef):
                setattr(self, node.name, _callable(library, node))


def _callable(library: ctypes.CDLL, node: ast.FunctionDef) -> Callable:
    kinds = [ast.unparse(each.annotation).strip("'\"") for each in node.args.args]
    function = getattr(library, f"stickslip_{node.name}")
    function.restype = _SCALARS.get(ast.unparse(node.returns)) if node.returns else None
    function.argtypes = [_SCALARS.get(kind, ctypes.c_void_p) for kind in kinds]

    def call(*given):
        return function(
            *(
                each if kind in _SCALARS else _address(each)
                for kind, each in zip(kinds, given, strict=True)
            )
        )

    return call


def _address(array: np.ndarray) -> int:
    assert array.dtype == np.float64 and array.flags.c_contiguous
    return array.ctypes.data
