"""A run that can be copied, disturbed and continued: what stability is measured with."""

from __future__ import annotations

from dataclasses import dataclass

from ..arrays import RunArrays, RunEnded, inputs, interface_temperature
from ..parameters import Parameters

__all__ = ["DRY", "Interface", "RunEnded", "live_run"]


@dataclass(frozen=True)
class Interface:
    """What friction may feel, constant over a run: temperature (degC; None: the reference of
    temperature_dependence), and mean thickness of the water, m."""

    temperature: float | None = None
    film_thickness: float = 0.0


#: At the reference temperature, without water.
DRY = Interface()


def live_run(parameters: Parameters, interface: Interface = DRY) -> RunArrays:
    """The compiled kernel at the start of a run; interface: its temperature, the water in it."""
    temperature = interface_temperature(parameters, interface.temperature)
    u = inputs(parameters.surface.speed, temperature, interface.film_thickness)
    return RunArrays.begin(parameters.pack(), u, catalogue=parameters.catalogue)
