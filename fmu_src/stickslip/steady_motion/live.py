"""A run that can be copied, disturbed and continued: what stability is measured with."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self, TypedDict

import numpy as np

from ..arrays import STATE as NAMES
from ..arrays import RunArrays, inputs, interface_temperature
from ..parameters import Parameters

#: x, y (m), phi (rad), vx, vy (m/s), omega (rad/s)
STATE = len(NAMES)


class SimulateInputs(TypedDict):
    """The arguments of `simulate` that say what the interface is."""

    interface_temperature: float | None
    film_thickness: float


@dataclass(frozen=True)
class Interface:
    """What friction may feel, constant over a run: temperature (degC; None: the reference of
    temperature_dependence), and mean thickness of the water, m."""

    temperature: float | None = None
    film_thickness: float = 0.0

    @property
    def inputs(self) -> SimulateInputs:
        """As `simulate` takes it."""
        return {"interface_temperature": self.temperature, "film_thickness": self.film_thickness}


#: At the reference temperature, without water.
DRY = Interface()


class RunEnded(ValueError):
    """The motion cannot be followed any further; the message says when and why."""


class LiveRun:
    """The compiled kernel at one instant of a run.

    Everything that the run remembers is in it, so that a copy goes on exactly as the original
    would. interface: its temperature and the water in it.
    """

    def __init__(self, parameters: Parameters, interface: Interface = DRY) -> None:
        temperature = interface_temperature(parameters, interface.temperature)
        u = inputs(parameters.surface.speed, temperature, interface.film_thickness)
        self._run = RunArrays.begin(parameters.pack(), u, catalogue=parameters.catalogue)

    @property
    def time(self) -> float:
        """s"""
        return self._run.time

    @property
    def state(self) -> np.ndarray:
        """(6,) x, y, phi, vx, vy, omega; a copy."""
        return np.array(self._run.state)

    @property
    def sticks(self) -> bool:
        """Does the contact hold?"""
        return self._run.sticks

    @property
    def step(self) -> float:
        """The integrator's step, s."""
        return float(self._run.z[self._run.layout.Z_STEP])

    def copy(self) -> Self:
        """The same instant, to go on differently from."""
        twin = object.__new__(type(self))
        twin._run = self._run.copy()
        return twin

    def of(self, parameters: Parameters) -> Self:
        """A copy of the same instant, to go on as a rig of other parameters."""
        twin = self.copy()
        twin._run.p = np.array(parameters.pack())
        return twin

    def advance(self, time: float) -> Self:
        """Go on to ``time`` (s). RunEnded where that cannot be."""
        if not self._run.advance(time):
            raise RunEnded(f"at {self._run.failure}")
        return self

    def displace(self, change: np.ndarray) -> Self:
        """Add ``change`` (6,) to the state; a contact that holds keeps the surface's velocity."""
        self._run.state[:] += change
        if self.sticks:
            self._run.follow_surface()
        if not self._run.settle(self.time):
            raise RunEnded(f"at {self._run.failure}")
        return self
