"""The study's numbers, as JSON has them."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from stickslip.steady_motion.regimes import STARTS

from .case import Case
from .pretension_map import PretensionMap
from .regime_map import STARTS as MAPPED
from .regime_map import RegimeMap


def as_json(
    case: Case, stretched: PretensionMap | None, regimes: RegimeMap | None
) -> dict[str, Any]:
    """Case and maps with plain numbers, SI; what was not computed is None."""
    return {
        "name": case.name,
        **case.assessment.as_dict(),
        "starts": STARTS,
        "pretension_map": None
        if stretched is None
        else {
            "pretensions": stretched.pretensions.tolist(),
            "speeds": stretched.speeds.tolist(),
            "growth": _plain(stretched.growth),
            "sticks": _plain(stretched.sticks),
        },
        "regime_map": None
        if regimes is None
        else {
            "ratios": regimes.ratios.tolist(),
            "speeds": regimes.speeds.tolist(),
            "simulated": dict(zip(MAPPED, regimes.simulated.tolist(), strict=True)),
            "closed_form": None
            if regimes.closed_form is None
            else dict(zip(MAPPED, regimes.closed_form.tolist(), strict=True)),
            "cells_that_differ": regimes.wrong,
            "fastest_from_rest": regimes.fastest_from_rest,
        },
    }


def _plain(table: np.ndarray) -> list[list[float | None]]:
    """JSON has no NaN."""
    return [[value if math.isfinite(value) else None for value in row] for row in table.tolist()]
