"""Participants around a participant: inputs known beforehand, and steps of its own."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cosim.coupling.conversion import watts
from cosim.coupling.exchange import held
from cosim.coupling.participant import (
    Capabilities,
    Causality,
    CouplingError,
    Participant,
    Port,
    capabilities,
)
from cosim.coupling.system import ENERGY_UNIT
from cosim.coupling.waveform import Waveform

Array = NDArray[np.float64]


class Around:
    """Stands around a participant, whose name, ports and all else it has."""

    def __init__(self, participant: Participant):
        self.inner: Any = participant
        self.name: str = participant.name
        self.ports: Mapping[str, Port] = participant.ports

    @property
    def capabilities(self) -> Capabilities:
        """Those of the participant."""
        return capabilities(self.inner)

    def __getattr__(self, name: str) -> Any:
        """All else is the participant's."""
        return getattr(self.inner, name)


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
        end, given = time + size, self.curves.items()
        if self.capabilities.waveforms:
            starts = {port: curve.at(time) for port, curve in given}
            slopes = {port: (curve.before(end) - starts[port]) / size for port, curve in given}
            self.inner.write_waveforms(
                {port: Waveform((starts[port], slopes[port]), size) for port in starts}
            )
        else:
            totals = [port for port in self.curves if self.ports[port].unit == ENERGY_UNIT]
            self.inner.write(
                {p: curve.at(end) if p in totals else curve.mean(time, end) for p, curve in given}
            )
        found: float | None = self.inner.step(time, size)
        return found


class Subcycled(Around):
    """Steps a participant `substeps` times in each macro step, along the waveforms of its inputs.

    Who cannot follow a waveform gets its mean over each substep, and joules handed over since the
    start as they stand at its end: with many substeps it is as if it could. What it gives out is
    seen at the communication points alone, but for power: that is the mean of the substeps, so that
    nothing of a power that is itself a mean over the last step is lost.
    """

    def __init__(self, participant: Participant, substeps: int):
        if substeps < 1:
            raise CouplingError(f"{participant.name}: substeps = {substeps}: must be at least 1")
        super().__init__(participant)
        self.substeps = substeps
        self._waves: dict[str, Waveform] = {}
        self._means: dict[str, float] = {}

    @cached_property
    def _powers(self) -> tuple[str, ...]:
        """Outputs that are a power."""
        outputs = (p for p in self.ports.values() if p.causality is Causality.OUTPUT)
        return tuple(port.name for port in outputs if watts(port) is not None)

    @property
    def capabilities(self) -> Capabilities:
        """Those of the participant, and it follows waveforms."""
        return replace(capabilities(self.inner), waveforms=True, input_order=None)

    def write(self, values: Mapping[str, float]) -> None:
        """Values that are held over the macro step."""
        for port in values:
            self._waves.pop(port, None)
        self.inner.write(values)

    def write_waveforms(self, waveforms: Mapping[str, Waveform]) -> None:
        """Inputs over the macro step as functions of time."""
        self._waves.update(waveforms)

    def step(self, time: float, size: float) -> float | None:
        """The macro step, in parts; ends with the part that ends early."""
        sums, reached = dict.fromkeys(self._powers, 0.0), None
        for n in range(self.substeps):
            began, ended = (size * k / self.substeps for k in (n, n + 1))
            self._follow(began, ended - began)
            reached = self.inner.step(time + began, ended - began)
            there = ended if reached is None else reached - time
            values = self.inner.read() if sums else {}
            for name in sums:
                sums[name] += values[name] * (there - began)
            if reached is not None:
                break
        self._means = {name: total / there for name, total in sums.items()}
        return reached

    def read(self) -> dict[str, float]:
        """All outputs; of power the mean over the last macro step."""
        return {**self.inner.read(), **self._means}

    def _follow(self, began: float, size: float) -> None:
        """Inputs for the part of the macro step that begins at a time since its start (s)."""
        parts = {port: wave.after(began, size) for port, wave in self._waves.items()}
        if not parts:
            return
        if capabilities(self.inner).waveforms:
            self.inner.write_waveforms(parts)
        else:
            self.inner.write(held(self.inner.ports, parts))
