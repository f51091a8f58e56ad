"""The extended model as the real FMU, in one run: `model.toml` is what was fitted."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from cosim.coupling import FmuParticipant
from cosim.fmu.build import FmuBuildError, own_fmu
from cosim.gap.result import Gap
from cosim.gap.windows import FittedRun
from cosim.scenario import Scenario

from .model_file import scenario_of, shown_run
from .quantities import digits
from .tracks import measured_run, starts


def reproduction_line(gap: Gap) -> str:
    """What the FMU does with the numbers of model.toml, in a sentence."""
    run = shown_run(gap)
    try:
        off = largest_difference(gap, run, own_fmu())
    except FmuBuildError as error:
        return f"The FMU was not asked: {error}."
    said = "less than 0.001" if off < 1e-3 else digits(off, 2)
    return (
        "The FMU StickSlip3DOF with the numbers of model.toml moves as the fitted model does: "
        f"over the first cycles of {run.name} their places differ by {said} noise units at most."
    )


def largest_difference(gap: Gap, fitted: FittedRun, fmu: Path) -> float:
    """Between FMU and fitted model along x until the fit sets out anew, in units of the noise."""
    run = measured_run(gap, fitted.name)
    end = next(iter(starts(run, fitted)), run.motion.time.size)
    x = _in_fmu(fmu, scenario_of(gap, fitted), run.motion.time[:end])
    zero = fitted.values.get("offset.x", 0.0)
    return float(np.max(np.abs(x + zero - fitted.track[:end, 0])) / run.noise["x"])


def _in_fmu(fmu: Path, scenario: Scenario, time: np.ndarray) -> np.ndarray:
    """(n,) x of the block at the times (s), which are the communication points."""
    with FmuParticipant(
        fmu, parameters=scenario.mechanics.flat(), inputs={"surface_speed": scenario.surface.speed}
    ) as block:
        block.enter_initialisation(float(time[0]), float(time[-1]))
        block.exit_initialisation()
        places = [block.read()["x"]]
        for before, after in zip(time[:-1], time[1:], strict=True):
            block.step(float(before), float(after - before))
            places.append(block.read()["x"])
    return np.array(places)
