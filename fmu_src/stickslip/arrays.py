"""The kernel's arrays for one run, laid out in one place."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np

from .catalogue import CATALOGUE, Catalogue
from .kernel import layout as places
from .parameters import Parameters
from .words import WHY_NOT

#: x, y (m), phi (rad), vx, vy (m/s), omega (rad/s)
STATE = ("x", "y", "phi", "vx", "vy", "omega")


def inputs(speed: float, temperature: float, film_thickness: float = 0.0) -> np.ndarray:
    """``u`` of a surface's speed (m/s) and an interface (degC, m)."""
    u = np.zeros(places.U_SIZE)
    u[places.U_SPEED], u[places.U_TEMPERATURE] = speed, temperature
    u[places.U_FILM] = film_thickness
    return u


def interface_temperature(parameters: Parameters, temperature: float | None) -> float:
    """degC; left out, the reference temperature of temperature_dependence."""
    if temperature is None:
        return float(parameters.temperature_dependence.reference_degC)
    return temperature


class RunEnded(ValueError):
    """The motion cannot be followed any further; the message says when and why."""


@dataclass
class RunArrays:
    """One run of a kernel: parameters, inputs, memory, scratch space and log of events.

    Everything that the run remembers is in ``z``, so that a copy goes on exactly as the original
    would. kernel : the catalogue's compiled one, or the
    interpreted, whose arrays are lists; layout : where it has what, with the catalogue's effects.
    """

    kernel: Any
    layout: Any
    p: Any
    u: Any
    z: Any
    w: Any
    e: Any

    @classmethod
    def begin(
        cls,
        p: Sequence[float] | np.ndarray,
        u: Sequence[float] | np.ndarray,
        start: float = 0.0,
        events: int = 1,
        interpreted: bool = False,
        catalogue: Catalogue = CATALOGUE,
    ) -> Self:
        """A run that starts at the time ``start`` (s), with room for so many events in its log.

        catalogue : whose parameters ``p`` was made of. Raises ValueError for a ``p`` of another.
        """
        array: Callable[[Any], Any] = list if interpreted else np.array
        layout = catalogue.kernel
        if len(p) != layout.P_SIZE:
            raise ValueError(f"p has {len(p)} numbers, those of this catalogue {layout.P_SIZE}")
        kernel = layout if interpreted else catalogue.compiled
        e = array(np.zeros(places.E_FIRST + places.E_WIDTH * events))
        e[places.E_CAPACITY] = float(events)
        z, w = array(np.zeros(layout.Z_SIZE)), array(np.zeros(layout.W_SIZE))
        run = cls(kernel, layout, array(np.asarray(p, dtype=float)), array(u), z, w, e)
        kernel.initialise(run.p, run.z, start)
        return run

    def copy(self) -> Self:
        """The same instant, to go on differently from."""
        return replace(self, z=self.z.copy())

    @property
    def all(self) -> tuple[Any, Any, Any, Any, Any]:
        """As the kernel takes them."""
        return self.p, self.u, self.z, self.w, self.e

    @property
    def time(self) -> float:
        """s"""
        return float(self.z[self.layout.SHOWN + places.TIME])

    @property
    def sticks(self) -> bool:
        """Does the contact hold?"""
        return bool(self.z[self.layout.SHOWN + self.layout.MODE] == places.STICK)

    @property
    def state(self) -> Any:
        """(6,) x, y, phi, vx, vy, omega: of a compiled run the very numbers."""
        begin = self.layout.SHOWN + places.X
        return self.z[begin : begin + len(STATE)]

    @property
    def failure(self) -> str:
        """Why `advance` gave up, with the remedy."""
        return f"t = {self.time:.9g} s: {WHY_NOT[int(self.z[self.layout.Z_STATUS])]}"

    @property
    def step_size(self) -> float:
        """The integrator's, s."""
        return float(self.z[self.layout.Z_STEP])

    def of(self, parameters: Parameters) -> Self:
        """A copy of the same instant, to go on as a rig of other parameters."""
        return replace(self.copy(), p=np.array(parameters.pack()))

    def advance(self, time: float) -> Self:
        """Go on to ``time`` (s). RunEnded where that cannot be."""
        if self.kernel.advance(*self.all, time) != places.DONE:
            raise RunEnded(f"at {self.failure}")
        return self

    def displace(self, change: np.ndarray) -> Self:
        """Add ``change`` (6,) to the state; a contact that holds keeps the surface's velocity."""
        self.state[:] += change
        if self.sticks:
            shown = self.layout.SHOWN
            self.kernel.look_at(self.p, self.u, self.z, self.w, shown)
            self.kernel.follow_surface(self.p, self.u, self.z, self.w, shown, 0.0)
        self.z[self.layout.Z_STARTED] = self.z[self.layout.Z_HAS_NEXT] = 0.0
        return self.advance(self.time)
