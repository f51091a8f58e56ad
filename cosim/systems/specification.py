"""A system of units as its file has it: what SSP and TOML have in common, and what is wrong."""

import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Self

from pydantic import model_validator
from stickslip.quantity import Table, quantity

from cosim.coupling import Affine, CouplingError, Curve, FmuError, UnitDefinition
from cosim.coupling.participant import Closing
from cosim.scenario.method import Method
from cosim.scenario.validation import ScenarioError


class SystemFault(ValueError):
    """A system cannot be read or makes no sense; one line: file, key, what, what is allowed."""


@contextmanager
def naming(source: str, key: str = "") -> Iterator[None]:
    """Let a fault of a system say file and key, where it does not yet."""
    try:
        yield
    except (SystemFault, ScenarioError, CouplingError, FmuError) as fault:
        said = str(fault)
        kind = SystemFault if isinstance(fault, ScenarioError) else type(fault)
        if said.startswith(source):
            raise kind(said) from None
        raise kind(f"{source}: {key}: {said}" if key else f"{source}: {said}") from None


#: What a number stands at that a file leaves out.
NOT_GIVEN = math.inf


class Coupling(Method):
    """How the units talk to each other.

    power_bonds : for energy: outputs that feed each other and whose product is a power
    order : units, in the order in which they step; left out, as the file has them
    macro_step : time between two exchanges; of a step control, the first step
    """

    power_bonds: tuple[tuple[str, str], ...] = quantity((), None)
    order: tuple[str, ...] = quantity((), None)
    macro_step: float = quantity(NOT_GIVEN, "s", gt=0)


#: Keys of [coupling] that mean something to the iterated scheme alone, and to a step control alone.
_OF_ITERATION = (
    "waveform", "sweep", "acceleration", "relaxation",
    "relative_tolerance", "max_iterations", "on_divergence",
)  # fmt: skip
_OF_CONTROL = ("largest_step", "step_tolerance", "safety")


class Run(Table):
    """From when to when, and how often there is a row of results.

    start : time at which the units start
    stop : time at which the run ends
    output_interval : time between two rows of the results; left out, a row a macro step
    checkpoint_seconds : wall time between two checkpoints, from which --resume goes on, the first
        after a second; 0: none
    checkpoint_steps : the same in macro steps, whichever is first; 0: by wall time alone
    """

    start: float = quantity(0.0, "s")
    stop: float = quantity(NOT_GIVEN, "s")
    output_interval: float = quantity(NOT_GIVEN, "s", gt=0)
    checkpoint_seconds: float = quantity(30.0, "s", ge=0)
    checkpoint_steps: int = quantity(0, "1", ge=0)

    @model_validator(mode="after")
    def _has_a_length(self) -> Self:
        if self.stop <= self.start:
            raise ValueError(
                f"stop = {self.stop:g} s, allowed is a time after run.start = {self.start:g} s"
            )
        return self


class Settings(Table):
    """How a system is run: what an SSP leaves out, and what can be set from outside."""

    coupling: Coupling = Coupling()
    run: Run = Run()


def unused(coupling: Coupling, run: Run) -> list[str]:
    """What was said and has no meaning beside the rest, a line each."""
    iterated, control = coupling.scheme == "iterated", coupling.step_control
    without: dict[str, str] = {}
    if iterated:
        without["extrapolation"] = 'scheme = "iterated"'
    else:
        without |= dict.fromkeys(_OF_ITERATION, f'scheme = "{coupling.scheme}"')
    if control == "fixed":
        without |= dict.fromkeys(_OF_CONTROL, 'step_control = "fixed"')
    if control != "energy":
        without["power_bonds"] = f'step_control = "{control}"'
    said = [key for key in Coupling.model_fields if key in coupling.model_fields_set]
    lines = [f"coupling.{key} is not used with {without[key]}" for key in said if key in without]
    if control != "fixed" and "output_interval" in run.model_fields_set:
        lines.append(
            f'run.output_interval is not used with step_control = "{control}": a row a step'
        )
    return lines


#: What a variable of a unit can be set to.
Value = float | int | bool | str


@dataclass(frozen=True)
class Start:
    """A value that a variable starts from, in a unit where the file names one.

    definition: of that unit, where the file has one. converts: whether it is to be brought to the
    variable's unit, before the transformation.
    """

    value: Value
    unit: str | None = None
    definition: UnitDefinition | None = None
    transformation: Affine = Affine()
    converts: bool = True


@dataclass(frozen=True)
class UnitEntry:
    """An FMU of the system.

    name: without a dot. given: variable -> what it starts from, an input being held there over the
    run. substeps: steps of its own in each macro step. time_limit: of a call of an isolated unit,
    s. ports: port -> unit (and its definition) that the system's file states, for where the FMU
    states none. input_file: a table of inputs over time, driven: what it has, input -> curve.
    """

    name: str
    file: Path
    isolate: bool = False
    time_limit: float = NOT_GIVEN
    tolerance: float | None = None
    substeps: int = 1
    given: Mapping[str, Start] = field(default_factory=dict)
    input_file: Path | None = None
    driven: Mapping[str, Curve] = field(default_factory=dict)
    ports: Mapping[str, tuple[str, UnitDefinition | None]] = field(default_factory=dict)


@dataclass(frozen=True)
class Hop:
    """A connection on its way through the border of a sub-system, or all of it.

    unit, definition: of the connector that it ends at, None where the file does not say.
    """

    transformation: Affine = Affine()
    converts: bool = True
    unit: str | None = None
    definition: UnitDefinition | None = None


@dataclass(frozen=True)
class Link:
    """What feeds an input: `unit.port` to `unit.port`, border after border.

    taken: output of the sink's unit, in J, that says how much of an energy it has taken up. place:
    its key in the file, "" where it has none.
    """

    source: str
    sink: str
    hops: tuple[Hop, ...] = (Hop(),)
    taken: str | None = None
    place: str = ""

    def __str__(self) -> str:
        return f"{self.source} -> {self.sink}"


@dataclass(frozen=True)
class SystemSpecification(Closing):
    """A system and how it is to be run.

    text: of the file, as it was read. remarks: what the user should know of how it was read, a
    line each. residuals: `unit.port` in J that should stay 0. To be closed when the run is over:
    the units of an archive lie in a folder for the time.
    """

    name: str
    source: str
    units: Sequence[UnitEntry]
    links: Sequence[Link]
    coupling: Coupling
    run: Run
    text: str
    remarks: Sequence[str] = ()
    residuals: Sequence[str] = ()
    _held: ExitStack = field(default_factory=ExitStack, repr=False, compare=False)

    def close(self) -> None:
        """Remove what was unpacked."""
        self._held.close()

    @contextmanager
    def closed_if_refused(self) -> Iterator[None]:
        """Where nothing comes of the system, what was unpacked of it goes."""
        try:
            yield
        except BaseException:
            self.close()
            raise
