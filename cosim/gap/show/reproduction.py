"""The FMU with the extended model's numbers, beside the measurement and the model itself."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from stickslip.arrays import STATE
from stickslip.restarted import Restart, simulate_restarted

from cosim.coupling import FmuParticipant
from cosim.gap.estimation.segmented_run import COLUMN
from cosim.gap.result import FittedRun, Gap
from cosim.scenario import Scenario

from .model_file import scenario_of
from .reproduced import Reproduced


def reproduced_runs(gap: Gap) -> tuple[FittedRun, ...]:
    """Those that were held out; all where none was."""
    held = tuple(run for run in gap.model.runs if run.track.run.hold_out)
    return held or gap.model.runs


def reproduce(gap: Gap, run: FittedRun, fmu: Path) -> Reproduced:
    """Fly the first segment of a run in the FMU."""
    scenario = scenario_of(gap, run)
    track, noise = run.track, run.track.run.noise
    rows = np.flatnonzero(track.segments == track.segments[0])
    time = track.time[rows]
    simulated = _in_fmu(fmu, scenario, time)
    own = _in_kernel(scenario, time)
    zero = {name: gap.model.values.get(f"offset.{name}", 0.0) for name in track.channels}
    motion = {name: simulated[name] + zero[name] for name in track.channels}
    measured = {name: track.run.motion[name][rows] for name in track.channels}
    apart = max(
        np.max(np.abs(simulated[name] - own[name])) / noise[name] for name in track.channels
    )
    left = {name: (measured[name] - motion[name]) / noise[name] for name in track.channels}
    plain = gap.plain.of(run.name).track
    return Reproduced(
        run.name, time, motion, measured, _rms(left.values()),
        _rms(plain.residual(name)[rows] for name in track.channels), float(apart),
    )  # fmt: skip


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
    return {name: np.array([row[name] for row in rows]) for name in COLUMN}


def _in_kernel(scenario: Scenario, time: np.ndarray) -> dict[str, np.ndarray]:
    """The same by the compiled kernel, from the same initial state, without an FMU."""
    mechanics = scenario.mechanics
    start = np.array([getattr(scenario.initial, name) for name in STATE])
    outputs = simulate_restarted(
        mechanics.pack(), scenario.surface.speed, mechanics.temperature_dependence.reference_degC,
        time, [Restart(0, start)],
    )  # fmt: skip
    return {name: outputs[:, COLUMN[name]] for name in COLUMN}


def _rms(parts) -> float:
    rows = np.concatenate(list(parts))
    rows = rows[np.isfinite(rows)]
    return float(np.sqrt(np.mean(rows**2)))
