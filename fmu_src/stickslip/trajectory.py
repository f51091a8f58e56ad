"""What a run of the mechanical model returns."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .parameters import Parameters
from .ports import OUTPUTS

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True, repr=False)
class Trajectory:
    """A run, sampled at ``time``; events are as exact as the motion, whatever the sampling.

    Attributes
    ----------
    time : (n,) array, s
    columns : dict of (n,) arrays, one for each of `ports.OUTPUTS`
    events : (k, 3) array: time (s), mode after the event (0 stick, 1 slip), x (m)
    parameters : what was run
    reason : empty, or why the run ended early

    >>> from stickslip import Parameters, simulate
    >>> simulate(Parameters(), duration=2.0)
    <Trajectory of 2 s, 201 rows: 4 break-aways, 83 % of the time in slip>
    """

    time: np.ndarray
    columns: dict[str, np.ndarray]
    events: np.ndarray
    parameters: Parameters
    reason: str = ""

    def __repr__(self) -> str:
        if self.time.size == 0:
            return f"<Trajectory without a row: {self.reason}>"
        length = f"{self.time[-1] - self.time[0]:.6g} s, {self.time.size} rows"
        ended = f"; ended early: {self.reason}" if self.reason else ""
        return (
            f"<Trajectory of {length}: {self.slip_starts.size} break-aways, "
            f"{100 * self.slip_share:.0f} % of the time in slip{ended}>"
        )

    def __getitem__(self, name: str) -> np.ndarray:
        return self.columns[name]

    @property
    def complete(self) -> bool:
        return not self.reason

    @property
    def slip_share(self) -> float:
        """Fraction of the time spent in slip."""
        return slip_share(*self.phases, self.time[0], self.time[-1])

    @property
    def phases(self) -> tuple[np.ndarray, np.ndarray]:
        """Times (k,), s, of the start and of every event, and the modes (k,) from then on."""
        times = np.append(self.time[:1], self.events[:, 0])
        return times, np.append(self.columns["mode"][:1], self.events[:, 1])

    @property
    def slip_starts(self) -> np.ndarray:
        """Times of break-away, s."""
        found: np.ndarray = self.events[self.events[:, 1] == 1.0, 0]
        return found

    def to_xarray(self) -> xarray.Dataset:
        """Everything as an `xarray.Dataset`, with units and long names.

        Outputs over ``time`` (n,); ``event_mode`` and ``event_x`` over ``event_time`` (k,); the
        parameters as JSON in the attribute ``parameters``.

        >>> from stickslip import Parameters, simulate
        >>> simulate(Parameters(), duration=1.0).to_xarray()["x"].attrs["units"]
        'm'
        """
        import xarray  # only for who asks for it: the model itself needs numpy alone

        described = {
            port.name: {"units": port.unit or "1", "long_name": port.description}
            for port in OUTPUTS
        }
        event_time, mode, x = self.events.T
        variables = {
            name: ("time", values, described[name]) for name, values in self.columns.items()
        } | {
            "event_mode": ("event_time", mode, {"units": "1", "long_name": "mode after the event"}),
            "event_x": ("event_time", x, described["x"]),
        }
        coordinates = {
            "time": ("time", self.time, {"units": "s", "long_name": "time"}),
            "event_time": (
                "event_time",
                event_time,
                {"units": "s", "long_name": "time of break-away or re-stick"},
            ),
        }
        attributes = {
            "parameters": json.dumps(self.parameters.model_dump(mode="json")),
            "reason": self.reason,
        }
        return xarray.Dataset(variables, coordinates, attributes)


def slip_share(times: np.ndarray, modes: np.ndarray, begin: float, end: float) -> float:
    """Fraction of ``begin ... end`` (s) in slip, 0 of no time at all.

    times (k,), s, in order, and modes (k,) from then on: of phases, the first from ``begin`` or
    before.

    >>> slip_share(np.array([0.0, 1.0, 3.0]), np.array([0.0, 1.0, 0.0]), 0.0, 4.0)
    0.5
    """
    edges = np.clip(np.append(times, end), begin, end)
    return float(np.sum(np.diff(edges) * modes) / (end - begin)) if end > begin else 0.0


def break_away_frequency(starts: np.ndarray) -> float:
    """Stick-slip frequency, Hz: one over the mean period from the first break-away to the last.

    starts: times of break-away, s (k,), in order. 0 without any; NaN of a single one, which has no
    period. Counts in a window of time, which cuts the first and the last cycle, are not this.

    >>> break_away_frequency(np.array([10.2, 10.7, 11.2]))
    2.0
    """
    if starts.size < 2:
        return 0.0 if starts.size == 0 else math.nan
    return float((starts.size - 1) / (starts[-1] - starts[0]))


def counted_break_aways(time: np.ndarray, count: np.ndarray) -> np.ndarray:
    """Times of break-away, s (k,), of rows (n,) that carry how many there were until then.

    Each is put in the middle of its interval, so that one whose slip ended before the next row is
    not lost. Rows without a number are left out.
    """
    known = np.isfinite(count)
    time, count = time[known], count[known]
    middles = 0.5 * (time[1:] + time[:-1])
    return np.repeat(middles, np.maximum(np.diff(count), 0.0).astype(int))
