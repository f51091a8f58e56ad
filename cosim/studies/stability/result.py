"""The study's numbers, as JSON has them."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import Any

import numpy as np
from stickslip.steady_motion.regimes import STARTS, coexisting

from .case import Case
from .pretension_map import PretensionMap
from .regime_map import STARTS as MAPPED
from .regime_map import RegimeMap


def as_json(
    case: Case, stretched: PretensionMap | None, regimes: RegimeMap | None
) -> dict[str, Any]:
    """Case and maps with plain numbers, SI; what was not computed is None."""
    rig = case.parameters.rig
    return {
        "name": case.name,
        "stability": {
            "verdict": case.stability.verdict,
            "motion": "along the line" if case.stability.straight else "its own",
            "growth": case.stability.growth,
            "cycle": case.stability.period,
            "time_to_grow": case.stability.time_to_grow,
            "amplification": case.stability.amplification
            if math.isfinite(case.stability.amplification) else None,
            "pretension": rig.spring_length - rig.spring_natural_length,
            "least_pretension": case.borders.least,
            "unstable_pretensions": case.borders.windows,
        },
        "starts": STARTS,
        "regimes": {start: asdict(regime) for start, regime in case.regimes.items()},
        "other_regimes": list(coexisting(case.regimes)),
        "pretension_map": None if stretched is None else {
            "pretensions": stretched.pretensions.tolist(),
            "speeds": stretched.speeds.tolist(),
            "growth": _plain(stretched.growth),
            "sticks": _plain(stretched.sticks),
        },
        "regime_map": None if regimes is None else {
            "ratios": regimes.ratios.tolist(),
            "speeds": regimes.speeds.tolist(),
            "simulated": dict(zip(MAPPED, regimes.simulated.tolist(), strict=True)),
            "closed_form": None if regimes.closed_form is None else dict(
                zip(MAPPED, regimes.closed_form.tolist(), strict=True)),
            "cells_that_differ": regimes.wrong,
            "fastest_from_rest": regimes.fastest_from_rest,
        },
    }


def _plain(table: np.ndarray) -> list[list[float | None]]:
    """JSON has no NaN."""
    return [[value if math.isfinite(value) else None for value in row] for row in table.tolist()]
