"""An FMI 2.0 or 3.0 co-simulation FMU as a participant, through fmpy."""

import copy
import json
import os
import tempfile
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from fmpy.fmi1 import FMICallException

from cosim.coupling.fmu.archive import unpack
from cosim.coupling.fmu.description import (
    describe,
    is_fmi3,
    library_of,
    may_end_early,
    takes_waveforms,
    unloadable,
)
from cosim.coupling.fmu.errors import FmuCallError, FmuError, one_line
from cosim.coupling.fmu.instance import STATUSES, Fmi2, Fmi3, FmuLog
from cosim.coupling.fmu.module_conflicts import claim_modules, claim_place, leave_place
from cosim.coupling.fmu.variables import (
    REALS,
    START,
    Group,
    Setting,
    Values,
    check_settings,
    ports_of,
    scalars,
)
from cosim.coupling.messages import Messages
from cosim.coupling.participant import Capabilities, Causality, Closing, port_table
from cosim.coupling.waveform import Waveform

Result = TypeVar("Result")
FATAL = STATUSES.index("fatal")


@dataclass(eq=False)
class State:
    """A state of an instance, with what its host knew then."""

    handle: Any
    known: dict[str, Any]
    memory: dict[str, Any]


class FmuParticipant(Closing):
    """Ports, units and causalities come from the FMU's modelDescription.xml.

    path: the FMU. name: its name in the coupled system, the model's name when left out.
    parameters: name -> value, set before initialisation. inputs: name -> value of inputs that
    are held over the run (a connection to the same input overrides it). starts: name -> value from
    which other variables start, where the FMU lets them be set. Elements of an array are ports and
    parameters `name[1]`, `name[1,2]`.
    tolerance: handed to the FMU when given; what it means is up to the FMU.
    early_return: whether it may end steps early, where it can (FMI 3.0).
    input_order: highest derivative of its inputs that it is given, where it takes them (FMI 2.0
    has no place to say which it takes; one that it does not take is a failure).
    debug: whether messages of status "ok" are kept, too.
    messages: what it has logged, whatever its `loggingOn`.
    Raises FmuError when the file is no FMI 2.0 or 3.0 co-simulation FMU or a setting does not fit.
    """

    def __init__(
        self,
        path: str | Path,
        name: str | None = None,
        *,
        parameters: Mapping[str, Setting] | None = None,
        inputs: Mapping[str, Setting] | None = None,
        starts: Mapping[str, Setting] | None = None,
        tolerance: float | None = None,
        early_return: bool = True,
        input_order: int = 1,
        debug: bool = False,
    ):
        self.path: Path = Path(path)
        self.description = describe(self.path)
        self.name = name or self.description.modelName
        self._table = scalars(self.description)
        self.ports = port_table(ports_of(self.description, self._table))
        parameters, inputs, starts = parameters or {}, inputs or {}, starts or {}
        for kind, given in (("parameter", parameters), ("input", inputs), (START, starts)):
            check_settings(self.name, self._table, given, kind)
        self._parameters, self._inputs = {**parameters, **starts}, inputs
        self._tolerance, self._early, self._debug = tolerance, early_return, debug
        self._input_order = input_order
        self._kind: type[Fmi2 | Fmi3] = Fmi3 if is_fmi3(self.description) else Fmi2
        self.capabilities = self._capabilities()
        self.messages: Messages = Messages(self.name)
        #: Inputs that derivatives can be given of -> reference.
        self._smooth = {
            name: each.variable.valueReference
            for name, each in self._table.items()
            if each.variable.type in REALS and each.variable.variability == "continuous"
        }
        self._outputs = [p.name for p in self.ports.values() if p.causality is Causality.OUTPUT]
        self._directory: tempfile.TemporaryDirectory[str] | None = None
        self._calls: Fmi2 | Fmi3 | None = None
        self._begin_anew()

    def _begin_anew(self) -> None:
        self._values = Values(self._table, self._kind.enumeration)
        self._readers: list[Group] = self._values.groups(self._outputs)
        self._states: set[State] = set()
        self._sloped: set[str] = set()
        self._running = self._dead = self._has_place = False
        self.messages.time = None

    def _capabilities(self) -> Capabilities:
        declared = self.description.coSimulation
        restores = bool(declared.canGetAndSetFMUstate)
        waveforms = takes_waveforms(self.description)
        return Capabilities(
            waveforms=waveforms,
            # who takes none gets a mean, which the schemes count on
            input_order=self._input_order if waveforms else None,
            restores=restores,
            saves=restores and bool(declared.canSerializeFMUstate),
            ends_early=self._early and may_end_early(self.description),
        )

    # --- initialisation ---

    def enter_initialisation(self, start: float, stop: float) -> None:
        """Start a fresh instance with the parameters and held inputs set."""
        self._free_instance()
        calls = self._instantiate()
        self._call(calls.set_up, start, stop, self._tolerance)
        self._call(calls.write, self._values.filled(self._parameters))
        self._call(calls.enter_initialisation)
        self._call(calls.write, self._values.filled(self._inputs))

    def exit_initialisation(self) -> None:
        """The FMU checks its parameters here; a combination that cannot be is refused."""
        self._call(self._instance().exit_initialisation)
        self._running = True

    def _instantiate(self) -> Fmi2 | Fmi3:
        folder, library = self._unpacked()
        claim_modules(self.path, folder)
        claim_place(self.path, self.description)
        self._has_place = True
        self._log = FmuLog(self.messages, self._debug)
        given = {
            "guid": self.description.guid,
            "unzipDirectory": str(folder),
            "modelIdentifier": self.description.coSimulation.modelIdentifier,
            "instanceName": self.name,
        }
        home = os.getcwd()
        try:
            self._calls = self._kind(self.description, self._log, self._early, given)
        # fmpy raises bare Exception for a library that does not load or refuses.
        except Exception as error:
            os.chdir(home)  # which fmpy has left then
            said = self._log.take_errors()
            self._log.close()
            self._free_instance()
            if refused := unloadable(self.path, folder, library, error):
                raise refused from error
            raise FmuCallError(f"{one_line(error)} {said}".strip()) from error
        return self._calls

    def _unpacked(self) -> tuple[Path, Path]:
        """The folder of this participant, and the library in it; unpacked anew where somebody has
        removed it."""
        if self._directory is not None:
            folder = Path(self._directory.name)
            with suppress(FmuError):
                return folder, library_of(self.path, folder, self.description)
            self._remove_folder()
        self._directory = unpack(self.path)
        folder = Path(self._directory.name)
        return folder, library_of(self.path, folder, self.description)

    # --- values ---

    def write(self, values: Mapping[str, float]) -> None:
        """Set inputs by name."""
        calls = self._instance()
        self._call(calls.write, self._values.filled(values))
        if self._sloped and (held := self._sloped.intersection(values)):
            level = (0.0,) * self._input_order
            self._call(calls.write_rates, {self._smooth[name]: level for name in held})

    def read(self) -> dict[str, float]:
        """All outputs by name."""
        calls = self._instance()
        found: dict[str, float] = {}
        for group in self._readers:
            found |= self._call(calls.read, group)
        return found

    def write_waveforms(self, waveforms: Mapping[str, Waveform]) -> None:
        """Set inputs as functions of time over the next step, where `capabilities` says so.

        By value and derivatives at its start; what is of a higher degree than `input_order` goes
        straight from the value at its start to that at its end. What is no real number, or
        changes at events only, gets the mean.
        """
        if not self.capabilities.waveforms:
            raise FmuError(f"{self.path}: takes no derivatives of inputs")
        smooth = {n: self._rates(wave) for n, wave in waveforms.items() if n in self._smooth}
        self._sloped.update(smooth)
        starts = {n: wave.start if n in smooth else wave.mean for n, wave in waveforms.items()}
        calls = self._instance()
        self._call(calls.write, self._values.filled(starts))
        self._call(calls.write_rates, {self._smooth[n]: rates for n, rates in smooth.items()})

    def _rates(self, waveform: Waveform) -> tuple[float, ...]:
        rates = waveform.rates
        if len(rates) > self._input_order:
            rates = ((waveform.end - waveform.start) / waveform.size,)
        return rates + (0.0,) * (self._input_order - len(rates))

    def step(self, time: float, size: float) -> float | None:
        """One communication step from time, of length size (s); see `Participant.step`."""
        self.messages.time = time
        return self._call(self._instance().step, time, size, bool(self._states))

    # --- states ---

    def get_state(self) -> State:
        """The FMU's state in its own memory; to be given back with `free_state`."""
        self._require(self.capabilities.restores, "canGetAndSetFMUstate")
        return self._kept(self._call(self._instance().get_state))

    def set_state(self, state: State) -> None:
        """Go back to a state of this instance."""
        self._check_own(state)
        calls = self._instance()
        self._call(calls.set_state, state.handle)
        self._values.known = dict(state.known)
        calls.memory = copy.deepcopy(state.memory)

    def free_state(self, state: State) -> None:
        """Release a state."""
        self._check_own(state)
        self._states.remove(state)
        if not self._dead:  # else it is gone, and why has been said
            self._call(self._instance().free_state, state.handle)

    def save_state(self) -> bytes:
        """The FMU's state as bytes, behind a line that says whose it is."""
        self._require(self.capabilities.saves, "canSerializeFMUstate")
        state = self.get_state()
        try:
            content: bytes = self._call(self._instance().as_bytes, state.handle)
        finally:
            self.free_state(state)
        head = {"unit": self._identity(), "known": state.known, "memory": state.memory}
        return json.dumps(head).encode() + b"\n" + content

    def load_state(self, saved: bytes) -> None:
        """Go on from what `save_state` gave; FmuError where that was another unit's."""
        self._require(self.capabilities.saves, "canSerializeFMUstate")
        line, _, content = saved.partition(b"\n")
        try:
            head = json.loads(line)
            unit, known, memory = head["unit"], head["known"], head["memory"]
        except (ValueError, KeyError, TypeError) as error:
            raise FmuError(f"{self.name}: what is to be its state is none, or damaged") from error
        if unit != self._identity():
            raise FmuError(f"{self.path}: the state is that of {unit}, not of {self._identity()}")
        state = self._kept(self._call(self._instance().from_bytes, content))
        state.known, state.memory = known, memory
        try:
            self.set_state(state)
        finally:
            self.free_state(state)

    def _identity(self) -> str:
        return f"{self.description.modelName} {self.description.guid}"

    def _kept(self, handle: Any) -> State:
        state = State(handle, dict(self._values.known), copy.deepcopy(self._instance().memory))
        self._states.add(state)
        return state

    def _check_own(self, state: State) -> None:
        """C is given only what it has made and not yet freed: else it crashes."""
        if state not in self._states:
            raise FmuCallError("is given a state that is not its own, or not any more")

    def _require(self, able: bool, key: str) -> None:
        if not able:
            raise FmuError(f"{self.path}: declares {key} = false")

    # --- the instance ---

    def _instance(self) -> Fmi2 | Fmi3:
        if self._calls is None:
            raise FmuCallError("is not initialised")
        return self._calls

    def _call(self, function: Callable[..., Result], *arguments: Any) -> Result:
        """Call; a bad status, or an error that is logged, becomes an exception.

        Some FMUs (pythonfmu's among them) cannot return an error from a setter or from the end
        of initialisation and only log it; to go on would give numbers from refused values.
        """
        if self._dead:
            raise FmuCallError("has reported a fatal error and cannot be called any more")
        try:
            result = function(*arguments)
        except (FMICallException, FmuCallError) as error:
            self._dead = getattr(error, "status", None) == FATAL
            said = self._log.take_errors()
            text = f"{said} [{error}]" if said else str(error)
            raise FmuCallError(text + self._if_removed()) from error
        if self._log.failures:
            raise FmuCallError(self._log.take_errors() + self._if_removed())
        return result

    def _if_removed(self) -> str:
        """What explains a good many failures."""
        if self._directory is not None and not os.path.isdir(self._directory.name):
            return f"; the folder that it was unpacked in has been removed: {self._directory.name}"
        return ""

    def _free_instance(self) -> None:
        calls, self._calls = self._calls, None
        if calls is not None and not self._dead:
            # after a fatal error no function may be called any more
            with suppress(FMICallException, FmuCallError):
                for state in self._states:
                    calls.free_state(state.handle)
            # an instance that has failed before refuses to terminate; it is freed all the same
            with suppress(FMICallException):
                if self._running:
                    calls.terminate()
            calls.free()
        if calls is not None:
            self._log.close()
        if self._has_place:
            leave_place(self.path, self.description)
        self._begin_anew()

    def close(self) -> None:
        """End the instance, unload the library, remove the unpacked files."""
        self._free_instance()
        self._remove_folder()

    def _remove_folder(self) -> None:
        if self._directory is not None:
            self._directory.cleanup()
            self._directory = None
