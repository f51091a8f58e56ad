"""What a run of the mechanical model returns."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .parameters import Parameters


@dataclass(frozen=True)
class Trajectory:
    """A run, sampled at ``time``; events are as exact as the motion, whatever the sampling.

    Attributes
    ----------
    time : (n,) array, s
    columns : dict of (n,) arrays, one for each of `ports.OUTPUTS`
    events : (k, 3) array: time (s), mode after the event (0 stick, 1 slip), x (m)
    parameters : what was run
    reason : empty, or why the run ended early
    """

    time: np.ndarray
    columns: dict[str, np.ndarray] = field(repr=False)
    events: np.ndarray = field(repr=False)
    parameters: Parameters
    reason: str = ""

    def __getitem__(self, name: str) -> np.ndarray:
        return self.columns[name]

    @property
    def complete(self) -> bool:
        return not self.reason

    @property
    def slip_share(self) -> float:
        """Fraction of the time spent in slip."""
        return slip_share(self.time, self.columns["mode"], self.events)

    @property
    def slip_starts(self) -> np.ndarray:
        """Times of break-away, s."""
        return self.events[self.events[:, 1] == 1.0, 0]


def slip_share(time: np.ndarray, mode: np.ndarray, events: np.ndarray) -> float:
    """Fraction of ``time[0] ... time[-1]`` in slip, from the exact events."""
    inside = events[(events[:, 0] > time[0]) & (events[:, 0] < time[-1])]
    edges = np.concatenate([[time[0]], inside[:, 0], [time[-1]]])
    modes = np.concatenate([[mode[0]], inside[:, 1]])
    duration = time[-1] - time[0]
    return float(np.sum(np.diff(edges) * modes) / duration) if duration > 0.0 else 0.0
