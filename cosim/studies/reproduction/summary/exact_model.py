"""The exact model for a run of which only figures are known."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping

import numpy as np
from stickslip import Parameters, simulate

from .motion import Motion

# a published run: run-up and settling, then what is looked at (s), and the rows in between
SETTLING, WINDOW, INTERVAL = 10.0, 20.0, 5e-3
# how far off its place a block is put down, standard deviation: m, rad
MISPLACED, TURNED = 1e-3, math.radians(1.0)


def exact_parameters(known: Mapping[str, Mapping], values: Mapping[str, float]) -> Parameters:
    """Tables of a run (`Campaign.parameters`) with ``block.parameter`` -> number laid over them."""
    tables = {block: dict(table) for block, table in known.items()}
    for key, value in values.items():
        block, name = key.split(".", 1)
        tables.setdefault(block, {})[name] = value
    tables["initial"] = {"vx": tables["surface"]["speed"]} | tables.get("initial", {})
    with warnings.catch_warnings(action="ignore"):  # a fit may pass through mu_k > mu_s
        return Parameters.model_validate(tables, strict=True)


def exact_motion(
    known: Mapping[str, Mapping], values: Mapping[str, float], seed: int | None
) -> Motion:
    """The last 20 s of a run of 30 s; the seed says how the block was put down, None: in its place.

    A run that the model gives up is returned as far as it came.
    """
    y, phi = 0.0, 0.0
    if seed is not None:
        y, phi = np.random.default_rng(seed).normal(0.0, (MISPLACED, TURNED)).tolist()
    free = known["rig"]["degrees_of_freedom"]
    start = {"initial.y": y if "y" in free else 0.0, "initial.phi": phi if "phi" in free else 0.0}
    run = simulate(exact_parameters(known, start | dict(values)), SETTLING + WINDOW, INTERVAL)
    motion = Motion.of_trajectory(run)
    return motion.since(min(SETTLING, 0.5 * float(motion.time[-1])))
