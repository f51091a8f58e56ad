"""A system of units as its file has it: what SSP and TOML have in common."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from cosim.coupling import Affine, Curve, UnitDefinition
from cosim.coupling.participant import Closing
from cosim.systems.settings import NOT_GIVEN, Coupling, Run

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
