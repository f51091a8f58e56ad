"""Parameters to trajectory: the mechanical model alone."""

from collections.abc import Callable
from math import inf

import numpy as np

from .arrays import RunArrays, inputs
from .arrays import interface_temperature as temperature_of
from .kernel import layout
from .kernel.layout import E_COUNT, E_FIRST, E_WIDTH, O_SIZE
from .parameters import Parameters
from .ports import OUTPUTS
from .trajectory import Trajectory

EVENTS_AT_ONCE = 4096
# rows between two calls of ``progress``, and the motion that they may span: a caller that wants to
# stop need not wait for more
ROWS_AT_ONCE = 1000
SECONDS_AT_ONCE = 20.0


def simulate(
    parameters: Parameters,
    duration: float = 30.0,
    output_interval: float = 0.01,
    *,
    interface_temperature: float | None = None,
    film_thickness: float = 0.0,
    interpreted: bool = False,
    progress: Callable[[float], None] | None = None,
) -> Trajectory:
    """Run the mechanical model from 0 to ``duration`` (s), sampled every ``output_interval`` (s).

    The samples are the model's own accuracy, not interpolated, and have no influence on it. The
    interface stays at ``interface_temperature`` (degC; left out, at the reference temperature of
    ``temperature_dependence``), with water of the mean ``film_thickness`` (m) on it.
    ``progress`` is called with the time reached, and may raise: what was computed until then is in
    the exception's ``trajectory``.

    Raises ValueError for a duration or an interval that is not positive, or a negative thickness.
    """
    if not duration > 0.0:
        raise ValueError(f"duration = {duration!r}: must be above 0 s")
    if not 0.0 < output_interval:
        raise ValueError(f"output_interval = {output_interval!r}: must be above 0 s")
    if not 0.0 <= film_thickness < inf:
        raise ValueError(f"film_thickness = {film_thickness!r}: must be at least 0 m and finite")
    temperature = temperature_of(parameters, interface_temperature)
    u = inputs(parameters.surface.speed, temperature, film_thickness)
    times = sample_times(duration, output_interval)
    run = _Run(parameters, times, u, interpreted)
    try:
        while run.reason is None:
            run.next_rows()
            if progress is not None:
                progress(run.time_reached)
    except BaseException as stop:
        kept = run.trajectory(reason=f"stopped: {type(stop).__name__}")
        stop.trajectory = kept  # type: ignore[attr-defined]  # any exception can carry it
        raise
    return run.trajectory(run.reason)


def sample_times(duration: float, interval: float) -> np.ndarray:
    """0, interval, 2 interval, ... and ``duration`` itself, s."""
    count = int(np.floor(duration / interval * (1.0 + 1e-12)))
    times = np.arange(count + 1) * interval
    if duration - times[-1] > 1e-9 * interval:
        return np.append(times, duration)
    times[-1] = duration
    return times


class _Run:
    """The rows of one run, filled some at a time."""

    def __init__(self, parameters: Parameters, times: np.ndarray, u: np.ndarray, interpreted: bool):
        self.parameters = parameters
        array = list if interpreted else np.array
        self.arrays = RunArrays.begin(
            parameters.pack(),
            u,
            events=EVENTS_AT_ONCE,
            interpreted=interpreted,
            catalogue=parameters.catalogue,
        )
        self.times, self.t = times, array(times)
        self.o = array(np.zeros(O_SIZE * len(times)))
        self.rows = 0
        self.events: list[np.ndarray] = []
        self.reason: str | None = None

    @property
    def time_reached(self) -> float:
        return float(self.times[self.rows - 1]) if self.rows else 0.0

    def next_rows(self) -> None:
        """Advance by some rows; set ``reason`` where the run is over."""
        within = self.time_reached + SECONDS_AT_ONCE
        span = int(np.searchsorted(self.times, within, side="right")) - self.rows
        wanted = min(max(span, 1), ROWS_AT_ONCE, len(self.times) - self.rows)
        record = self.arrays.kernel.record
        done = record(*self.arrays.all, self.t, self.o, self.rows, wanted, True)
        self.rows += done
        self._drain_events()
        if done < wanted:
            self.reason = f"the run ended at {self.arrays.failure}"
        elif self.rows == len(self.times):
            self.reason = ""

    def _drain_events(self) -> None:
        e = self.arrays.e
        kept = min(int(e[E_COUNT]), EVENTS_AT_ONCE)
        flat = np.array(e[E_FIRST : E_FIRST + E_WIDTH * kept])
        self.events.append(flat.reshape(kept, E_WIDTH))
        e[E_COUNT] = 0.0

    def trajectory(self, reason: str) -> Trajectory:
        table = np.array(self.o).reshape(-1, O_SIZE)[: self.rows]
        columns = {port.name: table[:, getattr(layout, port.slot)].copy() for port in OUTPUTS}
        events = np.concatenate([np.empty((0, E_WIDTH)), *self.events])
        # the internal step that the run ends in may have met an event beyond that end
        events = events[events[:, 0] <= self.arrays.time]
        return Trajectory(self.times[: self.rows], columns, events, self.parameters, reason)
