"""An instance of a unit as a host written in C meets it, through ctypes: what FMI 2 and 3 share.

No tool in between puts an argument right, or turns a status into an exception. What each function
takes is read off the standard's headers.
"""

from __future__ import annotations

import ctypes
import re
import zipfile
from collections.abc import Mapping
from ctypes import byref, c_bool, c_char_p, c_double, c_int, c_int32, c_size_t, c_uint, c_void_p
from pathlib import Path

from cosim.fmu.native import built_guid, native_folder

OK, WARNING, DISCARD, ERROR = range(4)
_KINDS = {
    **{"fmi3Float64": c_double, "fmi3Boolean": c_bool, "fmi3Int32": c_int32, "size_t": c_size_t},
    **{"fmi3ValueReference": c_uint, "fmi3String": c_char_p, "fmi2Real": c_double},
    **dict.fromkeys(("fmi2Boolean", "fmi2Integer", "fmi2StatusKind"), c_int),
}


def _kind(argument: str):
    if "*" in argument or "[" in argument:
        return c_void_p
    return _KINDS.get(argument.split()[-2], c_void_p)  # else a handle, or a function


def functions(version: int) -> dict[str, list]:
    """Name without "fmi2" or "fmi3" -> types of its arguments behind the instance, of each function
    that returns a status."""
    fmi = f"fmi{version}"
    header = (native_folder() / "headers" / f"{fmi}FunctionTypes.h").read_text()
    found = re.findall(rf"typedef {fmi}Status +{fmi}(\w+)TYPE *\(([^;]*)\);", header)
    return {name: [_kind(each) for each in given.split(",")[1:]] for name, given in found}


def declare(library: ctypes.CDLL, version: int) -> None:
    """Tell ctypes of the functions that a library has."""
    for name, arguments in functions(version).items():
        function = getattr(library, f"fmi{version}{name}", None)
        if function is not None:
            function.argtypes, function.restype = (c_void_p, *arguments), c_int


def unpacked_library(fmu: Path, folder: Path, path: str) -> Path:
    """A library of a unit, in a folder."""
    with zipfile.ZipFile(fmu) as archive:
        return Path(archive.extract(path, folder))


class CUnit:
    """A library. kinds: of variables that are not real; sizes: of arrays; both by their names."""

    def __init__(
        self,
        fmu: Path,
        library: Path,
        version: int,
        references: Mapping[str, int],
        kinds: Mapping[str, tuple],
        sizes: Mapping[str, int],
    ) -> None:
        self.guid = built_guid(fmu).encode()
        self.library = ctypes.CDLL(str(library))
        declare(self.library, version)
        self.references, self.kinds, self.sizes = references, kinds, sizes


class CInstance:
    """One instance, which is freed at the end of a context. What is logged is in `messages`."""

    version: int
    #: How the version spells the functions of a number, what it is in C, and in Python.
    REAL: tuple
    #: How the versions spell what has to do with states.
    STATE, DESERIALIZE = "FMUState", "DeserializeFMUState"

    def __init__(self, unit) -> None:
        self.unit, self.handle = unit, None
        self.messages: list[tuple[int, str, str]] = []

    def __enter__(self):
        return self

    def __exit__(self, *_) -> None:
        free = self._function("FreeInstance")
        free.argtypes, free.restype = (c_void_p,), None
        free(self.handle)
        self.handle = None

    def _function(self, name: str):
        return getattr(self.unit.library, f"fmi{self.version}{name}")

    def call(self, function: str, *arguments) -> int:
        """Status of a function, called by its name without "fmi2" or "fmi3"."""
        return self._function(function)(self.handle, *arguments)

    def done(self, function: str, *arguments) -> None:
        """A call that must be taken."""
        assert self.call(function, *arguments) == OK, self.messages

    def reason(self, function: str, *arguments) -> str:
        """Why a call is refused, as logged; it must be."""
        self.messages.clear()
        assert self.call(function, *arguments) == ERROR
        ((status, category, text),) = self.messages
        assert (status, category) == (ERROR, "logStatusError")
        return text

    def _arguments(self, name: str, given=()) -> tuple:
        """The kind of a variable, and arguments of the function that gets or sets it."""
        size = self.unit.sizes.get(name, 1)
        kind, made, exact = self.unit.kinds.get(name, self.REAL)
        numbers = (made * size)(*map(exact, given))
        further = (size,) if self.version == 3 else ()
        return kind, byref(c_uint(self.unit.references[name])), 1, numbers, *further

    def set_arguments(self, name: str, *values: float) -> tuple:
        """Function and arguments that set a variable."""
        kind, *arguments = self._arguments(name, values)
        return f"Set{kind}", *arguments

    def set(self, name: str, *values: float) -> None:
        self.done(*self.set_arguments(name, *values))

    def value(self, name: str):
        """Of a variable, of an array all its values."""
        kind, *arguments = self._arguments(name)
        self.done(f"Get{kind}", *arguments)
        values = list(arguments[2])
        return values if len(values) > 1 else values[0]

    def everything(self) -> list:
        return [self.value(name) for name in self.unit.references]

    def save(self) -> c_void_p:
        state = c_void_p()
        self.done(f"Get{self.STATE}", byref(state))
        return state

    def restore(self, state: c_void_p) -> None:
        self.done(f"Set{self.STATE}", state)

    def forget(self, state: c_void_p) -> None:
        self.done(f"Free{self.STATE}", byref(state))
        assert state.value is None

    def as_bytes(self, state: c_void_p) -> bytes:
        size = c_size_t()
        self.done(f"Serialized{self.STATE}Size", state, byref(size))
        room = ctypes.create_string_buffer(size.value)
        self.done(f"Serialize{self.STATE}", state, room, size.value)
        return room.raw

    def from_bytes(self, content: bytes) -> c_void_p:
        state = c_void_p()
        self.done(self.DESERIALIZE, content, len(content), byref(state))
        return state
