"""What is typical of a campaign: where the fits of the catalogue set out."""

from __future__ import annotations

import numpy as np
from stickslip.effects.candidate import Scales
from stickslip.packing import GRAVITY

from cosim.gap.data import MeasuredRun


def scales(runs: list[MeasuredRun], mu_k: float, extension: float) -> Scales:
    """Means over runs; ``mu_k`` as the plain model has it, ``extension`` of a spring at rest, m."""
    speed = float(np.mean([abs(run.surface_speed) for run in runs]))
    mass = float(np.mean([run.mass for run in runs]))
    duration = float(np.mean([run.motion.duration for run in runs]))
    distance = speed * duration
    return Scales(
        speed=speed,
        distance=distance,
        heat=max(mu_k, 1e-3) * mass * GRAVITY * distance,
        duration=duration,
        stiffness=float(np.mean([run.stiffness for run in runs])),
        travel=max(float(np.nanmax(np.abs(run.motion.x))) for run in runs),
        mass=mass,
        force=mass * GRAVITY,
        extension=extension,
        longest=max(abs(run.surface_speed) * run.motion.duration for run in runs),
    )
