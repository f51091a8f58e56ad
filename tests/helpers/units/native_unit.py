"""The native unit as a host written in C meets it: the functions of its library, through ctypes.

No tool in between puts an argument right, or turns a status into an exception.
"""

from __future__ import annotations

import ctypes
import zipfile
from collections.abc import Iterable, Sequence
from ctypes import POINTER, byref, c_char_p, c_double, c_int, c_size_t, c_uint, c_void_p
from pathlib import Path
from types import TracebackType

from stickslip.generation.platforms import this_platform

from cosim.fmu.native import NAME, built_guid
from cosim.fmu.variables import Variable, variables

OK, WARNING, DISCARD, ERROR = range(4)
MODEL_EXCHANGE, CO_SIMULATION = 0, 1

_LOGGER = ctypes.CFUNCTYPE(None, c_void_p, c_char_p, c_int, c_char_p, c_char_p)
_REAL = (POINTER(c_uint), c_size_t, POINTER(c_double))
_INTEGER = (POINTER(c_uint), c_size_t, POINTER(c_int))
_NUMBERS = (POINTER(c_double), c_size_t)
_TEXT = (POINTER(c_uint), c_size_t, POINTER(c_char_p))


class EventInfo(ctypes.Structure):
    """fmi2EventInfo"""

    _fields_ = [
        ("new_discrete_states_needed", c_int),
        ("terminate", c_int),
        ("nominals_changed", c_int),
        ("states_changed", c_int),
        ("has_next", c_int),
        ("next", c_double),
    ]


#: What each function takes behind the instance.
ARGUMENTS = {
    "SetDebugLogging": (c_int, c_size_t, POINTER(c_char_p)),
    "SetupExperiment": (c_int, c_double, c_double, c_int, c_double),
    "EnterInitializationMode": (),
    "ExitInitializationMode": (),
    "Terminate": (),
    "Reset": (),
    "GetReal": _REAL,
    "GetInteger": _INTEGER,
    "GetBoolean": _INTEGER,
    "GetString": _TEXT,
    "SetReal": _REAL,
    "SetInteger": _INTEGER,
    "SetBoolean": _INTEGER,
    "SetString": _TEXT,
    "GetFMUstate": (POINTER(c_void_p),),
    "SetFMUstate": (c_void_p,),
    "FreeFMUstate": (POINTER(c_void_p),),
    "SerializedFMUstateSize": (c_void_p, POINTER(c_size_t)),
    "SerializeFMUstate": (c_void_p, c_char_p, c_size_t),
    "DeSerializeFMUstate": (c_char_p, c_size_t, POINTER(c_void_p)),
    "DoStep": (c_double, c_double, c_int),
    "CancelStep": (),
    "SetRealInputDerivatives": (POINTER(c_uint), c_size_t, POINTER(c_int), POINTER(c_double)),
    "GetDirectionalDerivative": (
        *(POINTER(c_uint), c_size_t),
        *(POINTER(c_uint), c_size_t),
        *(POINTER(c_double), POINTER(c_double)),
    ),
    "GetStatus": (c_int, POINTER(c_int)),
    "GetRealStatus": (c_int, POINTER(c_double)),
    "GetIntegerStatus": (c_int, POINTER(c_int)),
    "GetBooleanStatus": (c_int, POINTER(c_int)),
    "GetStringStatus": (c_int, POINTER(c_char_p)),
    "EnterEventMode": (),
    "NewDiscreteStates": (POINTER(EventInfo),),
    "EnterContinuousTimeMode": (),
    "CompletedIntegratorStep": (c_int, POINTER(c_int), POINTER(c_int)),
    "SetTime": (c_double,),
    "SetContinuousStates": _NUMBERS,
    "GetContinuousStates": _NUMBERS,
    "GetDerivatives": _NUMBERS,
    "GetEventIndicators": _NUMBERS,
    "GetNominalsOfContinuousStates": _NUMBERS,
}


#: Those of model exchange.
OF_EXCHANGE = tuple(ARGUMENTS)[tuple(ARGUMENTS).index("EnterEventMode") :]


class _Callbacks(ctypes.Structure):
    _fields_ = [
        ("logger", _LOGGER),
        ("allocate", c_void_p),
        ("free", c_void_p),
        ("step_finished", c_void_p),
        ("environment", c_void_p),
    ]


def library_of(fmu: Path, folder: Path, name: str = NAME) -> Path:
    """The library for this machine, unpacked into a folder."""
    platform = this_platform()
    assert platform is not None
    with zipfile.ZipFile(fmu) as archive:
        return Path(archive.extract(f"binaries/{platform.fmi2}/{name}{platform.suffix}", folder))


def references(declared: Sequence[Variable] | None = None) -> dict[str, int]:
    """Name -> value reference."""
    declared = variables() if declared is None else declared
    return {variable.name: place for place, variable in enumerate(declared)}


