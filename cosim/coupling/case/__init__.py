"""A scenario as a coupled run: the mechanical FMU and the heat in belt and ice."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cosim.coupling import (
    Connection,
    CoupledResult,
    CoupledSystem,
    FmuParticipant,
    IsolatedParticipant,
    Message,
    Participant,
    run,
)
from cosim.coupling.case.snapshots import Snapshots
from cosim.coupling.case.thermal_participant import ThermalParticipant, prepared_block
from cosim.coupling.fmu.description import describe
from cosim.coupling.methods import control_of, scheme_of, smallest_step
from cosim.coupling.record import Keep, RunFolder
from cosim.files import OutputError
from cosim.fmu.build import own_fmu
from cosim.report.scenario_run import ScenarioRun
from cosim.scenario import Scenario, as_scenario, check_work
from cosim.scenario.scenario import FILE_KEYS
from thermal import BeltIceModel

if TYPE_CHECKING:
    from cosim.report.columns import Columns

MECHANICS, THERMAL = "mechanics", "thermal"
CONNECTIONS = (
    Connection(f"{MECHANICS}.heat", f"{THERMAL}.heat", taken="heat_received"),
    Connection(f"{MECHANICS}.surface_travel", f"{THERMAL}.surface_travel"),
    Connection(f"{MECHANICS}.x", f"{THERMAL}.x"),
    # always: which of the two friction feels, if any, is a matter of its effects
    Connection(f"{THERMAL}.interface_temperature", f"{MECHANICS}.interface_temperature"),
    Connection(f"{THERMAL}.film_thickness", f"{MECHANICS}.film_thickness"),
)
RESIDUALS = (f"{MECHANICS}.energy_residual", f"{THERMAL}.heat_residual")


@dataclass(frozen=True, repr=False)
class CoupledRun(ScenarioRun):
    """What a coupled run was made of and what came out.

    By name, as `run["x"]` or `run.x`, it has every variable of `to_xarray`.

    result: every output of both sides at the recorded times, as `mechanics.x`,
    `thermal.interface_temperature`, ..., status and energy ledger. snapshots: the belt's
    contact face over time.
    """

    scenario: Scenario
    result: CoupledResult
    snapshots: Snapshots

    def __repr__(self) -> str:
        name, result = self.scenario.name, self.result
        reached = f"{result.time[-1]:.6g} s" if result.time.size else "no time"
        ended = f" ({result.reason})" if result.reason else ""
        return f"<CoupledRun of {name}, {result.status}{ended}: {reached} in {result.steps} steps>"

    @cached_property
    def _columns(self) -> Columns:
        from cosim.report.dataset import run_columns

        toml = self.scenario.to_toml()
        return run_columns(self.result, self.scenario, toml, snapshots=self.snapshots)


def run_scenario(
    scenario: Scenario | str | Path = "reference",
    *,
    fmu: str | Path | None = None,
    fields: str | Path | None = None,
    views: bool = False,
    folder: RunFolder | None = None,
    progress: Callable[[float], None] | None = None,
    heard: Callable[[Message], object] | None = None,
    debug: bool = False,
) -> CoupledRun:
    """Run a scenario, the name of a packaged one, or a TOML file, coupled.

    fmu: the mechanical FMU; left out, it is that of `cosim.fmu.build.own_fmu`, built when it is
    missing or stale. fields: a folder that exists, for the temperature fields (`temperature.pvd`
    opens in ParaView). views: keep what belt and ice look like, as `snapshots.views`. folder:
    for rows, pictures and checkpoints while the run goes; one with a checkpoint is gone on from.
    progress: called with the time reached (s) after each macro step. heard: called with what unit
    and master say, as it comes. debug: ask the unit for more of it.

    A run that is interrupted (Ctrl-C) or fails returns what it had; `result.status` says so. Ice
    that melts beside friction that does not feel it is such a failure.
    Raises ScenarioError, FmuError, FmuBuildError, CouplingError, CheckpointError or
    thermal.ParameterError (all ValueErrors of one line) for input that cannot be, ParticipantError
    when a model fails before the first step.

    >>> from cosim import read_scenario
    >>> run = run_scenario(read_scenario("reference").changed({"run.duration": 0.5}))
    >>> run.result.status, run.result["thermal.interface_temperature"].shape
    ('complete', (51,))
    """
    scenario = as_scenario(scenario)
    record_every = scenario.record_every
    check_work(scenario, coupled=True)
    store = None if folder is None else folder.path
    path = Path(fmu or own_fmu(scenario.catalogue))
    mechanics = _mechanics(scenario, path, debug)
    model = BeltIceModel(scenario.thermal, prepared_block(scenario.thermal))
    snapshots = Snapshots(model, scenario.run.snapshot_interval, fields, views, store)
    heat = ThermalParticipant(model, THERMAL, observer=snapshots, melts=feels_melting(scenario))

    with CoupledSystem([mechanics, heat], CONNECTIONS, RESIDUALS) as system:
        if heard is not None:
            system.listen(heard)
        result = run(
            system,
            scheme_of(scenario.coupling, (MECHANICS, THERMAL)),
            control=control_of(scenario.coupling, scenario.coupling.macro_step),
            stop=scenario.run.duration,
            events=[scenario.surface.run_up_time],
            on_divergence=scenario.coupling.on_divergence,
            smallest_step=smallest_step(scenario.coupling, scenario.coupling.macro_step),
            record_every=record_every,
            keep=None if folder is None else _keep(folder, scenario, path, snapshots),
            observe=lambda time: heat.observe(),
            progress=progress,
        )
        result = _with_last_picture(result, snapshots)
    return CoupledRun(scenario, result, snapshots)


def _mechanics(scenario: Scenario, fmu: Path, debug: bool) -> Participant:
    """The unit with the rig's parameters, in a process of its own where that is asked for."""
    given: dict[str, Any] = {
        "parameters": scenario.mechanics.flat() | {"belt.width": scenario.belt.width},
        "inputs": {"surface_speed": scenario.surface.speed},
        "debug": debug,
    }
    if not scenario.coupling.isolate:
        return FmuParticipant(fmu, MECHANICS, **given)
    time_limit = scenario.coupling.time_limit
    return IsolatedParticipant(FmuParticipant, str(fmu), MECHANICS, time_limit=time_limit, **given)


