"""A coupled run: initial exchange, macro steps, result."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Callable, Iterable
from typing import NamedTuple

from cosim.coupling.exchange import Exchange
from cosim.coupling.initial import initial_exchange
from cosim.coupling.participant import CouplingError, ParticipantError
from cosim.coupling.record.keeper import Keep, Keeper
from cosim.coupling.result import CoupledResult, Recording, Status, ledger_of
from cosim.coupling.schemes.scheme import Scheme
from cosim.coupling.step_control.control import STOP, ConvergenceError, StepControl, Stepper
from cosim.coupling.step_control.fixed import FixedStep
from cosim.coupling.step_control.precheck import check_restore, remarks_of, try_restore
from cosim.coupling.system import CoupledSystem
from cosim.files import OutputError
from cosim.interrupts import deferred_interrupt

Progress = Callable[[float], None]
#: Of the initial exchange, see `initial_exchange`.
EXCHANGE_TOLERANCE, EXCHANGE_SWEEPS = 4 * math.ulp(1.0), 100


class _March(NamedTuple):
    """How the steps ended: status, the failure if there was one, time reached in s."""

    status: Status
    error: Exception | None
    reached: float


def run(
    system: CoupledSystem,
    scheme: Scheme,
    *,
    stop: float,
    macro_step: float | None = None,
    control: StepControl | None = None,
    start: float = 0.0,
    events: Iterable[float] = (),
    on_divergence: str = STOP,
    smallest_step: float = 0.0,
    record_every: int = 1,
    keep: Keep | None = None,
    observe: Progress | None = None,
    progress: Progress | None = None,
) -> CoupledResult:
    """Run a coupled system from start to stop (s).

    macro_step: size of the steps, s; or control: says how long they are.
    events: known times (s) at which something jumps or bends; each is a communication point.
    on_divergence: what is done where an iteration does not converge: "stop", "halve" the step down
    to smallest_step (s), or "accept" it and say so in the statistics.
    record_every: keep every n-th communication point (and always the first and the last).
    keep: what to leave on disk meanwhile; where that holds a checkpoint, the run goes on from it,
    with the same result as one that was never cut off.
    observe: called with the time (s) of every state that stands: of the start, or of where the run
    goes on, and after each step that is accepted. An OutputError that it raises ends the run.
    progress: called with the time reached (s) after each macro step.
    An interrupt, a participant that fails in a step, or an iteration that does not converge ends
    the run, as does a disk that takes no more; the result then holds everything recorded up to the
    last step accepted, and says so.
    Raises CouplingError when the run as asked for makes no sense or the initial exchange does not
    settle, ParticipantError when a participant fails before the first step, CheckpointError when
    what there is to go on from is damaged or of another case, OutputError when the disk refuses
    before the first step. Closing the participants is left to the caller, who may want to ask them
    for more.
    """
    if record_every < 1:
        raise CouplingError(f"record_every = {record_every}: must be at least 1")
    control = _control(control, macro_step)
    control.begin(start, stop, scheme)
    scheme.check(system)
    remarks = (*control.check(system), *remarks_of(system, scheme, control, stop - start))
    marks = check_restore(system, scheme, control, on_divergence)
    exchange = Exchange(system)
    for remark in remarks:
        exchange.remark(remark, None)
    sweeps = _initialise(exchange, scheme.order, start, stop)
    if scheme.needs_restore or control.needs_restore or marks:
        try_restore(exchange, start, min(control.first_size, stop - start))
    exchange.accept(start)
    goals = sorted({*(event for event in events if start < event < stop), stop})
    details = {"start": start, "goals": goals, "record_every": record_every}
    keeper = None if keep is None else Keeper(keep, exchange, scheme, control, details)
    rows = _Rows(exchange, start, keep, keeper, record_every, observe)
    stepper = Stepper(
        exchange, scheme, on_divergence=on_divergence, smallest=smallest_step, marks=marks
    )
    march = _march(stepper, control, goals, rows, progress)
    return _result(march, exchange, rows, sweeps, remarks)


def _result(
    march: _March, exchange: Exchange, rows: _Rows, sweeps: int, remarks: tuple[str, ...]
) -> CoupledResult:
    recording, values = rows.recording, rows.recording.values()
    return CoupledResult(
        time=recording.time,
        values=values,
        units=recording.units,
        ledger=ledger_of(exchange.system, values),
        status=march.status,
        reason=_reason(march),
        error=march.error,
        wall_time=rows.seconds(),
        sweeps=sweeps,
        steps=exchange.statistics.steps,
        statistics=exchange.statistics,
        remarks=remarks,
    )


def _control(control: StepControl | None, macro_step: float | None) -> StepControl:
    if control is not None and macro_step is None:
        return control
    if control is None and macro_step is not None:
        return FixedStep(macro_step)
    raise CouplingError("name either macro_step or control, which says how long the steps are")


def _initialise(exchange: Exchange, order: tuple[str, ...], start: float, stop: float) -> int:
    participants = exchange.system.participants
    for name in order:
        exchange.asked(name, participants[name].enter_initialisation, start, stop)
    sweeps = initial_exchange(exchange, order, EXCHANGE_TOLERANCE, EXCHANGE_SWEEPS)
    for name in order:
        exchange.asked(name, participants[name].exit_initialisation)
        exchange.collect(name)
    return sweeps


class _Rows:
    """What becomes of the communication points: rows, thinned out, and now and then a checkpoint.

    Where `keeper` holds a checkpoint, the participants go on from it, and so do rows and clock,
    which stood still meanwhile; else the start (s) is the first row. every: communication points
    for a row; observe: called with each time.
    """

    def __init__(
        self,
        exchange: Exchange,
        start: float,
        keep: Keep | None,
        keeper: Keeper | None,
        every: int,
        observe: Progress | None,
    ):
        passed = None if keeper is None else keeper.passed()
        self.recording = Recording(
            exchange.system,
            None if keep is None else keep.folder,
            None if passed is None else passed.place,
        )
        if passed is None:
            self.recording.add(start, exchange)
        self._keeper, self._every, self._observe = keeper, every, observe
        self._counted = passed.rows if passed else 0
        self._began = clock.perf_counter() - (passed.seconds if passed else 0.0)

    def begin(self, time: float) -> None:
        """The run stands where it starts from, or goes on from (s); that has a row."""
        if self._observe is not None:
            self._observe(time)

    def add(self, time: float, exchange: Exchange, is_row: bool) -> None:
        """A step was accepted and has come to a time (s)."""
        self._counted += is_row
        keep = is_row and self._counted % self._every == 0
        self.recording.add(time, exchange, keep=keep)
        if self._observe is not None:
            self._observe(time)
        if self._keeper is not None:
            self._keeper.look(self.recording.table, self._counted, self.seconds())

    def save(self) -> None:
        """The run ends here for now."""
        if self._keeper is not None:
            self._keeper.save(self.recording.table, self._counted, self.seconds())

    def seconds(self) -> float:
        """How long the run has taken."""
        return clock.perf_counter() - self._began


def _march(
    stepper: Stepper,
    control: StepControl,
    goals: list[float],
    rows: _Rows,
    progress: Progress | None,
) -> _March:
    """Make the macro steps, to one goal (s) after the other."""
    exchange = stepper.exchange
    reached = float(exchange.time or 0.0)
    with deferred_interrupt() as interrupt:
        try:
            rows.begin(reached)
            # a run that goes on at a goal has the end of that still to come
            for goal in (each for each in goals if each >= reached):
                while reached < goal:
                    if interrupt.requested:
                        rows.save()
                        return _March("interrupted", None, reached)
                    reached = control.step(stepper, goal)
                    exchange.statistics.steps += 1
                    rows.add(reached, exchange, control.is_row())
                    if progress is not None:
                        progress(reached)
                exchange.history.forget_past()
        except (ParticipantError, ConvergenceError, OutputError) as error:
            # A second Ctrl-C in the middle of a step reaches us as that participant's failure.
            return _March("interrupted" if interrupt.requested else "failed", error, reached)
        except KeyboardInterrupt:
            return _March("interrupted", None, reached)
    return _March("complete", None, reached)


def _reason(march: _March) -> str:
    if march.status == "interrupted":
        return f"interrupted at t = {march.reached:.9g} s"
    return "" if march.error is None else str(march.error)
