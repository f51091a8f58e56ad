"""A coupled run: initial exchange, macro steps, result."""

import math
import time as clock
from collections.abc import Callable

from cosim.coupling.exchange import Exchange, initial_exchange
from cosim.coupling.participant import CouplingError, ParticipantError
from cosim.coupling.result import CoupledResult, Recording, Status, ledger_of
from cosim.coupling.scheme import Scheme, macro_grid
from cosim.coupling.system import CoupledSystem
from cosim.interrupts import deferred_interrupt

Progress = Callable[[float], None]


def run(
    system: CoupledSystem,
    scheme: Scheme,
    *,
    stop: float,
    macro_step: float,
    start: float = 0.0,
    record_every: int = 1,
    progress: Progress | None = None,
    exchange_tolerance: float = 4 * math.ulp(1.0),
    exchange_sweeps: int = 100,
) -> CoupledResult:
    """Run a coupled system from start to stop (s) in macro steps of macro_step (s).

    record_every: keep every n-th communication point (and always the first and the last).
    progress: called with the time reached (s) after each macro step.
    exchange_tolerance, exchange_sweeps: see `initial_exchange`.
    An interrupt or a participant that fails in a step ends the run; the result then holds
    everything recorded up to the last whole macro step, and says so. Raises CouplingError when
    the run as asked for makes no sense or the initial exchange does not settle,
    ParticipantError when a participant fails before the first step. Closing the participants
    is left to the caller, who may want to ask them for more.
    """
    if record_every < 1:
        raise CouplingError(f"record_every = {record_every}: must be at least 1")
    times = macro_grid(start, stop, macro_step)
    scheme.check(system)
    exchange = Exchange(system)
    sweeps = _initialise(exchange, scheme.order, start, stop, exchange_tolerance, exchange_sweeps)
    recording = Recording(system, rows=2 + (len(times) - 1) // record_every)
    recording.add(start, exchange)
    began = clock.perf_counter()
    status, error, steps = _march(exchange, scheme, times, recording, record_every, progress)
    values = recording.values()
    return CoupledResult(
        time=recording.time,
        values=values,
        units=recording.units,
        ledger=ledger_of(system, values),
        status=status,
        reason=_reason(status, error, times[steps]),
        error=error,
        wall_time=clock.perf_counter() - began,
        sweeps=sweeps,
        steps=steps,
    )


def _initialise(
    exchange: Exchange,
    order: tuple[str, ...],
    start: float,
    stop: float,
    tolerance: float,
    max_sweeps: int,
) -> int:
    participants = exchange.system.participants
    for name in order:
        with exchange.blaming(name):
            participants[name].enter_initialisation(start, stop)
    sweeps = initial_exchange(exchange, order, tolerance, max_sweeps)
    for name in order:
        with exchange.blaming(name):
            participants[name].exit_initialisation()
        exchange.collect(name)
    return sweeps


def _march(
    exchange: Exchange,
    scheme: Scheme,
    times: list[float],
    recording: Recording,
    record_every: int,
    progress: Progress | None,
) -> tuple[Status, ParticipantError | None, int]:
    """Make the macro steps; status, the failure if there was one, whole steps made."""
    last = len(times) - 1
    done = 0
    with deferred_interrupt() as interrupt:
        try:
            while done < last and not interrupt.requested:
                exchange.time = times[done]
                scheme.step(exchange, times[done + 1] - times[done])
                done += 1
                recording.add(times[done], exchange, keep=done % record_every == 0)
                if progress is not None:
                    progress(times[done])
        except ParticipantError as error:
            # A second Ctrl-C in the middle of a step reaches us as that participant's failure.
            return ("interrupted" if interrupt.requested else "failed"), error, done
        except KeyboardInterrupt:
            return "interrupted", None, done
    return ("complete" if done == last else "interrupted"), None, done


def _reason(status: Status, error: ParticipantError | None, reached: float) -> str:
    if status == "interrupted":
        return f"interrupted at t = {reached:.9g} s"
    return "" if error is None else str(error)
