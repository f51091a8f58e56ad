"""The native unit for FMI 3.0 as a host written in C meets it, its variables by their names."""

from __future__ import annotations

import ctypes
from ctypes import byref, c_bool, c_char_p, c_double, c_int, c_int32, c_size_t, c_void_p
from pathlib import Path

from c_instance import CInstance, CUnit, unpacked_library
from plain_start import PLAIN
from stickslip.generation.platforms import this_platform

from cosim.fmu.exchange import variables
from cosim.fmu.native import NAME
from cosim.fmu.variables import by_array

LOGGER = ctypes.CFUNCTYPE(None, c_void_p, c_int, c_char_p, c_char_p)


def references() -> dict[str, int]:
    """Name -> value reference, of an array that of its first element."""
    found, place = {}, 0
    for elements in by_array(variables()):
        found[elements[0].array or elements[0].name] = place
        place += len(elements)
    return found | {"time": place}


class Unit(CUnit):
    """`instance` makes instances."""

    def __init__(self, fmu: Path, folder: Path) -> None:
        platform = this_platform()
        path = f"binaries/{platform.name}/{NAME}{platform.suffix}"
        whole = [each.name for each in variables() if each.type == "Integer"]
        kinds = dict.fromkeys(whole, ("Int32", c_int32, int))
        kinds |= {each.name: ("Boolean", c_bool, bool) for each in variables() if each.is_boolean}
        sizes = {e[0].array or e[0].name: len(e) for e in by_array(variables())}
        library = unpacked_library(fmu, folder, path)
        super().__init__(fmu, library, 3, references(), kinds, sizes)

    def instance(self, **how) -> Instance:
        return Instance(self, **how)


class Instance(CInstance):
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
        self._log = LOGGER(self._heard)
        token = unit.guid if token == b"" else token
        first = (name, token, None, c_bool(False), c_bool(False))
        if exchanges:
            make, given = unit.library.fmi3InstantiateModelExchange, (None, self._log)
        else:
            make = unit.library.fmi3InstantiateCoSimulation
            given = (c_bool(events), c_bool(early), None, c_size_t(required), None, self._log, None)
        make.restype = c_void_p
        self.handle = make(*first, *given)

    def _heard(self, _environment, status, category, text) -> None:
        self.messages.append((status, category.decode(), text.decode()))

    def get(self, name: str):
        return self.value(name)

    def begin(self, **values) -> Instance:
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
