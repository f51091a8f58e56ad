"""A run that can be copied, disturbed and continued: what stability is measured with."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np

from ..compiled import compiled_kernel
from ..kernel.layout import (
    DONE,
    E_CAPACITY,
    E_FIRST,
    E_WIDTH,
    MODE,
    SHOWN,
    STICK,
    TIME,
    U_FILM,
    U_SIZE,
    U_SPEED,
    U_TEMPERATURE,
    W_SIZE,
    Z_HAS_NEXT,
    Z_SIZE,
    Z_STARTED,
    Z_STATUS,
    X,
)
from ..parameters import Parameters
from ..status import WHY_NOT

#: x, y (m), phi (rad), vx, vy (m/s), omega (rad/s)
STATE = 6


@dataclass(frozen=True)
class Interface:
    """What friction may feel, constant over a run: temperature (degC; None: the reference of
    temperature_dependence), and mean thickness of the water, m."""

    temperature: float | None = None
    film_thickness: float = 0.0

    @property
    def inputs(self) -> dict[str, float | None]:
        """As `simulate` takes it."""
        return {"interface_temperature": self.temperature, "film_thickness": self.film_thickness}


#: At the reference temperature, without water.
DRY = Interface()


class RunEnded(ValueError):
    """The motion cannot be followed any further; the message says when and why."""


class LiveRun:
    """The compiled kernel at one moment of a run.

    Everything that the run remembers is in it, so that a copy goes on exactly as the original
    would. interface: its temperature and the water in it.
    """

    def __init__(self, parameters: Parameters, interface: Interface = DRY) -> None:
        self._kernel = compiled_kernel()
        self._p, self._u = np.array(parameters.pack()), np.zeros(U_SIZE)
        self._u[U_SPEED], self._u[U_FILM] = parameters.surface.speed, interface.film_thickness
        self._u[U_TEMPERATURE] = interface.temperature
        if interface.temperature is None:
            self._u[U_TEMPERATURE] = parameters.temperature_dependence.reference_degC
        self._z, self._w = np.zeros(Z_SIZE), np.zeros(W_SIZE)
        self._e = np.zeros(E_FIRST + E_WIDTH)
        self._e[E_CAPACITY] = 1.0
        self._kernel.initialise(self._p, self._z, 0.0)

    @property
    def time(self) -> float:
        """s"""
        return float(self._z[SHOWN + TIME])

    @property
    def state(self) -> np.ndarray:
        """(6,) x, y, phi, vx, vy, omega; a copy."""
        return self._z[SHOWN + X : SHOWN + X + STATE].copy()

    @property
    def sticks(self) -> bool:
        """Does the contact hold?"""
        return bool(self._z[SHOWN + MODE] == STICK)

    def copy(self) -> Self:
        """The same moment, to go another way from."""
        twin = object.__new__(type(self))
        twin.__dict__ = self.__dict__ | {"_z": self._z.copy()}
        return twin

    def of(self, parameters: Parameters) -> Self:
        """A copy of the same moment, to go on as a rig of other parameters."""
        twin = self.copy()
        twin._p = np.array(parameters.pack())
        return twin

    def advance(self, time: float) -> Self:
        """Go on to ``time`` (s). RunEnded where that cannot be."""
        arrays = self._p, self._u, self._z, self._w, self._e
        if self._kernel.advance(*arrays, time) != DONE:
            raise RunEnded(f"at t = {self.time:.9g} s: {WHY_NOT[self._z[Z_STATUS]]}")
        return self

    def displace(self, change: np.ndarray) -> Self:
        """Add ``change`` (6,) to the state; a contact that holds keeps the surface's velocity."""
        p, u, z, w = self._p, self._u, self._z, self._w
        z[SHOWN + X : SHOWN + X + STATE] += change
        if self.sticks:
            self._kernel.look_at(p, u, z, w, SHOWN)
            self._kernel.follow_surface(p, u, z, w, SHOWN, 0.0)
        z[Z_STARTED], z[Z_HAS_NEXT] = 0.0, 0.0
        return self.advance(self.time)
