"""The kernel as machine code: its text as C, whose functions are called as Python's.

Where there is no compiler, the text runs interpreted.
"""

import ctypes
import logging
import re
from collections.abc import Callable
from importlib import resources
from types import ModuleType
from typing import Any

from .generation.c import c_header, c_source
from .generation.c_expressions import function_name
from .generation.compiler import CompilerError
from .machine_code import Code

LOG = logging.getLogger(__name__)

_SCALARS: dict[str, Any] = {
    "float": ctypes.c_double,
    "int": ctypes.c_int64,
    "bool": ctypes.c_bool,
    "None": None,
}
_ARRAY = ctypes.c_char * 0


class Library:
    """The functions of a kernel's text, by their names; arrays are numpy's, of floats, contiguous.

    A call releases the interpreter's lock: threads compute at the same time.
    """

    def __init__(self, text: str, library: ctypes.CDLL) -> None:
        self._text, self._library = text, library

    def __getattr__(self, name: str) -> Callable[..., Any]:
        """Bind a function when it is first asked for."""
        head = re.search(rf"^def {name}\((.*?)\)(?: -> (\w+))?:", self._text, re.M | re.S)
        if head is None:
            raise AttributeError(f"no function {name} in the kernel")
        kinds = re.findall(r"\w+: ([^,\s]+)", head[1])
        function = getattr(self._library, function_name(name))
        function.restype = _SCALARS[head[2] or "None"]
        function.argtypes = [_SCALARS.get(kind, ctypes.c_void_p) for kind in kinds]
        call = _without_loops(function, [kind not in _SCALARS for kind in kinds])
        setattr(self, name, call)
        return call


def _without_loops(function: Any, is_array: list[bool]) -> Callable[..., Any]:
    """A caller written out argument by argument, which takes a third of the time of a loop."""
    names = [f"a{i}" for i in range(len(is_array))]
    given = [f"at({n})" if array else n for n, array in zip(names, is_array, strict=True)]
    code = f"lambda {', '.join(names)}: f({', '.join(given)})"
    call: Callable[..., Any] = eval(code, {"f": function, "at": _ARRAY.from_buffer})
    return call


def library(text: str) -> Library | ModuleType:
    """A kernel's text as functions: compiled, where it is not yet kept, or else interpreted."""
    try:
        return Library(text, code(text).load())
    except (CompilerError, OSError) as error:
        LOG.warning("%s; without it the model runs interpreted, some 200 times slower", error)
    module = ModuleType("stickslip_kernel")
    exec(compile(text, "<kernel>", "exec"), vars(module))
    return module


def code(text: str) -> Code:
    """A kernel's text as C."""
    makers = resources.files("stickslip.generation").iterdir()
    made_by = sorted(each.read_text("utf-8") for each in makers if each.name[0] == "c")
    return Code("kernel", "\n".join([text, *made_by]), lambda: sources(text))


def sources(text: str) -> dict[str, bytes]:
    """The files of C."""
    made = {"kernel.h": c_header(text), "kernel.c": c_source(text)}
    return {name: content.encode() for name, content in made.items()}
