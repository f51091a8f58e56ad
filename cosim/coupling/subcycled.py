"""A participant that makes several steps of its own in each macro step."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property

from cosim.coupling.conversion import watts
from cosim.coupling.participant import (
    Around,
    Capabilities,
    Causality,
    CouplingError,
    Participant,
    capabilities,
)
from cosim.coupling.system import ENERGY_UNIT
from cosim.coupling.waveform import Waveform


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
        outputs = ((name, port) for name, port in self.ports.items()
                   if port.causality is Causality.OUTPUT)  # fmt: skip
        return tuple(name for name, port in outputs if watts(port) is not None)

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
            return
        ports = self.inner.ports
        self.inner.write(
            {
                port: part.end if ports[port].unit == ENERGY_UNIT else part.mean
                for port, part in parts.items()
            }
        )
