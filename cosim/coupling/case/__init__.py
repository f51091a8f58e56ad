"""A scenario as a coupled run: the mechanical FMU and the heat in belt and ice."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from cosim.coupling import (
    Connection,
    CoupledResult,
    CoupledSystem,
    FmuParticipant,
    GaussSeidel,
    run,
)
from cosim.coupling.case.snapshots import Snapshots
from cosim.coupling.case.thermal_participant import ThermalParticipant
from cosim.fmu.build import own_fmu
from cosim.scenario import Scenario, read_scenario
from thermal import BeltIceModel

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


@dataclass(frozen=True)
class CoupledRun:
    """What a coupled run was made of and what came out.

    result: every output of both sides at the recorded times, as `mechanics.x`,
    `thermal.interface_temperature`, ..., status and energy ledger. snapshots: the belt's
    contact face over time.
    """

    scenario: Scenario
    result: CoupledResult
    snapshots: Snapshots


def run_scenario(
    scenario: Scenario | str | Path = "reference",
    *,
    fmu: str | Path | None = None,
    fields: str | Path | None = None,
    views: bool = False,
    progress: Callable[[float], None] | None = None,
) -> CoupledRun:
    """Run a scenario, the name of a packaged one, or a TOML file, coupled.

    fmu: the mechanical FMU; left out, it is that of `cosim.fmu.build.own_fmu`, built when it is
    missing or stale. fields: a folder that exists, for the temperature fields (`temperature.pvd`
    opens in ParaView). views: keep what belt and ice look like, as `snapshots.views`. progress:
    called with the time reached (s) after each macro step.

    A run that is interrupted (Ctrl-C) or fails returns what it had; `result.status` says so. Ice
    that melts beside friction that does not feel it is such a failure.
    Raises ScenarioError, FmuError, FmuBuildError, CouplingError or thermal.ParameterError (all
    ValueErrors of one line) for input that cannot be, ParticipantError when a model fails before
    the first step.

    >>> run = run_scenario(read_scenario("reference").changed({"run.duration": 0.5}))
    >>> run.result.status, run.result["thermal.interface_temperature"].shape
    ('complete', (51,))
    """
    if not isinstance(scenario, Scenario):
        scenario = read_scenario(scenario)
    record_every = scenario.record_every
    snapshots = Snapshots(scenario.run.snapshot_interval, fields, views)
    mechanics = FmuParticipant(
        fmu or own_fmu(),
        MECHANICS,
        parameters=scenario.mechanics.flat(),
        inputs={"surface_speed": scenario.surface.speed},
    )
    heat = ThermalParticipant(
        BeltIceModel(scenario.thermal), THERMAL, observer=snapshots, melts=feels_melting(scenario)
    )
    with CoupledSystem([mechanics, heat], CONNECTIONS, RESIDUALS) as system:
        result = run(
            system,
            GaussSeidel((MECHANICS, THERMAL)),
            stop=scenario.run.duration,
            macro_step=scenario.coupling.macro_step,
            record_every=record_every,
            progress=progress,
        )
        result = _with_last_picture(result, snapshots, heat.model)
    return CoupledRun(scenario, result, snapshots)


def feels_melting(scenario: Scenario) -> bool:
    """Whether friction is another where the face of the ice melts, by law or by the water there."""
    return (
        scenario.temperature_dependence.sensitivity > 0.0
        or scenario.asperity_melting.length > 0.0
        or scenario.mixed_lubrication.share > 0.0
    )


def _with_last_picture(
    result: CoupledResult, snapshots: Snapshots, model: BeltIceModel
) -> CoupledResult:
    """Also when the disk refuses the picture, the numbers are not lost."""
    try:
        snapshots.take(float(result.time[-1]), model)
    except OSError as error:
        return replace(result, status="failed", reason=f"temperature fields: {error}", error=error)
    return result
