"""A coupled run, initial exchange and macro steps, and what it returns, also before its end.

To every result belongs its energy ledger: what was handed over, what was taken up, what is missing.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from cosim.coupling.exchange import Exchange, Statistics
from cosim.coupling.initial import check_restore, initialise, remarks_of, try_restore
from cosim.coupling.participant import CouplingError, ParticipantError
from cosim.coupling.record.keeper import Keep, Keeper
from cosim.coupling.schemes import Scheme
from cosim.coupling.step_control.control import (
    STOP,
    ConvergenceError,
    FixedStep,
    StepControl,
    Stepper,
)
from cosim.coupling.system import Connection, CoupledSystem
from cosim.files import OutputError
from cosim.interrupts import deferred_interrupt
from cosim.names import unknown_name

if TYPE_CHECKING:
    import xarray

Status = Literal["complete", "interrupted", "failed"]


@dataclass(frozen=True)
class EnergyFlow:
    """The joules that crossed one connection since the run's start, at the recorded times.

    handed, taken: arrays (n,) in J, both 0 at the start.
    """

    connection: Connection
    handed: np.ndarray
    taken: np.ndarray

    @property
    def in_transit(self) -> np.ndarray:
        """Handed over and not yet taken up, J, (n,)."""
        found: np.ndarray = self.handed - self.taken
        return found


@dataclass(frozen=True)
class Ledger:
    """Energy of the whole coupled system at the recorded times.

    flows: one for each connection that carries energy.
    residuals: `participant.port` -> what the participant's own ledger is off by, J, (n,).
    """

    flows: tuple[EnergyFlow, ...]
    residuals: Mapping[str, np.ndarray]

    @property
    def residual(self) -> np.ndarray:
        """What is in transit plus what the participants are off by, J, (n,); () with no record."""
        parts = [flow.in_transit for flow in self.flows] + list(self.residuals.values())
        return np.sum(parts, axis=0) if parts else np.zeros(0)


@dataclass(frozen=True, repr=False)
class CoupledResult:
    """A coupled run up to where it came.

    time: recorded times in s, (n,). values: `participant.port` -> (n,), all outputs and the
    connected inputs. units: same keys -> unit. ledger: energy at the same times.
    status: "complete"; "interrupted" (by the user); "failed" (error holds the exception).
    reason: one line on why it is not complete, else "". wall_time: of the steps, s.
    sweeps: how many sweeps the initial exchange took. steps: macro steps accepted. statistics: of
    the participants and the scheme. remarks: what of the settings could not be checked or comes to
    something else than they say, a line each.
    """

    time: np.ndarray
    values: Mapping[str, np.ndarray]
    units: Mapping[str, str]
    ledger: Ledger
    status: Status
    reason: str
    error: Exception | None
    wall_time: float
    sweeps: int
    steps: int
    statistics: Statistics
    remarks: tuple[str, ...] = ()

    @property
    def converged(self) -> bool:
        """Whether no step was accepted whose iteration had not converged."""
        return not self.statistics.unconverged

    def __getitem__(self, name: str) -> np.ndarray:
        """The recorded values of `participant.port`, (n,)."""
        if name not in self.values:
            raise KeyError(unknown_name("recorded variable", name, self.values))
        return self.values[name]

    def __repr__(self) -> str:
        """What it is of, in one line."""
        reached = f"{self.time[-1]:.6g} s" if self.time.size else "no time"
        ended = f" ({self.reason})" if self.reason else ""
        return (
            f"<CoupledResult, {self.status}{ended}: {reached} in {self.steps} macro steps, "
            f"{self.time.size} rows of {len(self.values)} variables>"
        )

    def to_xarray(self) -> "xarray.Dataset":
        """Every recorded variable over ``time`` (n,), by its name `participant.port`, with units;
        ``energy_residual``: that of the ledger, J."""
        import xarray  # only for who asks for it

        variables = {
            name: ("time", values, {"units": self.units[name]})
            for name, values in self.values.items()
        } | {"energy_residual": ("time", self.ledger.residual, {"units": "J"})}
        time = ("time", self.time, {"units": "s", "long_name": "time"})
        return xarray.Dataset(
            variables, {"time": time}, {"status": self.status, "reason": self.reason}
        )


def ledger_of(system: CoupledSystem, values: Mapping[str, np.ndarray]) -> Ledger:
    """The ledger that the recorded values (`participant.port` -> (n,)) contain."""
    flows = tuple(
        EnergyFlow(
            connection,
            # what goes over this connection, where a factor splits a source among several
            system.conversions[connection].factor * _since_start(values[str(connection.source)]),
            _since_start(values[str(connection.taken)]),
        )
        for connection in system.connections
        if connection.taken is not None
    )
    return Ledger(flows, {str(address): values[str(address)] for address in system.residuals})


def _since_start(values: np.ndarray) -> np.ndarray:
    return values - values[0] if values.size else values


Progress = Callable[[float], object]


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
    exchange = Exchange(system)
    for remark in remarks:
        exchange.remark(remark, None)
    marks = check_restore(system, scheme, control, on_divergence)
    sweeps = initialise(exchange, scheme.order, start, stop)
    if scheme.needs_restore or control.needs_restore or marks:
        try_restore(exchange, start, min(control.first_size, stop - start))
    exchange.accept(start)
    goals = sorted({*(event for event in events if start < event < stop), stop})
    details = {"start": start, "goals": goals, "record_every": record_every}
    keeper = Keeper(keep, exchange, scheme, control, details)
    stepper = Stepper(
        exchange, scheme, on_divergence=on_divergence, smallest=smallest_step, marks=marks
    )
    ended = _march(stepper, control, goals, keeper, observe or _unheard, progress or _unheard)
    return _result(exchange, keeper, sweeps, remarks, *ended)


def _result(
    exchange: Exchange,
    keeper: Keeper,
    sweeps: int,
    remarks: tuple[str, ...],
    status: Status,
    error: Exception | None,
    reached: float,
) -> CoupledResult:
    """What is recorded of a run that has ended as `_march` says."""
    reason = "" if error is None else str(error)
    if status == "interrupted":
        reason = f"interrupted at t = {reached:.9g} s"
    keeper.recording.end()
    values = keeper.recording.values()
    return CoupledResult(
        time=keeper.recording.time,
        values=values,
        units=keeper.recording.units,
        ledger=ledger_of(exchange.system, values),
        status=status,
        reason=reason,
        error=error,
        wall_time=keeper.seconds(),
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


def _unheard(time: float) -> None:
    """Nobody wants to know."""


def _march(
    stepper: Stepper,
    control: StepControl,
    goals: list[float],
    keeper: Keeper,
    observe: Progress,
    progress: Progress,
) -> tuple[Status, Exception | None, float]:
    """Make the macro steps, to one goal (s) after the other: how they ended, what failed, and the
    time reached, s."""
    exchange = stepper.exchange
    reached = float(exchange.time or 0.0)
    with deferred_interrupt() as interrupt:
        try:
            observe(reached)
            # a run that goes on at a goal has the end of that still to come
            for goal in (each for each in goals if each >= reached):
                while reached < goal:
                    if interrupt.requested:
                        keeper.save()
                        return "interrupted", None, reached
                    began, reached = reached, control.step(stepper, goal)
                    exchange.statistics.count(reached - began)
                    keeper.add(reached, control.is_row())
                    observe(reached)
                    keeper.look()
                    progress(reached)
                exchange.history.forget_past()
        except (ParticipantError, ConvergenceError, OutputError) as error:
            # A second Ctrl-C in the middle of a step reaches us as that participant's failure.
            return "interrupted" if interrupt.requested else "failed", error, reached
        except KeyboardInterrupt:
            return "interrupted", None, reached
    return "complete", None, reached
