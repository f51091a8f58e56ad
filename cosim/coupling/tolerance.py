"""How much two values of a port may differ and still count as the same."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from cosim.coupling.participant import CouplingError
from cosim.coupling.system import Address, CoupledSystem, find_port


@dataclass(frozen=True)
class Tolerance:
    """|difference| <= absolute + relative |value|.

    relative: of every port. absolute: `participant.port` -> in the port's unit; of a port that is
    not named, `relative` of its nominal value.
    """

    relative: float = 1e-6
    absolute: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if not (math.isfinite(self.relative) and self.relative > 0.0):
            raise CouplingError(
                f"relative_tolerance = {self.relative:g}: must be a finite number above 0"
            )
        for port, value in self.absolute.items():
            if not (math.isfinite(value) and value >= 0.0):
                raise CouplingError(
                    f"absolute tolerance of {port} = {value:g}: must be a finite number, 0 or more"
                )

    def check(self, system: CoupledSystem) -> None:
        """Refuse a port that the system does not have."""
        for port in self.absolute:
            find_port(system.participants, Address.parse(port))

    def least(self, system: CoupledSystem, sources: tuple[Address, ...]) -> NDArray[np.float64]:
        """The absolute part for some ports, (n,)."""
        pairs = zip(sources, nominals(system, sources).tolist(), strict=True)
        return np.array(
            [self.absolute.get(str(port), self.relative * nominal) for port, nominal in pairs]
        )

    def allowed(
        self, least: NDArray[np.float64], values: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Allowed differences of values (n,), of which `least` is the absolute part; above 0."""
        return np.maximum(least + self.relative * np.abs(values), np.finfo(float).tiny)


def nominals(system: CoupledSystem, sources: tuple[Address, ...]) -> NDArray[np.float64]:
    """Magnitudes of the nominal values of some ports, (n,), above 0."""
    found = [abs(find_port(system.participants, source).nominal) for source in sources]
    return np.array([nominal or 1.0 for nominal in found])


def bounds(
    system: CoupledSystem, sources: tuple[Address, ...]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Least and largest values of some outputs, (n,) each: their own, and of all that they feed."""
    least, most = [], []
    for source in sources:
        own = find_port(system.participants, source)
        low, high = own.least, own.most
        for feed in system.connections:
            if feed.source == source:
                sink, convert = find_port(system.participants, feed.sink), system.conversions[feed]
                if convert.factor:
                    ends = [
                        (end - convert.offset) / convert.factor for end in (sink.least, sink.most)
                    ]
                    low, high = max(low, min(ends)), min(high, max(ends))
        least.append(low)
        most.append(high)
    return np.array(least), np.array(most)