class Unit:
    """A library; `instance` makes instances, which are freed with it as a context.

    name, declared: of another unit than the mechanical one; without: functions it has not.
    """

    def __init__(
        self,
        fmu: Path,
        folder: Path,
        name: str = NAME,
        declared: Sequence[Variable] | None = None,
        without: Iterable[str] = (),
    ) -> None:
        guid = built_guid(fmu)
        assert guid is not None
        self.guid = guid.encode()
        self.library = ctypes.CDLL(str(library_of(fmu, folder, name)))
        self.library.fmi2Instantiate.restype = c_void_p
        for name, arguments in ARGUMENTS.items():
            if name in without:
                continue
            function = getattr(self.library, f"fmi2{name}")
            function.argtypes, function.restype = (c_void_p, *arguments), c_int
        declared = variables() if declared is None else declared
        self.references = references(declared)
        self.integers = {variable.name for variable in declared if variable.is_integer}

    def instance(self, logging: bool = False, **changed) -> Instance:
        """A new one; changed: name, kind, guid or resources, to differ from what is right."""
        return Instance(self, logging, **changed)


class Instance:
    """One instance. A call's status is returned; what is logged is in `messages`."""

    def __init__(
        self,
        unit: Unit,
        logging: bool,
        name: bytes | None = b"block",
        kind: int = CO_SIMULATION,
        guid: bytes | None = b"",
        resources: bytes | None = None,
    ) -> None:
        self.unit = unit
        self.messages: list[tuple[int, str, str]] = []
        self._callbacks = _Callbacks(logger=_LOGGER(self._log))
        self.handle = unit.library.fmi2Instantiate(
            name,
            kind,
            unit.guid if guid == b"" else guid,
            resources,
            byref(self._callbacks),
            0,
            int(logging),
        )

    def _log(self, _environment, _name, status, category, text) -> None:
        self.messages.append((status, category.decode(), text.decode() % ()))

    def __enter__(self) -> Instance:
        return self

    def __exit__(self, *_: type[BaseException] | BaseException | TracebackType | None) -> None:
        self.free()

    def free(self) -> None:
        free = self.unit.library.fmi2FreeInstance
        free.argtypes, free.restype = (c_void_p,), None
        free(self.handle)
        self.handle = None

    def call(self, function: str, *arguments) -> int:
        """Status of a function, called by its name without "fmi2"."""
        return getattr(self.unit.library, f"fmi2{function}")(self.handle, *arguments)

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

    # --- with names ---

    def set_arguments(self, name: str, value: float) -> tuple:
        """Function and arguments that set a variable."""
        whole = name in self.unit.integers
        number = c_int(int(value)) if whole else c_double(value)
        function = "SetInteger" if whole else "SetReal"
        return function, byref(c_uint(self.unit.references[name])), 1, byref(number)

    def set(self, name: str, value: float) -> None:
        self.done(*self.set_arguments(name, value))

    def get(self, *names: str) -> list[float]:
        return [self._get(name) for name in names]

    def _get(self, name: str) -> float:
        whole = name in self.unit.integers
        number = c_int() if whole else c_double()
        self.done(
            "GetInteger" if whole else "GetReal",
            byref(c_uint(self.unit.references[name])),
            1,
            byref(number),
        )
        return number.value

    def everything(self) -> list[str]:
        """Every variable, exact."""
        places = self.unit.references
        whole = [places[name] for name in places if name in self.unit.integers]
        real = [places[name] for name in places if name not in self.unit.integers]
        integers, numbers = (c_int * len(whole))(), (c_double * len(real))()
        self.done("GetInteger", (c_uint * len(whole))(*whole), len(whole), integers)
        self.done("GetReal", (c_uint * len(real))(*real), len(real), numbers)
        return [*map(str, integers), *map(float.hex, numbers)]

    def begin(self, start: float = 0.0, **values: float) -> Instance:
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

    # --- states ---

    def save(self) -> c_void_p:
        state = c_void_p()
        self.done("GetFMUstate", byref(state))
        return state

    def restore(self, state: c_void_p) -> None:
        self.done("SetFMUstate", state)

    def forget(self, state: c_void_p) -> None:
        self.done("FreeFMUstate", byref(state))
        assert state.value is None

    def as_bytes(self, state: c_void_p) -> bytes:
        size = c_size_t()
        self.done("SerializedFMUstateSize", state, byref(size))
        room = ctypes.create_string_buffer(size.value)
        self.done("SerializeFMUstate", state, room, size.value)
        return room.raw

    def from_bytes(self, content: bytes) -> c_void_p:
        state = c_void_p()
        self.done("DeSerializeFMUstate", content, len(content), byref(state))
        return state
