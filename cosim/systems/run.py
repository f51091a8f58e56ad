"""A system from its file to its results."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cosim.coupling import CoupledResult, Message, run
from cosim.coupling.methods import smallest_step
from cosim.coupling.record import Keep, RunFolder
from cosim.names import unknown_name
from cosim.result import RunResult
from cosim.systems.assembly import FIXED, Assembly, assemble, record_every
from cosim.systems.specification import Settings, Start, SystemFault, SystemSpecification, naming
from cosim.systems.ssp.reader import read_ssp
from cosim.systems.toml_file import read_toml

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

#: What a run is drawn by, which knows the run: asked for by name, by who wants it drawn, so that
#: nothing here waits for matplotlib.
SHOW = "cosim.systems.show"


@dataclass(frozen=True)
class SystemRun(RunResult):
    """What was run, and what came out; by name, as `run["unit.port"]`, what `to_xarray` has.

    assembly: its participants are closed, their ports can be asked for.
    """

    specification: SystemSpecification
    assembly: Assembly
    result: CoupledResult

    def __repr__(self) -> str:
        """How far it came, in one line."""
        return f"<SystemRun of {', '.join(self.assembly.system.participants)}: {self.result!r}>"

    def to_xarray(self) -> xarray.Dataset:
        """The dataset that `stickslip couple` writes as ``result.nc``: every output and connected
        input as `unit.port` over ``time`` (n,), with units, and the macro steps over
        ``step_time``."""
        dataset: xarray.Dataset = self._columns.to_xarray()
        return dataset

    @cached_property
    def _columns(self) -> Any:
        return import_module(f"{SHOW}.summary").system_columns(self)

    @property
    def steps(self) -> NDArray[np.float64]:
        """Size of the macro steps that lead to each row but the first, s, (n - 1,): their mean."""
        since, control = np.diff(self.result.time), self.specification.coupling.step_control
        return (
            since / np.ceil(since / self.assembly.macro_step - 1e-6) if control == FIXED else since
        )

    def summary(self) -> dict[str, Any]:
        """The numbers of ``summary.json``: status, ledger, outputs, how it was coupled."""
        numbers: dict[str, Any] = import_module(f"{SHOW}.summary").summary(self, self._columns)
        return numbers

    def plot(self, figure: str = "signals") -> Figure:
        """One of the figures of the run's page: signals, system, energy or steps.

        Raises ValueError for a name that is none, or of which the run has nothing to show.
        """
        figures = import_module(f"{SHOW}.figures")
        drawn: Figure = figures.figure_of(self, self._columns, figure)
        return drawn

    def _answer(self) -> tuple[str, Sequence[tuple[str, str]]]:
        page, numbers = import_module(f"{SHOW}.page"), self.summary()
        return page.headline(numbers), page.tiles(numbers)

    def _page(self) -> str:
        pictures = import_module(f"{SHOW}.figures").pictures(self, self._columns)
        text: str = import_module(f"{SHOW}.page").page(self.summary(), pictures)
        return text

    def _write(self, folder: Path) -> None:
        import_module(SHOW).write_system(self, folder)


def read_system(path: str | Path, changes: Mapping[str, Any] | None = None) -> SystemSpecification:
    """The system in an SSP file (.ssp, or .ssd and folder of the same contents) or a TOML file.

    changes: `coupling.key`, `run.key` or `unit.variable` -> value, in place of what the file has.
    Raises SystemFault in one line. To be closed: the units of an archive are unpacked for as long.
    """
    path = Path(path)
    if not path.exists():
        raise SystemFault(f"{path}: no such file, allowed is an SSP or a TOML file")
    if not (path.is_dir() or path.is_file()):  # a pipe or a device may never end
        raise SystemFault(f"{path}: is no regular file, allowed is an SSP or a TOML file")
    archive = path.is_dir() or path.suffix.lower() in (".ssp", ".ssd") or _is_zip(path)
    of_tables: dict[str, Any] = {}
    of_units: dict[str, Any] = {}
    for key, value in (changes or {}).items():
        (of_tables if key.partition(".")[0] in Settings.model_fields else of_units)[key] = value
    specification = (read_ssp if archive else read_toml)(path, of_tables)
    with specification.closed_if_refused():
        return _set(specification, of_units)


def _set(specification: SystemSpecification, changes: Mapping[str, Any]) -> SystemSpecification:
    """The system with variables of units set to other values: `unit.variable` -> value."""
    units = {unit.name: unit for unit in specification.units}
    for key, value in changes.items():
        name, _, variable = key.partition(".")
        if name not in units or not variable:
            known = unknown_name("unit", name, units)
            raise SystemFault(
                f"{key}: {known}; allowed are keys of coupling and run, and UNIT.VARIABLE"
            )
        if not isinstance(value, (bool, int, float, str)):
            raise SystemFault(
                f"{key}: not possible ({value}), allowed is a number, true, false or a text"
            )
        given = units[name].given | {variable: Start(value)}  # type: ignore[operator]
        units[name] = replace(units[name], given=given)
    return replace(specification, units=[*units.values()])


def run_system(
    specification: SystemSpecification,
    progress: Callable[[float], None] | None = None,
    folder: RunFolder | None = None,
    *,
    heard: Callable[[Message], object] | None = None,
    debug: bool = False,
) -> SystemRun:
    """Run a system.

    progress: called with the time reached (s) after each macro step. folder: for rows and
    checkpoints while the run goes; where it holds a checkpoint, the run goes on from that.
    heard: called with what units and master say, as it comes. debug: ask units for more of it.
    A run that is interrupted or fails returns what it had; `result.status` says so. Raises
    SystemFault, FmuError, CouplingError or CheckpointError for input that cannot be,
    ParticipantError when a unit fails before the first step.

    >>> from cosim import read_system, run_system
    >>> from cosim.fmu.build import ensure_fmu
    >>> pair = ensure_fmu("units", "StickSlipThermal.ssp")
    >>> with read_system(pair, {"run.stop": 0.1}) as system:
    ...     run = run_system(system)
    >>> run
    <SystemRun of mechanics, thermal: <CoupledResult, complete: 0.1 s in 10 macro steps, ...>>
    """
    assembly = assemble(specification, debug)
    settings = specification.coupling
    with assembly.system as system:
        if heard is not None:
            system.listen(heard)
        with naming(specification.source):
            result = run(
                system,
                assembly.scheme,
                start=specification.run.start,
                stop=specification.run.stop,
                control=assembly.control,
                on_divergence=settings.on_divergence,
                smallest_step=smallest_step(settings, assembly.macro_step),
                record_every=record_every(specification, assembly.macro_step),
                keep=_kept(specification, folder),
                progress=progress,
            )
    return SystemRun(specification, assembly, result)


def check_system(specification: SystemSpecification) -> None:
    """Refuse, as `run_system` does, what can be seen without a unit's library being loaded."""
    units = [replace(unit, isolate=False) for unit in specification.units]
    with assemble(replace(specification, units=units)).system:
        pass


def _kept(specification: SystemSpecification, folder: RunFolder | None) -> Keep | None:
    """What is on disk meanwhile; a checkpoint is of the same system with the same units."""
    if folder is None:
        return None
    files = {f"unit {unit.name}": unit.file for unit in specification.units}
    files |= {
        f"inputs of {unit.name}": unit.input_file
        for unit in specification.units
        if unit.input_file is not None
    }
    setup = {"system": specification.text} | {
        what: hashlib.sha256(file.read_bytes()).hexdigest() for what, file in files.items()
    }
    run = specification.run
    how_often = {"seconds": run.checkpoint_seconds, "steps": run.checkpoint_steps}
    return Keep(folder, setup=setup, **how_often)  # type: ignore[arg-type]


def _is_zip(path: Path) -> bool:
    try:
        with path.open("rb") as file:
            return file.read(2) == b"PK"
    except OSError:
        return False
