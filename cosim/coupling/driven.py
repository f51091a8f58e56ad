"""A participant some of whose inputs are known beforehand, as curves over time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from cosim.coupling.participant import Around, CouplingError, Participant
from cosim.coupling.system import ENERGY_UNIT
from cosim.coupling.waveform import Waveform

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Curve:
    """times (n,) s, not falling, and values (n,): linear in between, held before and behind.

    Of two rows at one time the value jumps there.

    >>> Curve(np.array([0.0, 1.0, 1.0]), np.array([0.0, 2.0, 5.0])).mean(0.5, 1.5)
    3.25
    """

    times: Array
    values: Array

    def at(self, time: float) -> float:
        """The value at a time, s; at a jump that from there on."""
        place = int(np.searchsorted(self.times, time, side="right"))
        if place == 0 or place == self.times.size:
            return float(self.values[max(place - 1, 0)])
        t0, t1 = self.times[place - 1 : place + 1]
        v0, v1 = self.values[place - 1 : place + 1]
        return float(v0 + (v1 - v0) * ((time - t0) / (t1 - t0)))

    def before(self, time: float) -> float:
        """The value just before a time, s."""
        place = int(np.searchsorted(self.times, time, side="left"))
        if 0 < place < self.times.size and self.times[place] == time:
            return float(self.values[place])
        return self.at(time)

    def mean(self, begin: float, end: float) -> float:
        """Mean over a span of time, s, exact."""
        return (self._area(end) - self._area(begin)) / (end - begin)

    @cached_property
    def _areas(self) -> Array:
        """From the first time to each."""
        steps = 0.5 * (self.values[1:] + self.values[:-1]) * np.diff(self.times)
        return np.concatenate([[0.0], np.cumsum(steps)])

    def _area(self, time: float) -> float:
        """From the first time to this one, s."""
        since = time - self.times[0]
        if since < 0.0:
            return float(self.values[0] * since)
        place = int(np.searchsorted(self.times, time, side="right")) - 1
        since = time - self.times[place]
        return float(self._areas[place] + 0.5 * since * (self.values[place] + self.before(time)))


class Driven(Around):
    """Gives a participant its inputs over each step: `curves`, by the names of its ports.

    Who follows a waveform gets the curve's own line from the start of the step to its end, who does
    not its mean, and joules handed over since the start as they stand at the step's end.
    CouplingError for what is no input.
    """

    def __init__(self, participant: Participant, curves: Mapping[str, Curve]):
        super().__init__(participant)
        self.curves: dict[str, Curve] = dict(curves)
        for port in curves:
            if participant.ports[port].causality != "input":
                raise CouplingError(f"{participant.name}.{port} is no input, and is not driven")

    def enter_initialisation(self, start: float, stop: float) -> None:
        """With the inputs as they are at the start, s."""
        self.inner.enter_initialisation(start, stop)
        self.inner.write({port: curve.at(start) for port, curve in self.curves.items()})

    def step(self, time: float, size: float) -> float | None:
        """A step along the curves."""
        end = time + size
        if self.capabilities.waveforms:
            waves = {}
            for port, curve in self.curves.items():
                first = curve.at(time)
                waves[port] = Waveform((first, (curve.before(end) - first) / size), size)
            self.inner.write_waveforms(waves)
        else:
            totals = [port for port in self.curves if self.ports[port].unit == ENERGY_UNIT]
            self.inner.write(
                {
                    port: curve.at(end) if port in totals else curve.mean(time, end)
                    for port, curve in self.curves.items()
                }
            )
        found: float | None = self.inner.step(time, size)
        return found
