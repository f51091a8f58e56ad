"""The native unit for FMI 2.0 as a host written in C meets it, its variables by their names."""

from __future__ import annotations

import ctypes
from collections.abc import Iterable, Sequence
from ctypes import byref, c_char_p, c_double, c_int, c_void_p
from pathlib import Path

from c_instance import CInstance, CUnit, unpacked_library
from stickslip.generation.platforms import this_platform

from cosim.fmu.native import NAME
from cosim.fmu.variables import Variable, variables

MODEL_EXCHANGE, CO_SIMULATION = 0, 1

_LOGGER = ctypes.CFUNCTYPE(None, c_void_p, c_char_p, c_int, c_char_p, c_char_p)


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
    return unpacked_library(fmu, folder, f"binaries/{platform.fmi2}/{name}{platform.suffix}")


def references(declared: Sequence[Variable] | None = None) -> dict[str, int]:
    """Name -> value reference."""
    declared = variables() if declared is None else declared
    return {variable.name: place for place, variable in enumerate(declared)}


class Unit(CUnit):
    """`instance` makes instances. name, declared: of another unit than the block's."""

    def __init__(
        self,
        fmu: Path,
        folder: Path,
        name: str = NAME,
        declared: Sequence[Variable] | None = None,
    ) -> None:
        declared = variables() if declared is None else declared
        whole = [variable.name for variable in declared if variable.type == "Integer"]
        kinds = dict.fromkeys(whole, ("Integer", c_int, int))
        super().__init__(fmu, library_of(fmu, folder, name), 2, references(declared), kinds, {})
        self.library.fmi2Instantiate.restype = c_void_p

    def instance(self, logging: bool = False, **changed) -> Instance:
        """A new one; changed: name, kind, guid or resources, to differ from what is right."""
        return Instance(self, logging, **changed)


class Instance(CInstance):
    version, STATE, DESERIALIZE = 2, "FMUstate", "DeSerializeFMUstate"
    REAL = "Real", c_double, float

    def __init__(
        self,
        unit: Unit,
        logging: bool,
        name: bytes | None = b"block",
        kind: int = CO_SIMULATION,
        guid: bytes | None = b"",
        resources: bytes | None = None,
    ) -> None:
        super().__init__(unit)
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

    def get(self, *names: str) -> list[float]:
        return [self.value(name) for name in names]

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
