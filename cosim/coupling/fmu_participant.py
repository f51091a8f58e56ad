"""An FMI 2.0 co-simulation FMU as a participant, through fmpy."""

import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave, fmi2Fatal

from cosim.coupling import fmu_calls
from cosim.coupling.fmu_description import (
    FmuError,
    Setting,
    check_settings,
    describe,
    extract,
    ports_of,
)
from cosim.coupling.participant import Causality, port_table


class FmuCallError(RuntimeError):
    """An FMI function did not return fmi2OK, or the FMU logged an error. Says what it logged."""


class FmuParticipant:
    """Ports, units and causalities come from the FMU's modelDescription.xml.

    path: the FMU. name: its name in the coupled system, the model's name when left out.
    parameters: name -> value, set before initialisation. inputs: name -> value of inputs that
    are held over the run (a connection to the same input overrides it).
    tolerance: handed to the FMU when given; what it means is up to the FMU.
    Raises FmuError when the file is no FMI 2.0 co-simulation FMU or a setting does not fit.
    """

    def __init__(
        self,
        path: str | Path,
        name: str | None = None,
        *,
        parameters: Mapping[str, Setting] | None = None,
        inputs: Mapping[str, Setting] | None = None,
        tolerance: float | None = None,
    ):
        self.path = Path(path)
        self.description = describe(self.path)
        self.name = name or self.description.modelName
        self.ports = port_table(ports_of(self.description))
        self._variables = {v.name: v for v in self.description.modelVariables}
        self._parameters = dict(parameters or {})
        self._inputs = dict(inputs or {})
        check_settings(self.name, self._variables, self._parameters, "parameter")
        check_settings(self.name, self._variables, self._inputs, "input")
        self._tolerance = tolerance
        self._outputs = fmu_calls.Reader(
            self._variables[port.name]
            for port in self.ports.values()
            if port.causality is Causality.OUTPUT
        )
        self._directory: tempfile.TemporaryDirectory | None = None
        self._log: fmu_calls.FmuLog | None = None
        self._fmu: FMU2Slave | None = None
        self._running = False
        self._dead = False

    def enter_initialisation(self, start: float, stop: float) -> None:
        """Start a fresh instance with the parameters and held inputs set."""
        self._free_instance()
        self._instantiate()
        with self._calling() as fmu:
            fmu_calls.write(fmu, self._variables, self._parameters)
        with self._calling() as fmu:
            fmu.setupExperiment(tolerance=self._tolerance, startTime=start, stopTime=stop)
            fmu.enterInitializationMode()
            fmu_calls.write(fmu, self._variables, self._inputs)

    def exit_initialisation(self) -> None:
        """The FMU checks its parameters here; a combination that cannot be is refused."""
        with self._calling() as fmu:
            fmu.exitInitializationMode()
        self._running = True

    def write(self, values: Mapping[str, float]) -> None:
        """Set inputs by name."""
        with self._calling() as fmu:
            fmu_calls.write(fmu, self._variables, values)

    def read(self) -> dict[str, float]:
        """All outputs by name."""
        with self._calling() as fmu:
            return self._outputs.read(fmu)

    def step(self, time: float, size: float) -> None:
        """One communication step from time, of length size (s)."""
        with self._calling() as fmu:
            fmu.doStep(currentCommunicationPoint=time, communicationStepSize=size)

    @property
    def can_restore(self) -> bool:
        """Whether the FMU declares that its state can be taken and set."""
        return bool(self.description.coSimulation.canGetAndSetFMUstate)

    def get_state(self) -> object:
        """The FMU's state in its own memory; to be given back with `free_state`."""
        self._require_restore()
        with self._calling() as fmu:
            return fmu.getFMUstate()

    def set_state(self, state: object) -> None:
        """Go back to a state of this instance."""
        self._require_restore()
        with self._calling() as fmu:
            fmu.setFMUstate(state)

    def free_state(self, state: object) -> None:
        """Release a state."""
        self._require_restore()
        with self._calling() as fmu:
            fmu.freeFMUstate(state)

    def close(self) -> None:
        """End the instance, unload the library, remove the extracted files."""
        self._free_instance()
        if self._directory is not None:
            self._directory.cleanup()
            self._directory = None

    def __enter__(self) -> "FmuParticipant":
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    def _instantiate(self) -> None:
        if self._directory is None:
            self._directory = tempfile.TemporaryDirectory(prefix="fmu-")
            extract(self.path, Path(self._directory.name))
        self._log = fmu_calls.FmuLog()
        try:
            self._fmu = FMU2Slave(
                guid=self.description.guid,
                unzipDirectory=self._directory.name,
                modelIdentifier=self.description.coSimulation.modelIdentifier,
                instanceName=self.name,
            )
            self._fmu.instantiate(callbacks=self._log.callbacks, loggingOn=True)
        # fmpy raises bare Exception for a library that is missing, does not load or refuses.
        except Exception as error:
            said = self._log.take_errors()
            self._fmu = None
            raise FmuCallError(f"{error} {said}".strip()) from error

    @contextmanager
    def _calling(self) -> Iterator[FMU2Slave]:
        """Give the instance; turn a bad status, or an error that it logs, into an exception.

        Some FMUs (pythonfmu's among them) cannot return an error from a setter or from the end
        of initialisation and only log it; to go on would give numbers from refused values.
        """
        if self._fmu is None or self._log is None:
            raise FmuCallError("is not initialised")
        if self._dead:
            raise FmuCallError("has reported a fatal error and cannot be called any more")
        try:
            yield self._fmu
        except FMICallException as error:
            self._dead = error.status == fmi2Fatal
            said = self._log.take_errors()
            raise FmuCallError(f"{said} [{error}]" if said else str(error)) from error
        said = self._log.take_errors()
        if said:
            raise FmuCallError(said)

    def _require_restore(self) -> None:
        if not self.can_restore:
            raise FmuError(f"{self.path}: declares canGetAndSetFMUstate = false")

    def _free_instance(self) -> None:
        if self._fmu is not None and not self._dead:
            # FMI 2.0: after a fatal error no function may be called any more.
            if self._running:
                self._terminate(self._fmu)
            self._fmu.freeInstance()
        if self._log is not None:
            self._log.close()
        self._fmu, self._log, self._running, self._dead = None, None, False, False

    def _terminate(self, fmu: FMU2Slave) -> None:
        try:
            fmu.terminate()
        except FMICallException:
            # An instance that has failed before refuses to terminate; it is freed all the same.
            self._running = False
