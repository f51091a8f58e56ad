"""The extended model as the real FMU, in one run: `model.toml` is what was fitted."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from cosim.coupling import FmuParticipant
from cosim.fmu.build import FmuBuildError, own_fmu
from cosim.gap.result import Gap

from .model_file import scenario_of, shown_run
from .quantities import digits
from .tracks import starts


def reproduction_line(gap: Gap) -> str:
    """What the FMU does with the numbers of model.toml, in a sentence."""
    try:
        off = largest_difference(gap, own_fmu())
    except FmuBuildError as error:
        return f"The FMU was not asked: {error}."
    return (
        "The FMU StickSlip3DOF with the numbers of model.toml moves as the fitted model does: "
        f"over the first cycles of {shown_run(gap).name} their places differ by "
        f"{'less than 0.001' if off < 1e-3 else digits(off, 2)} noise units at most."
    )


def largest_difference(gap: Gap, fmu: Path) -> float:
    """Between FMU and fitted model along x until the fit sets out anew, in units of the noise."""
    run = shown_run(gap)
    scenario, fitted = scenario_of(gap, run), gap.extended.run(run.name)
    time = run.motion.time[: next(iter(starts(run, fitted)), None)]
    speed = {"surface_speed": scenario.surface.speed}
    with FmuParticipant(fmu, parameters=scenario.mechanics.flat(), inputs=speed) as block:
        block.enter_initialisation(float(time[0]), float(time[-1]))
        block.exit_initialisation()
        places = [block.read()["x"]]
        for before, after in zip(time[:-1], time[1:], strict=True):
            block.step(float(before), float(after - before))
            places.append(block.read()["x"])
    off = np.array(places) + fitted.values.get("offset.x", 0.0) - fitted.track[: time.size, 0]
    return float(np.max(np.abs(off)) / run.noise["x"])
