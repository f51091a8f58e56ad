"""The FMU with the extended model's numbers, beside the measurement and the model itself."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from stickslip.arrays import STATE
from stickslip.restarted import Restarts, simulate_restarted

from cosim.coupling import FmuParticipant
from cosim.gap.camera.camera import Camera
from cosim.gap.camera.exposure import Exposure
from cosim.gap.diagnostics.model_track import ModelTrack
from cosim.gap.estimation.segmented_run import COLUMN
from cosim.gap.result import FittedRun, Gap
from cosim.scenario import Scenario

from .model_file import scenario_of
from .reproduced import Reproduced

PLACES, VELOCITIES = ("x", "y", "phi"), ("vx", "vy", "omega")


def reproduced_runs(gap: Gap) -> tuple[FittedRun, ...]:
    """Those that were held out; all where none was."""
    held = tuple(run for run in gap.model.runs if run.track.run.hold_out)
    return held or gap.model.runs


def reproduce(gap: Gap, run: FittedRun, fmu: Path) -> Reproduced:
    """Fly a run in the FMU from its first sample to its last, without ever starting anew."""
    scenario = scenario_of(gap, run, begun=True)
    track, noise = run.track, run.track.run.noise
    rows = np.flatnonzero(track.segments == track.segments[0])
    time, first = track.time, rows.size
    values = {**gap.model.settings, **gap.model.values, **run.own}
    exposure = _exposure(track, time[-1], Camera.split(values)[1])
    simulated = _in_fmu(fmu, scenario, exposure.moments)
    own = _in_kernel(scenario, exposure.moments)
    written = exposure.written(*(_columns(simulated, names) for names in (PLACES, VELOCITIES)))
    motion = {
        name: written[: time.size, PLACES.index(name)] + values.get(f"offset.{name}", 0.0)
        for name in track.channels
    }
    measured = {name: track.run.motion[name] for name in track.channels}
    begun = exposure.moments <= time[first - 1]
    apart = max(
        np.max(np.abs(simulated[name] - own[name])[begun]) / noise[name] for name in track.channels
    )
    left = [(measured[name] - motion[name]) / noise[name] for name in track.channels]
    plain = gap.plain.of(run.name).track
    return Reproduced(
        run.name, time, motion, measured, _rms(each[:first] for each in left),
        _rms(plain.residual(name)[rows] for name in track.channels), float(apart),
        first, _rms(left),
    )  # fmt: skip


def _exposure(track: ModelTrack, end: float, camera: Camera) -> Exposure:
    """Of a run's samples up to a time, s, and of those beyond it that a filter looks ahead to."""
    seen = slice(0, int(np.searchsorted(track.time, end + camera.reach, "right")))
    return Exposure.of(camera, track.time[seen], track.run.motion.x[seen])


def _columns(rows: dict[str, np.ndarray], names: tuple[str, ...]) -> np.ndarray:
    return np.stack([rows[name] for name in names], axis=1)


def _in_fmu(fmu: Path, scenario: Scenario, time: np.ndarray) -> dict[str, np.ndarray]:
    """Outputs at the times (s), which are the communication points."""
    rows = []
    with FmuParticipant(
        fmu, parameters=scenario.mechanics.flat(), inputs={"surface_speed": scenario.surface.speed}
    ) as block:
        block.enter_initialisation(float(time[0]), float(time[-1]))
        block.exit_initialisation()
        rows.append(block.read())
        for before, after in zip(time[:-1], time[1:], strict=True):
            block.step(float(before), float(after - before))
            rows.append(block.read())
    return {name: np.array([row[name] for row in rows]) for name in (*PLACES, *VELOCITIES)}


def _in_kernel(scenario: Scenario, time: np.ndarray) -> dict[str, np.ndarray]:
    """The same by the compiled kernel, from the same initial state, without an FMU."""
    mechanics = scenario.mechanics
    start = np.array([getattr(scenario.initial, name) for name in STATE])
    outputs = simulate_restarted(
        mechanics.pack(), scenario.surface.speed, mechanics.temperature_dependence.reference_degC,
        time, Restarts.at([0], [start]),
    )  # fmt: skip
    return {name: outputs[:, COLUMN[name]] for name in COLUMN}


def _rms(parts) -> float:
    rows = np.concatenate(list(parts))
    rows = rows[np.isfinite(rows)]
    return float(np.sqrt(np.mean(rows**2)))
