"""What the participants gave out at the last communication points, and where that leads."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping

from cosim.coupling.system import Address
from cosim.coupling.waveform import Waveform, through

#: Points that a polynomial of the highest degree here takes.
MOST_POINTS = 3

#: Time in s; participant -> port -> value.
Point = tuple[float, Mapping[str, Mapping[str, float]]]


class History:
    """The newest communication points: time (s), participant -> port -> value."""

    def __init__(self) -> None:
        self.points: deque[Point] = deque(maxlen=MOST_POINTS)

    def add(self, time: float, outputs: Mapping[str, Mapping[str, float]]) -> None:
        """A further point."""
        self.points.append((time, dict(outputs)))

    def forget_past(self) -> None:
        """At an event values jump or bend: what was before says nothing of what follows."""
        while len(self.points) > 1:
            self.points.popleft()

    def extrapolated(self, source: Address, degree: int, size: float) -> Waveform:
        """The polynomial of a degree through the last points, over the step that begins now.

        Of a lower degree while there are not enough points.
        """
        return through(self._of(source, degree + 1), size)

    def interpolated(self, source: Address, degree: int, size: float, end: float) -> Waveform:
        """The same with a value at the step's end in place of the oldest point."""
        if degree == 0:
            return Waveform((end,), size)
        return through([*self._of(source, degree), (size, end)], size)

    def _of(self, source: Address, count: int) -> list[tuple[float, float]]:
        now = self.points[-1][0]
        chosen = list(self.points)[-count:]
        return [(t - now, values[source.participant][source.port]) for t, values in chosen]
