"""A native unit as a host written in C meets it, through ctypes, for FMI 2.0 or 3.0.

No tool in between puts an argument right, or turns a status into an exception. What each function
takes is read off the standard's headers.
"""

from __future__ import annotations

import ctypes
import re
import zipfile
from collections.abc import Iterable, Sequence
from ctypes import byref, c_bool, c_char_p, c_double, c_int, c_int32, c_size_t, c_uint, c_void_p
from pathlib import Path

from fmpy.fmi2 import fmi2CallbackFunctions, fmi2CallbackLoggerTYPE
from fmpy.fmi3 import fmi3LogMessageCallback
from plain_start import PLAIN
from stickslip.generation.platforms import this_platform

from cosim.fmu import exchange
from cosim.fmu.native import NAME, built_guid, native_folder
from cosim.fmu.variables import Variable, by_array, variables

OK, WARNING, DISCARD, ERROR = range(4)
MODEL_EXCHANGE, CO_SIMULATION = 0, 1
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


def library_of(fmu: Path, folder: Path, name: str = NAME, version: int = 2) -> Path:
    """The library for this machine, unpacked into a folder."""
    platform = this_platform()
    where = platform.name if version == 3 else platform.fmi2
    with zipfile.ZipFile(fmu) as archive:
        return Path(archive.extract(f"binaries/{where}/{name}{platform.suffix}", folder))


def references(declared: Sequence[Variable] | None = None) -> dict[str, int]:
    """Name -> value reference, in FMI 2."""
    declared = variables() if declared is None else declared
    return {variable.name: place for place, variable in enumerate(declared)}


def references3() -> dict[str, int]:
    """Name -> value reference in FMI 3, of an array that of its first element."""
    places, all_of_it = references(exchange.variables()), by_array(exchange.variables())
    found = {each[0].array or each[0].name: places[each[0].name] for each in all_of_it}
    return found | {"time": len(places)}


class Unit:
    """A library; `instance` makes instances. name, declared: of another unit than the block's."""

    def __init__(
        self, fmu: Path, folder: Path, name: str = NAME, declared: Sequence[Variable] | None = None
    ) -> None:
        self.version = 3 if "fmi3" in fmu.name else 2
        self.guid = built_guid(fmu).encode()
        self.library = ctypes.CDLL(str(library_of(fmu, folder, name, self.version)))
        declare(self.library, self.version)
        #: How many elements an array has; kinds of variables that are not real.
        self.sizes: dict[str, int] = {}
        if self.version == 2:
            declared = variables() if declared is None else declared
            self.references = references(declared)
            self.kinds = {v.name: ("Integer", c_int, int) for v in declared if v.type == "Integer"}
            self.library.fmi2Instantiate.restype = c_void_p
        else:
            declared, self.references = exchange.variables(), references3()
            self.sizes = {e[0].array or e[0].name: len(e) for e in by_array(declared)}
            self.kinds = {v.name: ("Int32", c_int32, int) for v in declared if v.type == "Integer"}
            self.kinds |= {v.name: ("Boolean", c_bool, bool) for v in declared if v.is_boolean}

    def instance(self, **how) -> Instance2 | Instance3:
        """A new one; how: what differs from what is usual and right."""
        return (Instance3 if self.version == 3 else Instance2)(self, **how)


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

    def get(self, name: str):
        """Value of a variable, of an array all its values."""
        kind, *arguments = self._arguments(name)
        self.done(f"Get{kind}", *arguments)
        values = list(arguments[2])
        return values if len(values) > 1 else values[0]

    def everything(self) -> list:
        return [self.get(name) for name in self.unit.references]

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


class Instance2(CInstance):
    version, STATE, DESERIALIZE = 2, "FMUstate", "DeSerializeFMUstate"
    REAL = "Real", c_double, float

    def __init__(
        self,
        unit: Unit,
        exchanges: bool = False,
        logging: bool = False,
        name: bytes | None = b"block",
        guid: bytes | None = b"",
        resources: bytes | None = None,
        kind: int | None = None,
    ) -> None:
        super().__init__(unit)
        self._callbacks = fmi2CallbackFunctions(logger=fmi2CallbackLoggerTYPE(self._log))
        guid = unit.guid if guid == b"" else guid
        kind = kind if kind is not None else MODEL_EXCHANGE if exchanges else CO_SIMULATION
        given = (name, kind, guid, resources, byref(self._callbacks), 0, int(logging))
        self.handle = unit.library.fmi2Instantiate(*given)

    def _log(self, _environment, _name, status, category, text) -> None:
        self.messages.append((status, category.decode(), text.decode() % ()))

    def begin(self, start: float = 0.0, **values: float) -> Instance2:
        """As far as the first step."""
        for name, value in values.items():
            self.set(name, value)
        self.done("SetupExperiment", 0, 0.0, start, 0, 0.0)
        self.done("EnterInitializationMode")
        self.done("ExitInitializationMode")
        return self

    def march(self, steps: Iterable[int], size: float, start: float = 0.0) -> None:
        for n in steps:
            self.done("DoStep", start + n * size, size, 1)


class Instance3(CInstance):
    version = 3
    REAL = "Float64", c_double, float

    def __init__(
        self,
        unit: Unit,
        exchanges: bool = False,
        events: bool = False,
        early: bool = False,
        name: bytes | None = b"block",
        token: bytes | None = b"",
        required: int = 0,
    ) -> None:
        super().__init__(unit)
        self.time = 0.0
        self._logger = fmi3LogMessageCallback(self._log)
        token = unit.guid if token == b"" else token
        first = (name, token, None, c_bool(False), c_bool(False))
        if exchanges:
            make, given = unit.library.fmi3InstantiateModelExchange, (None, self._logger)
        else:
            make, how = unit.library.fmi3InstantiateCoSimulation, (c_bool(events), c_bool(early))
            given = (*how, None, c_size_t(required), None, self._logger, None)
        make.restype = c_void_p
        self.handle = make(*first, *given)

    def _log(self, _environment, status, category, text) -> None:
        self.messages.append((status, category.decode(), text.decode()))

    def begin(self, **values) -> Instance3:
        for name, value in {"surface_speed": 0.15, **PLAIN, **values}.items():
            self.set(name, *(value if isinstance(value, (list, tuple)) else [value]))
        self.done("EnterInitializationMode", False, 0.0, 0.0, False, 0.0)
        self.done("ExitInitializationMode")
        return self

    def update(self) -> list:
        told = [*(c_bool() for _ in range(5)), c_double()]
        self.done("UpdateDiscreteStates", *map(byref, told))
        return [each.value for each in told]

    def handle_event(self) -> None:
        self.done("EnterEventMode")
        self.update()
        self.done("EnterStepMode")

    def step(self, size: float) -> tuple[bool, bool]:
        """Event, early return; the time reached is in `time`."""
        event, end, early, reached = c_bool(), c_bool(), c_bool(), c_double()
        told = map(byref, (event, end, early, reached))
        self.done("DoStep", self.time, size, True, *told)
        assert not end.value
        self.time = reached.value
        return event.value, early.value