def _keep(folder: RunFolder, scenario: Scenario, fmu: Path, snapshots: Snapshots) -> Keep:
    """What the run leaves on disk, and what of it tells it from another."""
    tables = scenario.model_dump(mode="json")
    if not scenario.effects:
        del tables["effects"]  # what a checkpoint from before there were any does not have
    setup: dict[str, Any] = {
        "stickslip": version("stickslip"),
        "GUID of mechanics": describe(fmu).guid,
    }
    for table, entries in tables.items():
        if isinstance(entries, dict):
            setup |= {f"{table}.{key}": value for key, value in entries.items()}
        else:
            setup[table] = entries
    for key in FILE_KEYS:
        if name := setup.get(key):
            setup[f"contents of {name}"] = sha256(Path(name).read_bytes()).hexdigest()
    for key in ("isolate", "time_limit"):  # where a unit computes is nothing to what it computes
        del setup[f"coupling.{key}"]
    how_often = {"seconds": setup.pop("run.checkpoint_seconds")}
    how_often["steps"] = setup.pop("run.checkpoint_steps")
    return Keep(folder, setup=setup, also={"pictures": snapshots}, **how_often)


def feels_melting(scenario: Scenario) -> bool:
    """Whether friction is another where the face of the ice melts, by law or by the water there."""
    return any(
        getattr(getattr(scenario, effect.id), switch) > 0.0
        for effect in scenario.catalogue.effects
        for switch in effect.feels_melting
    )


def _with_last_picture(result: CoupledResult, snapshots: Snapshots) -> CoupledResult:
    """Also when the disk refuses the picture, the numbers are not lost."""
    try:
        snapshots.take(float(result.time[-1]))
    except OutputError as error:
        return replace(result, status="failed", reason=str(error), error=error)
    return result
